#pragma once

#include <array>
#include <cstdint>

#include "littoral/coupler/analytic.hpp"
#include "littoral/coupler/contract.hpp"
#include "littoral/support/config.hpp"
#include "littoral/support/scene.hpp"

namespace littoral::support {

/// Who plays the other side. automatic: the other program of the job, or nobody in a scene without coupling.
enum class PartnerKind : std::uint8_t { automatic, mpi, none, analytic };
/// Flows an analytic partner can have; initial: the scene's initial formulas at (x, y, z, t).
enum class AnalyticFlow : std::uint8_t { initial, uniform_stream, hydrostatic, taylor_vortex, standing_wave };

/// The key `partner` and the section `analytic` of sph.yaml and of fv.yaml.
struct PartnerConfig {
  PartnerKind kind = PartnerKind::automatic;
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

  /// `role` is the program's own; the spacing of a lattice is a key of the particles' file only.
  void bind(Binder& b, coupler::Role role);
};

/// The flow of the analytic partner. pure
coupler::Flow analytic_flow(const Scene& scene, const PartnerConfig::Analytic& analytic);

}  // namespace littoral::support
