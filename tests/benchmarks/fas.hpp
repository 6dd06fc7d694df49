#pragma once

#include <memory>
#include <vector>

#include "dual_time/step_solver.hpp"
#include "implicit/anderson.hpp"
#include "implicit/line_operator.hpp"
#include "implicit/transfer.hpp"
#include "overset/assembly.hpp"

namespace littoral::fv {

/// The classical inner iterations, to compare the default with, in the plane and on one rank. Each relaxation
/// starts from the nonlinear third-order residual of its level.
///   adi     approximate factorisation of the first-order Jacobian, block tridiagonal along one direction
///           after the other, each with the whole diagonal D: (D + O_1) D^-1 (D + O_2) e = -r (diagonally
///           dominant ADI: Bardina & Lombard 1987); no pseudo-time term
///   lines   zebra lines across the thin cells, as the default's smoother
enum class Relaxation { adi, lines };

struct FasOptions {
  Relaxation relaxation = Relaxation::adi;
  int max_levels = 1;  // 1: relaxations only
  int pre = 1, post = 0;
  int coarsest = 8;  // relaxations on the last of several levels
  int anderson_depth = 0;
  double jump = 1.0;  // as CorrectionPhysics
};

/// Full approximation storage: coarse levels are the same equations with the same conditions on every second
/// node, holes cut and donors sought anew, as far down as every cell finds one. Blocks
/// without joins.
class FasSolver : public StepSolver<2> {
 public:
  FasSolver(const FasOptions& options, const OversetOptions& overset);
  ~FasSolver() override;
  StepReport solve(const StepProblem<2>& problem, const InnerTolerance& tolerance,
                   std::vector<State<2>>& q) override;
  int n_levels() const;

 private:
  struct Level;
  void set_levels(const StepProblem<2>& problem);
  void cycle(std::size_t l, const StepProblem<2>& problem, bool residual_is_current);
  void relax(Level& level, bool forward);

  FasOptions options_;
  OversetOptions overset_;
  std::vector<std::unique_ptr<Level>> levels_;
};

}  // namespace littoral::fv
