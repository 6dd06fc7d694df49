#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "littoral/support/formula.hpp"
#include "physics/eos.hpp"
#include "physics/integrator.hpp"
#include "physics/riemann.hpp"

namespace littoral::sph {

/// How the pair loops calculate. mixed: geometry, kernel and face states of a pair in float; what they are
/// summed to, and the particles themselves, in double.
enum class Precision : std::uint8_t { all_double, mixed };

/// Everything the equations of the particles depend on; a scene and an sph.yaml in numbers.
template <int D>
struct Numerics {
  LinearEos eos;
  double viscosity = 0.0;                                     // nu [m^2/s]; 0: no viscous term
  std::array<double, D> gravity{};                            // [m/s^2]; 0: no such term
  std::optional<std::array<support::Formula, D>> body_force;  // [m/s^2]; absent: no such term
  bool free_surface = false;                                  // else no detection
  double spacing = 0.0;                                       // dx [m]
  double kernel_radius = 0.0;                                 // R [m]
  double skin = 0.0;                                          // of the neighbour lists, at most [m]
  Reconstruction reconstruction = Reconstruction::unlimited;
  WallStates wall_states = WallStates::linear;
  RiemannSolver riemann = RiemannSolver::linearised;
  Precision precision = Precision::all_double;
  Tension tension = Tension::plain;
  bool shifting = true;
  double reference_velocity = 0.0;  // U of (14) [m/s]
  Integrator integrator = Integrator::rk4;
  double cfl = 0.375;                                         // CFL_a of (16)
  double viscous_cfl = default_viscous_cfl(Integrator::rk4);  // CFL_nu of (16)
  double force_cfl = 0.25;                                    // on sqrt(R / |du/dt|)
};

}  // namespace littoral::sph
