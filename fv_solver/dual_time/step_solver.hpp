#pragma once

#include <vector>

#include "boundary/exchange.hpp"
#include "dual_time/step_phases.hpp"
#include "free_surface/free_surface.hpp"
#include "grid/block.hpp"
#include "physics/equations.hpp"

namespace littoral::fv {

/// The nonlinear equations of one time step, on all blocks of all ranks (those here are this rank's): find q
/// with residual 0.
template <int D>
struct StepProblem {
  std::vector<Block<D>>& blocks;
  const Exchange<D>& exchange;
  const Equations<D>& equations;
  BackwardDifference time;
  const std::vector<History<D>>& history;
  const std::vector<Forcing<D>>& forcing;
  FreeSurface<D>* surface = nullptr;  // null: none
  double t = 0.0;                     // [s] of the new level
  StepPhases* phases = nullptr;       // null: not timed

  /// Does `work` on the account of `phase`.
  template <class Work>
  void timed(StepPhases::Phase phase, Work&& work) const {
    if (phases == nullptr) return work();
    const auto timing = phases->scope(phase);
    work();
  }

  /// Lets the free surface follow the flow, refreshes the ghosts of q, then evaluates all residuals.
  /// comm collective, both
  void evaluate(std::vector<State<D>>& q, std::vector<Residual<D>>& r) const;
  /// Size of a residual as a velocity: rms over the solved cells, weighted with volume, of
  /// R_u/(rho0 V) / (a0 + c0/h) and h R_p/(rho0 V), h = V^(1/D)  [m/s]. NaN if any is.
  double norm(const std::vector<Residual<D>>& r) const;
  /// evaluate() with the surface where it is.
  void evaluate_rows(std::vector<State<D>>& q, std::vector<Residual<D>>& r) const;
};

/// When the inner iteration of a step may end.
struct InnerTolerance {
  double drop = 1e-3;   // [-] of the norm from the start of the step
  double floor = 0.0;   // [m/s] norm below which nothing is asked for
  int max_cycles = 50;  // [-]
  bool met(double norm, double first) const { return norm <= drop * first || norm <= floor; }
};

struct StepReport {
  int cycles = 0;
  bool converged = false;
  std::vector<double> norms;  // [m/s] before the first cycle, then after each
  double drop() const { return norms.empty() || norms.front() == 0.0 ? 0.0 : norms.back() / norms.front(); }
};

/// A way to solve a step: plain dual time (6), or the linear multigrid correction.
template <int D>
class StepSolver {
 public:
  virtual ~StepSolver() = default;
  /// in/out q: the start, then the solution; ghosts current on return. Cells that are not solved keep their
  /// values. comm collective
  virtual StepReport solve(const StepProblem<D>& problem, const InnerTolerance& tolerance,
                           std::vector<State<D>>& q) = 0;
};

}  // namespace littoral::fv
