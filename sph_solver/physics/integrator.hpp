#pragma once

#include <cstddef>
#include <cstdint>

namespace littoral::sph {

/// How a step of (x, u, V) is made of slopes.
///   rk4       classical Runge-Kutta, four slopes: the paper's
///   midpoint  two slopes, second order; sound limits its step to .72 of the other's (README, Time)
enum class Integrator : std::uint8_t { rk4, midpoint };

/// One slope: how far the next state lies ahead of the start, next state = start + advance dt slope, and the
/// weight of this slope in the sum that makes the last state.
struct Stage {
  double advance;  // of dt
  double weight;
};

struct Stages {
  const Stage* stage;
  std::size_t count;

  const Stage& operator[](std::size_t k) const { return stage[k]; }
  /// Time of the state that slope k is taken at.
  double time(std::size_t k, double t, double dt) const { return k == 0 ? t : t + stage[k - 1].advance * dt; }
};

inline Stages stages_of(Integrator integrator) {
  static constexpr Stage k_rk4[] = {{0.5, 1.0 / 6.0}, {0.5, 1.0 / 3.0}, {1.0, 1.0 / 3.0}, {1.0, 1.0 / 6.0}};
  static constexpr Stage k_midpoint[] = {{0.5, 0.0}, {1.0, 1.0}};
  return integrator == Integrator::rk4 ? Stages{k_rk4, 4} : Stages{k_midpoint, 2};
}

/// CFL_a of (16): the paper's for rk4, which leaves 12% below the limit measured in 3-D; as far below for
/// midpoint.
inline double default_cfl(Integrator integrator) { return integrator == Integrator::rk4 ? 0.375 : 0.27; }

/// CFL_nu of (16). The viscous sum (S8) has rates of up to 72 nu/R^2 on a lattice (2-D R = 3dx 71.4,
/// 4dx 68.7; 3-D R = 2.7dx 72.3: the largest eigenvalue of its symbol over all wave vectors), and the real
/// axis of the stability region ends at 2.785 (rk4), 2 (midpoint): dt <= .0385, .0277 R^2/nu. The paper's .12
/// is three times beyond that: flows whose step viscosity limits blow up with it. Here 10% below the limits.
inline double default_viscous_cfl(Integrator integrator) {
  return integrator == Integrator::rk4 ? 0.035 : 0.025;
}

}  // namespace littoral::sph
