#include "dual_time/prescribed.hpp"

#include "grid/between.hpp"

namespace littoral::fv {

template <int D>
StepReport PrescribedFlow<D>::solve(const StepProblem<D>& problem, const InnerTolerance&,
                                    std::vector<State<D>>& q) {
  constexpr int k_rounds = 5;  // of closest points and phi; each leaves about the surface's CFL of the error
  StepReport report;
  report.converged = true;
  for (; report.cycles < k_rounds; ++report.cycles) {
    for (std::size_t b = 0; b < q.size(); ++b)
      for (std::size_t c = 0; c < q[b].p.size(); ++c) {
        const std::array<double, D> u = velocity_(centre(problem.blocks[b], c), problem.t);
        for (std::size_t k = 0; k < D; ++k) q[b].u[k][c] = u[k];
      }
    if (problem.surface != nullptr)
      problem.surface->follow(problem.blocks, problem.exchange, problem.equations, q);
  }
  problem.exchange.states(problem.blocks, q);
  return report;
}

template class PrescribedFlow<2>;
template class PrescribedFlow<3>;

}  // namespace littoral::fv
