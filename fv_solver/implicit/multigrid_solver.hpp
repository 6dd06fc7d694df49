#pragma once

#include <memory>
#include <string>
#include <vector>

#include "dual_time/step_solver.hpp"
#include "implicit/multigrid.hpp"

namespace littoral::fv {

struct MultigridSolverOptions {
  int anderson_depth = 2;
  MultigridOptions multigrid;
};

/// Geometry of the finest level: metrics, statuses, and the block's windows as edge conditions.
template <int D>
LevelGrid<D> level_grid(const Block<D>& block);

/// Defect correction: per cycle one evaluation of the (third-order) residual and one linear multigrid V-cycle
/// of its first-order Jacobian, frozen at the step's start; Anderson mixing around it in the 1/V norm. There
/// is no pseudo-time term: the pseudo-CFL is infinite. Start a step from u extrapolated and p = p^n:
/// extrapolating both lets forces flip from step to step.
/// Real: of the blocks and corrections.
template <int D, class Real = float>
class MultigridSolver : public StepSolver<D> {
 public:
  explicit MultigridSolver(const MultigridSolverOptions& options = {});
  ~MultigridSolver() override;

  /// The levels are kept from step to step and built anew when a status has changed.
  /// throws StabilityError when the residual is not finite (block, cell)
  StepReport solve(const StepProblem<D>& problem, const InnerTolerance& tolerance,
                   std::vector<State<D>>& q) override;

 private:
  struct Levels;
  MultigridSolverOptions options_;
  std::unique_ptr<Levels> levels_;
};

}  // namespace littoral::fv
