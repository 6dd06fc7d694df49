#include "coupling/donors.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "grid/donor_patch.hpp"
#include "grid/loops.hpp"
#include "grid/space.hpp"
#include "littoral/coupler/donor_search.hpp"
#include "littoral/error.hpp"

namespace littoral::fv {
namespace {

/// The inner cell that a cell or ghost continues.
template <int D>
std::ptrdiff_t inner_cell(const Block<D>& block, std::array<int, D> index) {
  for (std::size_t d = 0; d < D; ++d) {
    const int n = block.extent.n[d];
    index[d] = block.periodic[d] ? (index[d] + n) % n : std::min(std::max(index[d], 0), n - 1);
  }
  return block.extent.at(index);
}

/// Rates of cells without an equation of their own, before they have a history: averages over neighbours
/// that have one, layer by layer.
template <int D>
void spread_rates(const Block<D>& block, State<D>& rate) {
  std::vector<std::uint8_t> known(block.extent.size, 0);
  std::vector<std::array<int, D>> waiting;
  for_each_index<D>({}, block.extent.n, [&](const std::array<int, D>& index) {
    const auto c = static_cast<std::size_t>(block.extent.at(index));
    known[c] = block.solved[c] != 0.0;
    if (block.status[c] == CellStatus::fringe) waiting.push_back(index);
  });
  for (std::size_t before = waiting.size() + 1; !waiting.empty() && waiting.size() < before;) {
    before = waiting.size();
    std::vector<std::array<int, D>> next;
    std::vector<std::size_t> done;
    for (const auto& index : waiting) {
      const auto c = static_cast<std::size_t>(block.extent.at(index));
      double n = 0.0;
      std::array<double, D + 1> sum{};
      for (std::size_t d = 0; d < D; ++d)
        for (const int step : {-1, 1}) {
          std::array<int, D> other = index;
          other[d] += step;
          if (!block.periodic[d] && (other[d] < 0 || other[d] >= block.extent.n[d])) continue;
          const auto o = static_cast<std::size_t>(inner_cell<D>(block, other));
          if (!known[o]) continue;
          n += 1.0;
          sum[0] += rate.p[o];
          for (std::size_t k = 0; k < D; ++k) sum[k + 1] += rate.u[k][o];
        }
      if (n == 0.0) {
        next.push_back(index);
        continue;
      }
      rate.p[c] = sum[0] / n;
      for (std::size_t k = 0; k < D; ++k) rate.u[k][c] = sum[k + 1] / n;
      done.push_back(c);
    }
    for (const std::size_t c : done) known[c] = 1;
    waiting = std::move(next);
  }
}

template <int D>
void put(const State<D>& q, const std::vector<std::size_t>& cell, std::size_t first, Field& p,
         const std::array<Field*, 3>& velocity) {
  for (std::size_t i = 0; i < cell.size(); ++i) p[first + i] = q.p[cell[i]];
  for (std::size_t k = 0; k < D; ++k) {
    Field& u = *velocity[axis_in_space<D>(k)];
    for (std::size_t i = 0; i < cell.size(); ++i) u[first + i] = q.u[k][cell[i]];
  }
}

}  // namespace

template <int D>
DonorOffer<D>::DonorOffer(const std::vector<Block<D>>& blocks) {
  constexpr int k_ghost_layers = 1;
  for (const auto& block : blocks) {
    cells_.emplace_back();
    coupler::DonorPatch patch = donor_patch(block, k_ghost_layers, cells_.back());
    for (std::size_t i = 0; i < patch.size(); ++i) {  // a ghost is worth what the cell it continues is
      const auto index = block.extent.index(static_cast<std::ptrdiff_t>(cells_.back()[i]));
      const auto inner = static_cast<std::size_t>(inner_cell<D>(block, index));
      patch.usable[i] = block.status[inner] == CellStatus::blanked ? 0 : 1;
    }
    geometry_.patches.push_back(std::move(patch));
  }
}

template <int D>
void DonorOffer<D>::put_state(const std::vector<State<D>>& state, coupler::DonorValues& values) const {
  values.resize(geometry_.size(), false);
  std::size_t first = 0;
  for (std::size_t b = 0; b < cells_.size(); ++b) {
    put<D>(state[b], cells_[b], first, values.p, {&values.u, &values.v, &values.w});
    first += cells_[b].size();
  }
}

template <int D>
void DonorOffer<D>::put_rates(const Stepper<D>& stepper, coupler::DonorValues& values) const {
  values.resize(geometry_.size(), false);
  std::size_t first = 0;
  for (std::size_t b = 0; b < cells_.size(); ++b) {
    put<D>(rates(stepper, b), cells_[b], first, values.dp_dt, {&values.du_dt, &values.dv_dt, &values.dw_dt});
    first += cells_[b].size();
  }
}

template <int D>
State<D> rates(const Stepper<D>& stepper, std::size_t b) {
  const Block<D>& block = stepper.blocks()[b];
  State<D> rate;
  stepper.time_derivative(b, rate);
  if (stepper.steps() > 0) return rate;
  spread_rates(block, rate);
  for (std::size_t c = 0; c < block.extent.size; ++c) {  // ghosts change as the cells they continue
    const auto inner =
        static_cast<std::size_t>(inner_cell<D>(block, block.extent.index(static_cast<std::ptrdiff_t>(c))));
    if (inner == c) continue;
    rate.p[c] = rate.p[inner];
    for (auto& u : rate.u) u[c] = u[inner];
  }
  return rate;
}

template <int D>
void DonorOffer<D>::put_secant(const coupler::DonorValues& end, double dt, coupler::DonorValues& values) {
  const auto slope = [dt](const Field& a, const Field& b, Field& rate) {
    for (std::size_t i = 0; i < rate.size(); ++i) rate[i] = (b[i] - a[i]) / dt;
  };
  slope(values.p, end.p, values.dp_dt);
  slope(values.u, end.u, values.du_dt);
  slope(values.v, end.v, values.dv_dt);
  slope(values.w, end.w, values.dw_dt);
}

template <int D>
void check_layers_covered(const coupler::DonorGeometry& geometry, const support::Scene& scene) {
  constexpr int k_points = 33;  // along each direction of a face
  constexpr std::array<const char*, 3> k_axis{"x", "y", "z"};
  const coupler::DonorSearch search(geometry, D);
  const double width = scene.coupling.blending_width + scene.coupling.driven_width;
  for (std::size_t r = 0; r < scene.regions.size(); ++r) {
    const auto& region = scene.regions[r];
    coupler::Vec3 lower = region.lower, upper = region.upper;  // with the layers
    for (std::size_t d = 0; d < D; ++d) {
      const std::size_t a = axis_in_space<D>(d);
      if (scene.open_face(region, a, 0)) lower[a] -= width;
      if (scene.open_face(region, a, 1)) upper[a] += width;
    }
    for (std::size_t d = 0; d < D; ++d)
      for (std::size_t side = 0; side < 2; ++side) {
        const std::size_t a = axis_in_space<D>(d);
        if (!scene.open_face(region, a, side)) continue;
        std::array<int, D> points;
        points.fill(k_points);
        points[d] = 1;
        std::int64_t hint = -1;
        for_each_index<D>({}, points, [&](const std::array<int, D>& index) {
          coupler::Vec3 x{};
          for (std::size_t e = 0; e < D; ++e) {
            const std::size_t b = axis_in_space<D>(e);
            x[b] = lower[b] + (upper[b] - lower[b]) * (index[e] + 0.5) / k_points;
          }
          x[a] = side == 0 ? lower[a] : upper[a];
          if (search.find(x, hint).found) return;
          // above the water no donors are needed where the grid ends inside the layers of another face
          for (std::size_t e = 0; e < D; ++e) {
            const std::size_t b = axis_in_space<D>(e);
            if (e != d && x[b] > region.lower[b] && x[b] < region.upper[b] && scene.has_free_surface() &&
                scene.initial.surface && (*scene.initial.surface)(x[0], x[1], x[2], 0.0) > 0.0)
              return;
          }
          char text[400];
          std::snprintf(
              text, sizeof text,
              "regions[%zu]: its driven layer ends at %s = %.6g m (nominal face %.6g, blending_width %.6g, "
              "driven_width %.6g), and at (%.6g, %.6g, %.6g) there are no cells of the grid to drive it: "
              "extend the grid, or shrink the layers",
              r, k_axis[a], x[a], side == 0 ? region.lower[a] : region.upper[a],
              scene.coupling.blending_width, scene.coupling.driven_width, x[0], x[1], x[2]);
          throw ConfigError(text);
        });
      }
  }
}

template State<2> rates(const Stepper<2>&, std::size_t);
template State<3> rates(const Stepper<3>&, std::size_t);
template class DonorOffer<2>;
template class DonorOffer<3>;
template void check_layers_covered<2>(const coupler::DonorGeometry&, const support::Scene&);
template void check_layers_covered<3>(const coupler::DonorGeometry&, const support::Scene&);

}  // namespace littoral::fv
