#include "free_surface/start_pressure.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "free_surface/cut_faces.hpp"
#include "grid/loops.hpp"
#include "grid/space.hpp"
#include "level_set/water_bodies.hpp"

namespace littoral::fv {
namespace {

/// Mean of P over the surface points of each body's cells beside the surface; NaN where it has none.
template <int D>
std::vector<double> levels_of(const std::vector<Block<D>>& blocks, const Exchange<D>& exchange,
                              const Fluid<D>& fluid, const Band<D>& band, const std::vector<Field>& phi,
                              const WaterBodies<D>& bodies) {
  std::vector<double> sums(2 * bodies.count(), 0.0);  // of P; of cells
  for (std::size_t b = 0; b < blocks.size(); ++b)
    for (const std::ptrdiff_t c : band.cells(b, 0, 1)) {
      const auto i = static_cast<std::size_t>(c);
      if (bodies.number()[b][i] == WaterBodies<D>::k_none) continue;
      const auto name = static_cast<std::size_t>(bodies.number()[b][i]);
      std::array<double, D> foot = centre<D>(blocks[b], c);
      const std::array<double, D> n = surface_normal<D>(blocks[b], phi[b], c);
      for (std::size_t k = 0; k < D; ++k) foot[k] -= phi[b][i] * n[k];
      sums[2 * name] += fluid.hydrostatic(foot);
      sums[2 * name + 1] += 1.0;
    }
  exchange.ranks().sum(sums.data(), sums.size());
  std::vector<double> levels(bodies.count());
  for (std::size_t name = 0; name < levels.size(); ++name) levels[name] = sums[2 * name] / sums[2 * name + 1];
  return levels;
}

}  // namespace

template <int D>
StartPressure settle_start_pressure(const std::vector<Block<D>>& blocks, const Exchange<D>& exchange,
                                    const Fluid<D>& fluid, const Band<D>& band, const std::vector<Field>& phi,
                                    std::vector<State<D>>& q) {
  if (!fluid.has_gravity()) return {};
  std::vector<Field> marks(blocks.size());
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    marks[b].resize(phi[b].size());
    for (std::size_t c = 0; c < phi[b].size(); ++c)
      marks[b][c] = phi[b][c] < 0.0 && blocks[b].status[c] != CellStatus::blanked ? 1.0 : 0.0;
  }
  WaterBodies<D> bodies;
  bodies.find(blocks, exchange, marks);
  const std::vector<double> levels = levels_of<D>(blocks, exchange, fluid, band, phi, bodies);
  // body(block, cell, p_h) for the cells of bodies that have a surface
  const auto water = [&](auto&& body) {
    for (std::size_t b = 0; b < blocks.size(); ++b)
      for_each_index<D>({}, blocks[b].extent.n, [&](const std::array<int, D>& index) {
        const auto c = static_cast<std::size_t>(blocks[b].extent.at(index));
        const double name = bodies.number()[b][c];
        if (name == WaterBodies<D>::k_none) return;
        const double level = levels[static_cast<std::size_t>(name)];
        if (std::isnan(level)) return;
        body(b, c, fluid.reference_pressure + std::max(0.0, blocks[b].reference_pressure[c] - level));
      });
  };
  std::array<double, 2> squares{};  // V (p - p_h)^2, V (p_h - p0)^2
  water([&](std::size_t b, std::size_t c, double rest) {
    squares[0] += blocks[b].volume[c] * std::pow(q[b].p[c] - rest, 2);
    squares[1] += blocks[b].volume[c] * std::pow(rest - fluid.reference_pressure, 2);
  });
  exchange.ranks().sum(squares);
  if (squares[1] == 0.0) return {};
  StartPressure start;
  start.misfit = std::sqrt(squares[0] / squares[1]);
  start.replaced = fluid.inverse_c2 == 0.0 && start.misfit > StartPressure::k_far;
  if (start.replaced) water([&](std::size_t b, std::size_t c, double rest) { q[b].p[c] = rest; });
  return start;
}

template StartPressure settle_start_pressure(const std::vector<Block<2>>&, const Exchange<2>&,
                                             const Fluid<2>&, const Band<2>&, const std::vector<Field>&,
                                             std::vector<State<2>>&);
template StartPressure settle_start_pressure(const std::vector<Block<3>>&, const Exchange<3>&,
                                             const Fluid<3>&, const Band<3>&, const std::vector<Field>&,
                                             std::vector<State<3>>&);

}  // namespace littoral::fv
