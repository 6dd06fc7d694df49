#pragma once

#include "dual_time/step_solver.hpp"

namespace littoral::fv {

/// The paper's dual time (6): explicit Runge-Kutta in a local pseudo-time, the physical time term implicit.
/// No coupling beyond the neighbours, so slow on large blocks; it is there as the plain reference.
template <int D>
class PlainDualTime : public StepSolver<D> {
 public:
  explicit PlainDualTime(double pseudo_cfl) : pseudo_cfl_(pseudo_cfl) {}
  StepReport solve(const StepProblem<D>& problem, const InnerTolerance& tolerance,
                   std::vector<State<D>>& q) override;

 private:
  void set_pseudo_steps(const StepProblem<D>& problem, const std::vector<State<D>>& q);

  double pseudo_cfl_;
  std::vector<Field> pseudo_step_;  // [s] per block
  std::vector<Field> beta_;         // [m^2/s^2] per block
  std::vector<State<D>> start_;
  std::vector<Residual<D>> residual_;
};

}  // namespace littoral::fv
