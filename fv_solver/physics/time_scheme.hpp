#pragma once

#include <limits>

namespace littoral::fv {

/// Backward differences: d q/dt at t^n+1 = a0 q^n+1 + a1 q^n + a2 q^n-1 (F5), variable steps.
struct BackwardDifference {
  double dt = std::numeric_limits<double>::infinity();  // [s] t^n+1 - t^n
  double a0 = 0.0, a1 = 0.0, a2 = 0.0;                  // [1/s]

  static BackwardDifference steady() { return {}; }
  static BackwardDifference first_order(double dt) { return {dt, 1.0 / dt, -1.0 / dt, 0.0}; }
  static BackwardDifference second_order(double dt, double dt_before) {
    const double w = dt / dt_before;
    return {dt, (1.0 + 2.0 * w) / (1.0 + w) / dt, -(1.0 + w) / dt, w * w / (1.0 + w) / dt};
  }
};

}  // namespace littoral::fv
