#pragma once

#include <array>
#include <functional>

#include "dual_time/step_solver.hpp"

namespace littoral::fv {

/// No equations for p and u: u is given, and only the free surface moves with it. For motions whose result is
/// known (a turning disc, a vortex that turns back).
template <int D>
class PrescribedFlow : public StepSolver<D> {
 public:
  using Velocity = std::function<std::array<double, D>(const std::array<double, D>& x, double t)>;  // [m/s]
  explicit PrescribedFlow(Velocity velocity) : velocity_(std::move(velocity)) {}
  StepReport solve(const StepProblem<D>& problem, const InnerTolerance& tolerance,
                   std::vector<State<D>>& q) override;

 private:
  Velocity velocity_;
};

}  // namespace littoral::fv
