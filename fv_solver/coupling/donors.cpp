#include "coupling/donors.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "coupling/surface_donors.hpp"
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
/// that have one, layer by layer, across joins. in/out rate: cells; out known: 1 where there is one
template <int D>
void spread_rates(const Stepper<D>& stepper, std::vector<State<D>>& rate) {
  const std::vector<Block<D>>& blocks = stepper.blocks();
  const Exchange<D>& exchange = stepper.exchange();
  std::vector<Field> known;
  std::vector<std::vector<std::ptrdiff_t>> waiting(blocks.size());
  std::vector<std::vector<Field*>> fields(D + 2);  // [number][block]
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    known.push_back(blocks[b].solved);
    for_each_index<D>({}, blocks[b].extent.n, [&](const std::array<int, D>& index) {
      const std::ptrdiff_t c = blocks[b].extent.at(index);
      if (blocks[b].status[static_cast<std::size_t>(c)] == CellStatus::fringe) waiting[b].push_back(c);
    });
  }
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    fields[0].push_back(&known[b]);
    fields[1].push_back(&rate[b].p);
    for (std::size_t k = 0; k < D; ++k) fields[k + 2].push_back(&rate[b].u[k]);
  }
  for (bool goes_on = true; goes_on;) {
    exchange.scalars(blocks, fields, ScalarGhosts::cell_data);
    bool reached = false;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      std::vector<std::ptrdiff_t> next, done;
      for (const std::ptrdiff_t c : waiting[b]) {
        double n = 0.0;
        std::array<double, D + 1> sum{};
        for (const std::ptrdiff_t stride : blocks[b].extent.stride)
          for (const std::ptrdiff_t step : {-stride, stride}) {
            const auto o = static_cast<std::size_t>(c + step);
            if (known[b][o] == 0.0) continue;
            n += 1.0;
            sum[0] += rate[b].p[o];
            for (std::size_t k = 0; k < D; ++k) sum[k + 1] += rate[b].u[k][o];
          }
        if (n == 0.0) {
          next.push_back(c);
          continue;
        }
        rate[b].p[static_cast<std::size_t>(c)] = sum[0] / n;
        for (std::size_t k = 0; k < D; ++k) rate[b].u[k][static_cast<std::size_t>(c)] = sum[k + 1] / n;
        done.push_back(c);
      }
      for (const std::ptrdiff_t c : done) known[b][static_cast<std::size_t>(c)] = 1.0;
      reached = reached || !done.empty();
      waiting[b] = std::move(next);
    }
    goes_on = exchange.ranks().any(reached);
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
DonorOffer<D>::DonorOffer(const std::vector<Block<D>>& blocks, const Exchange<D>& exchange) {
  constexpr int k_ghost_layers = 1;
  for (const auto& block : blocks) {
    usable_.emplace_back(block.extent.size, 0.0);
    for (std::size_t c = 0; c < block.extent.size; ++c) {
      const auto index = block.extent.index(static_cast<std::ptrdiff_t>(c));
      const auto inner = static_cast<std::size_t>(inner_cell<D>(block, index));
      usable_.back()[c] = block.status[inner] == CellStatus::blanked ? 0.0 : 1.0;
    }
  }
  exchange.scalar(blocks, usable_, ScalarGhosts::cell_data);
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    cells_.emplace_back();
    coupler::DonorPatch patch = donor_patch(blocks[b], k_ghost_layers, cells_.back());
    for (std::size_t i = 0; i < patch.size(); ++i)
      patch.usable[i] = usable_[b][cells_.back()[i]] != 0.0 ? 1 : 0;
    geometry_.patches.push_back(std::move(patch));
  }
}

template <int D>
void DonorOffer<D>::put_state(const Stepper<D>& stepper, coupler::DonorValues& values) const {
  const FreeSurface<D>* surface = stepper.surface();
  values.resize(geometry_.size(), surface != nullptr);
  std::vector<State<D>> continued;
  if (surface != nullptr) continued = continue_into_air(stepper, usable_);
  const std::vector<State<D>>& state = surface != nullptr ? continued : stepper.state();
  std::size_t first = 0;
  for (std::size_t b = 0; b < cells_.size(); ++b) {
    put<D>(state[b], cells_[b], first, values.p, {&values.u, &values.v, &values.w});
    for (std::size_t i = 0; i < cells_[b].size() && surface != nullptr; ++i)
      values.phi[first + i] = surface->phi()[b][cells_[b][i]];
    first += cells_[b].size();
  }
}

template <int D>
void DonorOffer<D>::put_rates(const Stepper<D>& stepper, coupler::DonorValues& values) const {
  const FreeSurface<D>* surface = stepper.surface();
  values.resize(geometry_.size(), surface != nullptr);
  std::vector<State<D>> rate = rates(stepper);
  std::size_t first = 0;
  const double over = stepper.steps() > 0 ? 1.0 / stepper.last_dt() : 0.0;
  for (std::size_t b = 0; b < cells_.size(); ++b) {
    put<D>(rate[b], cells_[b], first, values.dp_dt, {&values.du_dt, &values.dv_dt, &values.dw_dt});
    for (std::size_t i = 0; i < cells_[b].size() && surface != nullptr; ++i) {
      const std::size_t c = cells_[b][i];
      const double phi = surface->phi()[b][c], p0 = stepper.equations().fluid.reference_pressure;
      values.dphi_dt[first + i] = over * (phi - surface->phi_before()[b][c]);
      if (phi > 0.0)  // p - p0 is in proportion to phi there
        values.dp_dt[first + i] = (values.p[first + i] - p0) / phi * values.dphi_dt[first + i];
    }
    first += cells_[b].size();
  }
}

template <int D>
std::vector<State<D>> rates(const Stepper<D>& stepper) {
  const std::vector<Block<D>>& blocks = stepper.blocks();
  std::vector<State<D>> rate(blocks.size());
  for (std::size_t b = 0; b < blocks.size(); ++b) stepper.time_derivative(b, rate[b]);
  if (stepper.steps() > 0) return rate;
  spread_rates(stepper, rate);
  for (std::size_t b = 0; b < blocks.size(); ++b)
    for (std::size_t c = 0; c < blocks[b].extent.size; ++c) {  // ghosts change as the cells they continue
      const auto inner = static_cast<std::size_t>(
          inner_cell<D>(blocks[b], blocks[b].extent.index(static_cast<std::ptrdiff_t>(c))));
      if (inner == c) continue;
      rate[b].p[c] = rate[b].p[inner];
      for (auto& u : rate[b].u) u[c] = u[inner];
    }
  std::vector<std::vector<Field*>> fields(D + 1);
  for (auto& r : rate) {
    fields[0].push_back(&r.p);
    for (std::size_t k = 0; k < D; ++k) fields[k + 1].push_back(&r.u[k]);
  }
  stepper.exchange().scalars(blocks, fields, ScalarGhosts::cell_data);
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
  slope(values.phi, end.phi, values.dphi_dt);
}

template <int D>
void check_layers_covered(const coupler::DonorGeometry& geometry, const support::Scene& scene,
                          const Ranks& ranks) {
  constexpr int k_points = 33;  // along each direction of a face
  constexpr std::array<const char*, 3> k_axis{"x", "y", "z"};
  const coupler::DonorSearch search(geometry, D);
  // the points are the same on all ranks, and asked for in the same order
  const auto found_anywhere = [&](const coupler::Vec3& x, std::int64_t& hint) {
    return ranks.any(search.find(x, hint).found);
  };
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
          if (found_anywhere(x, hint)) return;
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

template std::vector<State<2>> rates(const Stepper<2>&);
template std::vector<State<3>> rates(const Stepper<3>&);
template class DonorOffer<2>;
template class DonorOffer<3>;
template void check_layers_covered<2>(const coupler::DonorGeometry&, const support::Scene&, const Ranks&);
template void check_layers_covered<3>(const coupler::DonorGeometry&, const support::Scene&, const Ranks&);

}  // namespace littoral::fv
