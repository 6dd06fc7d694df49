#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "implicit/multigrid.hpp"
#include "physics/equations.hpp"

namespace littoral::fv {

struct InnerOptions {
  double drop = 1e-3;     // residual over the residual at the start of the step, to stop at
  double absolute = 0.0;  // [m/s^2] residual per mass at which a step is converged whatever its start
  int max_cycles = 30;
  int anderson_depth = 2;
  MultigridOptions multigrid;
};

/// How one step converged.
struct InnerReport {
  bool converged = false;
  int cycles = 0;
  std::vector<double> norms;  // [m/s^2] of the residual before each cycle, and after the last
  double drop() const { return norms.empty() || norms.front() == 0.0 ? 0.0 : norms.back() / norms.front(); }
};

/// Geometry of the finest level: metrics, statuses, and the block's windows as edge conditions.
template <int D>
LevelGrid<D> level_grid(const Block<D>& block);

/// Solves r(q) = 0 for one time step by defect correction: per cycle one evaluation of the (third-order)
/// residual and one linear multigrid V-cycle of its first-order Jacobian, frozen at the step's start;
/// Anderson mixing around it. There is no pseudo-time term: the pseudo-CFL is infinite.
template <int D>
class InnerSolver {
 public:
  /// Fills the ghosts of q and evaluates the rows of all blocks; rows of unsolved cells are 0.
  using Evaluate = std::function<void(std::vector<State<D>>& q, std::vector<Residual<D>>& r)>;

  /// Keeps copies of what it needs; make a new one when a status changes.
  InnerSolver(const std::vector<Block<D>>& blocks, const InnerOptions& options);
  ~InnerSolver();

  /// in    q the start of the step (u extrapolated, p = p^n: extrapolating both lets forces flip every step)
  /// out   q the solution; ghosts as `evaluate` left them at the last evaluation
  /// forcing  one a block, or empty
  /// comm  local
  /// throws StabilityError when the residual is not finite (block, cell)
  InnerReport solve(const Evaluate& evaluate, std::vector<State<D>>& q, const CorrectionPhysics<D>& physics,
                    const std::vector<Forcing<D>>& forcing = {});

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace littoral::fv
