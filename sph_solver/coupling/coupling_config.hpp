#pragma once

#include <string>

#include "coupling/particle_exchange.hpp"
#include "coupling/samples.hpp"
#include "littoral/support/partner_config.hpp"

namespace littoral::sph {

/// What sph.yaml says about the coupling.
struct CouplingConfig {
  Removal removal = Removal::crossing;
  FaceRows rows = FaceRows::level;
  SampleMethod samples = SampleMethod::corrected;
  double phi_band = 3.0;  // [spacings] within which FV gets phi from the surface particles

  support::PartnerConfig partner;

  /// Binds the sections `coupling` and `analytic` and the key `partner`.
  void bind(support::Binder& b);
};

}  // namespace littoral::sph
