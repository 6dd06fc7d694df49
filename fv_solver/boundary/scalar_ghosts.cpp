#include "boundary/scalar_ghosts.hpp"

#include "boundary/ghosts.hpp"
#include "boundary/line.hpp"
#include "grid/between.hpp"
#include "grid/loops.hpp"
#include "grid/small_matrix.hpp"
#include "grid/space.hpp"

namespace littoral::fv {
namespace {

/// Continues a field linearly from the first inner cell to a ghost: exact for linear fields on any grid. The
/// gradient is one-sided along the line; across it central where there are cells on both sides (in this block
/// or another, so that cutting a block changes nothing), else towards the inside.
template <int D>
double extrapolated(const Block<D>& block, const ConnectedGhosts& connected, const Window<D>& w,
                    const Line<D>& line, const std::array<int, D>& index, std::size_t ghost, const Field& f) {
  const std::size_t i0 = line.inner[0];
  if (line.single()) return f[i0];
  const auto normal = static_cast<std::size_t>(w.direction);
  SpaceMatrix<D> steps{};  // [direction][component]
  SpaceVector<D> change{};
  for (std::size_t d = 0; d < D; ++d) {
    std::size_t low = i0, up = line.inner[1];
    if (d != normal) {
      const auto s = static_cast<std::size_t>(block.extent.stride[d]);
      const int i = index[d], n = block.extent.n[d];
      const auto connects = [&](int to, std::size_t c) {
        return to >= -k_ghost && to < n + k_ghost && connected[c] != 0;
      };
      // of a ghost, the cell on its inner side is set, be it one
      const bool has_low = i > 0 || connects(i - 1, i0 - s);
      const bool has_up = i + 1 < n || connects(i + 1, i0 + s);
      low = has_low ? i0 - s : i0;
      up = has_up ? i0 + s : i0;
      if (!has_low && !has_up) {  // nothing to difference with: follow the line alone
        const SpaceVector<D> along = between(block, line.inner[1], i0), ahead = between(block, i0, ghost);
        return f[i0] + dot(ahead, along) / dot(along, along) * (f[i0] - f[line.inner[1]]);
      }
    }
    steps[d] = between(block, low, up);
    change[d] = f[up] - f[low];
  }
  return f[i0] + dot(times(inverse<D>(steps), change), between(block, i0, ghost));
}

template <int D>
bool is_given(const Window<D>& w) {
  return w.surface && (w.condition == Condition::inflow || w.condition == Condition::far_field ||
                       w.condition == Condition::state);
}

template <int D>
void fill_level_set(const Block<D>& block, const ConnectedGhosts& connected, const Window<D>& w,
                    const Line<D>& line, const std::array<int, D>& index, std::size_t flat, Field& f) {
  for (std::size_t layer = 0; layer < 2; ++layer) {
    const std::size_t g = line.ghost[layer];
    switch (w.condition) {
      case Condition::symmetry:
        f[g] = f[line.inner[layer]];
        break;
      case Condition::periodic:
        f[g] = f[line.opposite[layer]];
        break;
      case Condition::inflow:
      case Condition::far_field:
      case Condition::state:
      case Condition::wall:
      case Condition::slip:
      case Condition::outflow:
      case Condition::convective:
      case Condition::overset:
        f[g] = is_given(w) && flat < w.given_phi[layer].size()
                   ? w.given_phi[layer][flat]
                   : extrapolated<D>(block, connected, w, line, index, g, f);
        break;
      case Condition::fringe:
      case Condition::join:
        break;
    }
  }
}

}  // namespace

template <int D>
double distance_to(const Prescribed& surface, const std::array<double, 3>& x, double t, double size) {
  constexpr double k_part = 0.05;
  const double step = k_part * size;
  double slope2 = 0.0;
  for (std::size_t k = 0; k < D; ++k) {
    coupler::Vec3 up = x, low = x;
    up[axis_in_space<D>(k)] += step;
    low[axis_in_space<D>(k)] -= step;
    const double slope = (surface(up, t) - surface(low, t)) / (2.0 * step);
    slope2 += slope * slope;
  }
  const double value = surface(x, t);
  return slope2 > 0.0 ? value / std::sqrt(slope2) : value;
}

template <int D>
void evaluate_surface_windows(Block<D>& block, double t) {
  for (Window<D>& w : block.windows) {
    for (auto& given : w.given_phi) given.clear();
    if (!is_given(w)) continue;
    std::array<int, D> lower, upper;
    grown_box<D>(block, w, lower, upper);
    for_each_index<D>(lower, upper, [&](const std::array<int, D>& index) {
      const Line<D> line(block, w, block.extent.at(index));
      const double size = length(between(block, line.inner[0], line.ghost[0]));
      for (std::size_t layer = 0; layer < 2; ++layer) {
        const coupler::Vec3 x = centre_in_space<D>(block, static_cast<std::ptrdiff_t>(line.ghost[layer]));
        w.given_phi[layer].push_back(distance_to<D>(w.surface, x, t, size));
      }
    });
  }
}

template <int D>
void fill_scalar_ghosts(const Block<D>& block, const ConnectedGhosts& connected, ScalarGhosts rule,
                        Field& field) {
  for (int d = 0; d < D; ++d)
    for (const Window<D>& w : block.windows) {
      if (w.direction != d || w.condition == Condition::join || w.condition == Condition::fringe) continue;
      if (rule == ScalarGhosts::cell_data && w.condition != Condition::periodic) continue;
      std::array<int, D> lower, upper;
      grown_box<D>(block, w, lower, upper);
      std::size_t flat = 0;
      for_each_index<D>(lower, upper, [&](const std::array<int, D>& index) {
        const Line<D> line(block, w, block.extent.at(index));
        fill_level_set<D>(block, connected, w, line, index, flat++, field);
      });
    }
}

template double distance_to<2>(const Prescribed&, const std::array<double, 3>&, double, double);
template double distance_to<3>(const Prescribed&, const std::array<double, 3>&, double, double);
template void evaluate_surface_windows(Block<2>&, double);
template void evaluate_surface_windows(Block<3>&, double);
template void fill_scalar_ghosts(const Block<2>&, const ConnectedGhosts&, ScalarGhosts, Field&);
template void fill_scalar_ghosts(const Block<3>&, const ConnectedGhosts&, ScalarGhosts, Field&);

}  // namespace littoral::fv
