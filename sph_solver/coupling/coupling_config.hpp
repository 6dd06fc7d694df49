#pragma once

#include <array>
#include <string>

#include "coupling/particle_exchange.hpp"
#include "coupling/samples.hpp"
#include "littoral/support/config.hpp"

namespace littoral::sph {

/// Who plays the grid side. automatic: the other program of the job, or nobody in a scene without coupling.
enum class PartnerKind { automatic, mpi, none, analytic };

/// Flows an analytic partner can have; initial: the scene's initial formulas at (x, y, z, t).
enum class AnalyticFlow { initial, uniform_stream, hydrostatic, taylor_vortex, standing_wave };

/// What sph.yaml says about the coupling.
struct CouplingConfig {
  Removal removal = Removal::crossing;
  SampleMethod samples = SampleMethod::corrected;
  double phi_band = 3.0;  // [spacings] within which FV gets phi from the surface particles

  PartnerKind partner = PartnerKind::automatic;
  struct Analytic {
    AnalyticFlow flow = AnalyticFlow::initial;
    double spacing = 0.0;                        // [m] of its donor lattice; 0: the particles' spacing
    std::array<double, 3> velocity = {0, 0, 0};  // [m/s]
    double pressure = 0.0;                       // [Pa]
    double level = 0.0;                          // [m]
    double speed = 1.0;                          // [m/s]
    double wavelength = 1.0;                     // [m]
    double depth = 1.0;                          // [m]
    double amplitude = 0.0;                      // [m]
  } analytic;

  /// Binds the sections `coupling` and `analytic` and the key `partner`.
  void bind(support::Binder& b);
};

}  // namespace littoral::sph
