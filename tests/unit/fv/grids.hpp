#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "boundary/ghosts.hpp"
#include "grid/loops.hpp"
#include "grid/metrics.hpp"
#include "physics/equations.hpp"

namespace littoral::fv {

/// Unit box, stretched (neighbouring cells differ by up to a third), sheared and, if `waviness` > 0, with
/// curved lines of both families.
template <int D>
Block<D> deformed_box(int n, double waviness = 0.03, double shear = 0.4, double stretching = 1.0,
                      const std::array<bool, D>& periodic = {}) {
  std::array<int, D> cells;
  for (std::size_t d = 0; d < D; ++d) cells[d] = n + static_cast<int>(d);
  return make_block<D>("deformed", cells, periodic, [=](const std::array<int, D>& index) {
    std::array<double, D> xi, x;
    for (std::size_t d = 0; d < D; ++d) {
      const double s = static_cast<double>(index[d]) / cells[d];
      xi[d] = stretching == 0.0 || periodic[d] ? s : std::expm1(stretching * s) / std::expm1(stretching);
    }
    x = xi;
    double wave = waviness;
    for (std::size_t d = 0; d < D; ++d) wave *= std::sin(2.0 * M_PI * xi[d]);
    for (std::size_t d = 0; d < D; ++d) x[d] += wave * (d == 0 ? 1.0 : -0.7);
    x[0] += shear * xi[D - 1];
    return x;
  });
}

/// One window a face, all of the same condition.
template <int D>
void close_with(Block<D>& block, Condition condition, const std::array<Prescribed, D>& velocity = {},
                const Prescribed& pressure = {}) {
  for (int d = 0; d < D; ++d)
    for (int side = 0; side < 2; ++side) {
      Window<D> w;
      w.name = "face";
      w.condition = condition;
      w.direction = d;
      w.side = side;
      w.upper = block.extent.n;
      w.velocity = velocity;
      w.pressure = pressure;
      block.windows.push_back(w);
    }
}

template <int D>
double largest(const Block<D>& block, const Residual<D>& r, double per_mass, double per_momentum) {
  double worst = 0.0;
  for_each_index<D>({}, block.extent.n, [&](const std::array<int, D>& index) {
    const auto c = static_cast<std::size_t>(block.extent.at(index));
    worst = std::max(worst, std::abs(r.mass[c]) / per_mass);
    for (const auto& row : r.momentum) worst = std::max(worst, std::abs(row[c]) / per_momentum);
  });
  return worst;
}

}  // namespace littoral::fv
