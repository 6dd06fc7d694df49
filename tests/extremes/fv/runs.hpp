#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "dual_time/stepper.hpp"
#include "grids.hpp"
#include "implicit/multigrid_solver.hpp"

namespace littoral::fv {

/// What came of a run: cycles of the most expensive step, whether all met the tolerance, the fastest cell.
struct Outcome {
  int cycles = 0;
  bool converged = true;
  double fastest = 0.0;  // [m/s]
};

template <int D>
double fastest(const Stepper<D>& stepper) {
  double largest = 0.0;
  for (std::size_t b = 0; b < stepper.blocks().size(); ++b) {
    const Block<D>& block = stepper.blocks()[b];
    for_each_index<D>({}, block.extent.n, [&](const std::array<int, D>& index) {
      const auto c = static_cast<std::size_t>(block.extent.at(index));
      if (block.solved[c] == 0.0) return;
      double speed2 = 0.0;
      for (const auto& u : stepper.state()[b].u) speed2 += u[c] * u[c];
      largest = std::max(largest, std::sqrt(speed2));
    });
  }
  return largest;
}

/// Sum of V u^2/2 over the solved cells [m^(D+2)/s^2].
template <int D>
double energy(const Stepper<D>& stepper) {
  double sum = 0.0;
  for (std::size_t b = 0; b < stepper.blocks().size(); ++b) {
    const Block<D>& block = stepper.blocks()[b];
    for_each_index<D>({}, block.extent.n, [&](const std::array<int, D>& index) {
      const auto c = static_cast<std::size_t>(block.extent.at(index));
      if (block.solved[c] == 0.0) return;
      for (const auto& u : stepper.state()[b].u) sum += 0.5 * block.volume[c] * u[c] * u[c];
    });
  }
  return sum;
}

/// Steps on, and prints a line for the table of the README.
template <int D>
Outcome march(Stepper<D>& stepper, double dt, int steps, const char* what, double value) {
  Outcome outcome;
  for (int step = 0; step < steps; ++step) {
    const StepReport report = stepper.advance(dt);
    outcome.cycles = std::max(outcome.cycles, report.cycles);
    outcome.converged = outcome.converged && report.converged;
  }
  outcome.fastest = fastest(stepper);
  std::printf("%-34s %10.3g   %3d cycles%s   fastest %.4g m/s\n", what, value, outcome.cycles,
              outcome.converged ? "" : " (not converged)", outcome.fastest);
  return outcome;
}

inline InnerTolerance three_orders() {
  InnerTolerance tolerance;
  tolerance.drop = 1e-3;
  tolerance.floor = 1e-10;
  tolerance.max_cycles = 100;
  return tolerance;
}

inline Prescribed constant(double value) {
  return [value](const std::array<double, 3>&, double) { return value; };
}

/// The windows of one face get another condition.
template <int D>
void set_face(Block<D>& block, int direction, int side, Condition condition, double u = 0.0) {
  for (Window<D>& w : block.windows)
    if (w.direction == direction && w.side == side) {
      w.condition = condition;
      w.velocity[0] = constant(u);
    }
}

/// Lid cavity of side `length`, lid speed `speed`; cells grow by exp(stretching) from the lower corner to the
/// lid's, or shrink.
inline Stepper<2> cavity(int n, double length, double speed, double nu, double inverse_c2 = 0.0,
                         double stretching = 0.0) {
  Block<2> block = make_block<2>("cavity", {n, n}, {false, false}, [=](const std::array<int, 2>& index) {
    std::array<double, 2> x;
    for (std::size_t d = 0; d < 2; ++d) {
      const double s = static_cast<double>(index[d]) / n;
      x[d] = length * (stretching == 0.0 ? s : std::expm1(stretching * s) / std::expm1(stretching));
    }
    return x;
  });
  close_with<2>(block, Condition::wall);
  set_face<2>(block, 1, 1, Condition::wall, speed);
  Equations<2> equations;
  equations.fluid.viscosity = nu;
  equations.fluid.inverse_c2 = inverse_c2;
  equations.speeds.c0 = speed;
  InnerTolerance tolerance = three_orders();
  tolerance.floor *= speed;
  Stepper<2> stepper({block}, equations, std::make_unique<MultigridSolver<2>>(), tolerance);
  stepper.initialise([](const std::array<double, 2>&, double) { return PointState<2>{}; }, 0.0);
  return stepper;
}

}  // namespace littoral::fv
