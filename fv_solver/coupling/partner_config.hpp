#pragma once

#include <array>
#include <cstdint>

#include "littoral/support/config.hpp"

namespace littoral::fv {

enum class PartnerKind : std::uint8_t { automatic, mpi, none, analytic };
enum class AnalyticFlow : std::uint8_t { initial, uniform_stream, hydrostatic, taylor_vortex, standing_wave };

/// Who plays the particles: the keys `partner` and `analytic` of fv.yaml, the same as in sph.yaml.
struct PartnerConfig {
  PartnerKind kind = PartnerKind::automatic;
  struct Analytic {
    AnalyticFlow flow = AnalyticFlow::initial;
    std::array<double, 3> velocity = {0, 0, 0};  // [m/s]
    double pressure = 0.0;                       // [Pa]
    double level = 0.0;                          // [m]
    double speed = 1.0;                          // [m/s]
    double wavelength = 1.0;                     // [m]
    double depth = 1.0;                          // [m]
    double amplitude = 0.0;                      // [m]
  } analytic;

  void bind(support::Binder& b);
};

}  // namespace littoral::fv
