#include "level_set/water_bodies.hpp"

#include <algorithm>
#include <cmath>

#include "boundary/opening.hpp"
#include "grid/loops.hpp"
#include "level_set/volume.hpp"

namespace littoral::fv {
namespace {

/// Whether water may pass a window: an opening, or a fringe.
bool lets_water_through(Condition condition) {
  return is_opening(condition) || condition == Condition::fringe || condition == Condition::overset;
}

/// Each marked cell takes the lowest number around until none is lower. Returns whether any was.
template <int D>
bool spread(const Block<D>& block, Field& number) {
  bool any = false;
  for (bool changed = true; changed;) {
    changed = false;
    const auto visit = [&](const std::array<int, D>& index) {
      const std::ptrdiff_t c = block.extent.at(index);
      double& own = number[static_cast<std::size_t>(c)];
      if (own == WaterBodies<D>::k_none) return;
      for (const std::ptrdiff_t s : block.extent.stride)
        for (const std::ptrdiff_t step : {-s, s}) {
          const double other = number[static_cast<std::size_t>(c + step)];
          if (other < own) own = other, changed = true;
        }
    };
    for_each_index<D>({}, block.extent.n, visit);
    for_each_index<D>({}, block.extent.n, [&](std::array<int, D> index) {  // and the way back
      for (std::size_t d = 0; d < D; ++d) index[d] = block.extent.n[d] - 1 - index[d];
      visit(index);
    });
    any = any || changed;
  }
  return any;
}

template <int D>
double share_of(const Block<D>& block, const Field& phi, std::ptrdiff_t c, double shift) {
  std::array<double, D> slope;
  for (std::size_t d = 0; d < D; ++d) {
    const std::ptrdiff_t s = block.extent.stride[d];
    slope[d] = 0.25 * (phi[static_cast<std::size_t>(c + s)] - phi[static_cast<std::size_t>(c - s)]);
  }
  return wet_share<D>(phi[static_cast<std::size_t>(c)] + shift, slope);
}

/// Continues the numbers of bodies to all cells of the band: at the surface from the wettest neighbour,
/// beyond along the way by which a cell has its patch.
template <int D>
void number_band(const std::vector<Block<D>>& blocks, const Exchange<D>& exchange, const Band<D>& band,
                 const SurfacePatches<D>& patches, const std::vector<Field>& phi,
                 std::vector<Field>& number) {
  for (int layer = 0; layer < band.layers(); ++layer) {
    for (std::size_t b = 0; b < blocks.size(); ++b)
      for (const std::ptrdiff_t c : band.cells(b, layer, layer + 1)) {
        const auto i = static_cast<std::size_t>(c);
        if (number[b][i] != WaterBodies<D>::k_none) continue;
        std::ptrdiff_t from = c;
        if (layer > 0) {
          if (patches.has(b, c)) from = patches.source(blocks[b], b, c);
        } else {
          double lowest = 0.0;
          for (const std::ptrdiff_t s : blocks[b].extent.stride)
            for (const std::ptrdiff_t step : {-s, s}) {
              const auto other = static_cast<std::size_t>(c + step);
              if (number[b][other] == WaterBodies<D>::k_none || phi[b][other] >= lowest) continue;
              lowest = phi[b][other];
              from = c + step;
            }
        }
        number[b][i] = number[b][static_cast<std::size_t>(from)];
      }
    exchange.scalar(blocks, number, ScalarGhosts::cell_data);
  }
}

}  // namespace

template <int D>
void WaterBodies<D>::find(const std::vector<Block<D>>& blocks, const Exchange<D>& exchange,
                          const std::vector<Field>& marks) {
  constexpr double k_blocks = 4294967296.0;  // 2^32 cells in each
  const std::vector<std::size_t> mine = exchange.layout().owners.mine();
  number_.resize(blocks.size());
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    number_[b].assign(blocks[b].extent.size, k_none);
    for_each_index<D>({}, blocks[b].extent.n, [&](const std::array<int, D>& index) {
      const auto c = static_cast<std::size_t>(blocks[b].extent.at(index));
      if (marks[b][c] != 0.0)
        number_[b][c] = k_blocks * static_cast<double>(mine[b]) + static_cast<double>(c);
    });
  }
  for (bool changed = true; changed;) {
    exchange.scalar(blocks, number_, ScalarGhosts::cell_data);
    bool here = false;
    for (std::size_t b = 0; b < blocks.size(); ++b) here = spread<D>(blocks[b], number_[b]) || here;
    changed = exchange.ranks().any(here);
  }
  std::vector<double> names;
  for (const Field& field : number_)
    for (const double name : field)
      if (name != k_none && (names.empty() || names.back() != name)) names.push_back(name);
  const auto distinct = [](std::vector<double>& all) {
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
  };
  distinct(names);
  names = exchange.ranks().gather(names);
  distinct(names);
  for (Field& field : number_)
    for (double& name : field)
      if (name != k_none)
        name = static_cast<double>(std::lower_bound(names.begin(), names.end(), name) - names.begin());
  count_ = names.size();
}

template <int D>
std::vector<double> WaterBodies<D>::open(const std::vector<Block<D>>& blocks, const Ranks& ranks) const {
  std::vector<double> is_open(count_, 0.0);
  const auto mark = [&](std::size_t b, std::ptrdiff_t c) {
    const double name = number_[b][static_cast<std::size_t>(c)];
    if (name != k_none) is_open[static_cast<std::size_t>(name)] = 1.0;
  };
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const Block<D>& block = blocks[b];
    for (const Window<D>& w : block.windows) {
      if (!lets_water_through(w.condition)) continue;
      std::array<int, D> lower = w.lower, upper = w.upper;
      const auto d = static_cast<std::size_t>(w.direction);
      lower[d] = w.side == 0 ? 0 : block.extent.n[d] - 1;
      upper[d] = lower[d] + 1;
      for_each_index<D>(lower, upper,
                        [&](const std::array<int, D>& index) { mark(b, block.extent.at(index)); });
    }
    for_each_index<D>({}, block.extent.n, [&](const std::array<int, D>& index) {
      const std::ptrdiff_t c = block.extent.at(index);
      const CellStatus status = block.status[static_cast<std::size_t>(c)];
      if (status == CellStatus::fringe || status == CellStatus::forced) mark(b, c);
    });
  }
  ranks.sum(is_open.data(), is_open.size());
  return is_open;
}

template <int D>
void restore_volumes(const std::vector<Block<D>>& blocks, const Exchange<D>& exchange, const Band<D>& band,
                     const SurfacePatches<D>& patches, const std::vector<Field>& before,
                     std::vector<Field>& phi, std::vector<Field>& history) {
  const std::size_t n = blocks.size();
  std::vector<Field> old_share(n), share(n), marks(n);
  for (std::size_t b = 0; b < n; ++b) {
    wet_shares<D>(blocks[b], before[b], old_share[b]);
    wet_shares<D>(blocks[b], phi[b], share[b]);
    marks[b].resize(share[b].size());
    for (std::size_t c = 0; c < share[b].size(); ++c)
      marks[b][c] = share[b][c] > 0.0 || old_share[b][c] > 0.0 ? 1.0 : 0.0;
  }
  WaterBodies<D> bodies;
  bodies.find(blocks, exchange, marks);
  std::vector<Field> number = bodies.number();
  number_band<D>(blocks, exchange, band, patches, phi, number);

  // per body: what is missing, and how much a unit of shift brings
  const std::vector<double> open = bodies.open(blocks, exchange.ranks());
  std::vector<double> missing(bodies.count(), 0.0), shift(bodies.count(), 0.0);
  for (std::size_t b = 0; b < n; ++b)
    for_each_index<D>({}, blocks[b].extent.n, [&](const std::array<int, D>& index) {
      const auto c = static_cast<std::size_t>(blocks[b].extent.at(index));
      const double name = bodies.number()[b][c];
      if (name != WaterBodies<D>::k_none)
        missing[static_cast<std::size_t>(name)] += (old_share[b][c] - share[b][c]) * blocks[b].volume[c];
    });
  exchange.ranks().sum(missing.data(), missing.size());
  constexpr int k_rounds = 3;      // of Newton's method on a function that is nearly linear
  constexpr double k_part = 1e-3;  // of a cell, to difference the volume over
  constexpr int k_cut = 2;         // layers with cells that the surface may cut
  for (int round = 0; round < k_rounds; ++round) {
    std::vector<double> sums(2 * bodies.count(), 0.0);  // gained so far; area
    for (std::size_t b = 0; b < n; ++b)
      for (const std::ptrdiff_t c : band.cells(b, 0, k_cut)) {
        const auto i = static_cast<std::size_t>(c);
        if (number[b][i] == WaterBodies<D>::k_none) continue;
        const auto name = static_cast<std::size_t>(number[b][i]);
        const double volume = blocks[b].volume[i], step = k_part * std::pow(volume, 1.0 / D);
        const auto wet = [&](double by) { return share_of<D>(blocks[b], phi[b], c, by); };
        sums[2 * name] += (wet(shift[name]) - wet(0.0)) * volume;
        sums[2 * name + 1] += (wet(shift[name] - step) - wet(shift[name] + step)) * volume / (2.0 * step);
      }
    exchange.ranks().sum(sums.data(), sums.size());
    for (std::size_t name = 0; name < bodies.count(); ++name)
      if (open[name] == 0.0 && sums[2 * name + 1] > 0.0)
        shift[name] -= (missing[name] - sums[2 * name]) / sums[2 * name + 1];
  }
  constexpr double k_most = 0.25;  // of a cell: a drop that vanishes cannot be had back
  for (std::size_t b = 0; b < n; ++b)
    for (const std::ptrdiff_t c : band.cells(b)) {
      const auto i = static_cast<std::size_t>(c);
      if (number[b][i] == WaterBodies<D>::k_none) continue;
      const double most = k_most * std::pow(blocks[b].volume[i], 1.0 / D);
      const double by = std::clamp(shift[static_cast<std::size_t>(number[b][i])], -most, most);
      phi[b][i] += by;
      history[b][i] += by;
    }
  exchange.scalar(blocks, phi, ScalarGhosts::level_set);
  exchange.scalar(blocks, history, ScalarGhosts::level_set);
}

template class WaterBodies<2>;
template class WaterBodies<3>;
template void restore_volumes<2>(const std::vector<Block<2>>&, const Exchange<2>&, const Band<2>&,
                                 const SurfacePatches<2>&, const std::vector<Field>&, std::vector<Field>&,
                                 std::vector<Field>&);
template void restore_volumes<3>(const std::vector<Block<3>>&, const Exchange<3>&, const Band<3>&,
                                 const SurfacePatches<3>&, const std::vector<Field>&, std::vector<Field>&,
                                 std::vector<Field>&);

}  // namespace littoral::fv
