#include "dual_time/step_solver.hpp"

#include <array>
#include <cmath>

#include "grid/loops.hpp"

namespace littoral::fv {

template <int D>
void StepProblem<D>::evaluate(std::vector<State<D>>& q, std::vector<Residual<D>>& r) const {
  r.resize(blocks.size());
  if (surface != nullptr)
    timed(StepPhases::surface, [&] { surface->follow(blocks, exchange, equations, q); });
  timed(StepPhases::residual, [&] { evaluate_rows(q, r); });
}

template <int D>
void StepProblem<D>::evaluate_rows(std::vector<State<D>>& q, std::vector<Residual<D>>& r) const {
  exchange.states(blocks, q);
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    if (surface == nullptr) {
      equations.residual(blocks[b], q[b], time, history[b], forcing[b], r[b]);
      continue;
    }
    const BlockSurface<D> cut = surface->block(b);
    equations.residual(blocks[b], q[b], time, history[b], forcing[b], r[b], &cut);
  }
  if (surface != nullptr) surface->release_drops(r);
  exchange.share_fluxes(blocks, equations.fluid, q, r);
  if (!exchange.closed_contour().empty() && equations.fluid.inverse_c2 == 0.0 && surface == nullptr)
    exchange.closed_contour().close(blocks, r);
}

template <int D>
double StepProblem<D>::norm(const std::vector<Residual<D>>& r) const {
  const double rho0 = equations.fluid.density;
  double sum = 0.0, volume = 0.0;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const Block<D>& block = blocks[b];
    std::array<int, D> across = block.extent.n;
    across[0] = 1;
    const std::ptrdiff_t rows = block.extent.cells() / block.extent.n[0];
    std::vector<std::array<double, 2>> of_row(static_cast<std::size_t>(rows));  // added in order
#pragma omp parallel for schedule(static) if (block.extent.cells() > 16384)
    for (std::ptrdiff_t line = 0; line < rows; ++line) {
      std::array<int, D> index{};
      std::ptrdiff_t rest = line;
      for (std::size_t d = 1; d < D; ++d) {
        index[d] = static_cast<int>(rest % across[d]);
        rest /= across[d];
      }
      double row_sum = 0.0, row_volume = 0.0;
      const auto row = static_cast<std::size_t>(block.extent.at(index));
#pragma omp simd reduction(+ : row_sum, row_volume)
      for (std::size_t c = row; c < row + static_cast<std::size_t>(block.extent.n[0]); ++c) {
        const double v = block.volume[c], h = block.width[c];
        const double momentum_unit = h / (time.a0 * h + equations.speeds.c0);
        double u2 = 0.0;
        for (std::size_t k = 0; k < D; ++k) u2 += r[b].momentum[k][c] * r[b].momentum[k][c];
        const double e = (r[b].mass[c] * r[b].mass[c] * h * h + u2 * momentum_unit * momentum_unit) / v;
        row_sum += block.solved[c] != 0.0 ? e : 0.0;
        row_volume += block.solved[c] != 0.0 ? v : 0.0;
      }
      of_row[static_cast<std::size_t>(line)] = {row_sum, row_volume};
    }
    for (const auto& row : of_row) {
      sum += row[0];
      volume += row[1];
    }
  }
  std::array<double, 2> total{sum, volume};
  exchange.ranks().sum(total);
  return total[1] > 0.0 ? std::sqrt(total[0] / total[1]) / rho0 : 0.0;
}

template struct StepProblem<2>;
template struct StepProblem<3>;

}  // namespace littoral::fv
