#include "level_set/band.hpp"

#include <algorithm>
#include <cstdlib>

#include "grid/loops.hpp"

namespace littoral::fv {
namespace {

/// Ghosts of the first layer beyond the faces (not edges) that stand for cells: through them a layer spreads.
template <int D>
std::vector<std::ptrdiff_t> doors(const Block<D>& block, const Field& stands) {
  std::vector<std::ptrdiff_t> found;
  for (std::size_t d = 0; d < D; ++d)
    for (const int beyond : {-1, block.extent.n[d]}) {
      std::array<int, D> lower{}, upper = block.extent.n;
      lower[d] = beyond;
      upper[d] = beyond + 1;
      for_each_index<D>(lower, upper, [&](const std::array<int, D>& index) {
        const std::ptrdiff_t c = block.extent.at(index);
        if (stands[static_cast<std::size_t>(c)] != 0.0) found.push_back(c);
      });
    }
  return found;
}

/// Whether the surface lies between the centre of c, in the air, and the wall beyond its face: a film thinner
/// than half a cell. Where phi is further from 0 here than beyond, its zero lies below the wall.
template <int D>
bool film_on(const Block<D>& block, const Field& stands, const Field& phi, std::ptrdiff_t c,
             std::ptrdiff_t step) {
  const auto here = static_cast<std::size_t>(c), wall = static_cast<std::size_t>(c + step);
  return phi[here] >= 0.0 && phi[wall] < 0.0 && phi[here] <= -phi[wall] && stands[wall] == 0.0 &&
         block.status[wall] != CellStatus::blanked;
}

/// Whether a film has an end at c: one that goes on as far as the grid does, or to water, has none.
template <int D>
bool film_ends(const Block<D>& block, const Field& stands, const Field& phi, std::ptrdiff_t c,
               std::ptrdiff_t step) {
  for (const std::ptrdiff_t s : block.extent.stride)
    for (const std::ptrdiff_t other : {c - s, c + s}) {
      const auto o = static_cast<std::size_t>(other);
      if (s == std::abs(step) || stands[o] == 0.0 || phi[o] < 0.0) continue;
      if (!film_on(block, stands, phi, other, step)) return true;
    }
  return false;
}

/// Whether one of the cells around c, diagonals included, holds water.
template <int D>
bool beside_water(const Block<D>& block, const Field& stands, const Field& phi, std::ptrdiff_t c) {
  bool water = false;
  for_each_around<D>(block.extent.stride, c, [&](const std::array<int, D>&, std::ptrdiff_t other) {
    const auto o = static_cast<std::size_t>(other);
    water = water || (phi[o] < 0.0 && stands[o] != 0.0);
  });
  return water;
}

template <int D>
bool at_surface(const Block<D>& block, const Field& stands, const Field& phi, std::ptrdiff_t c) {
  const bool water = phi[static_cast<std::size_t>(c)] < 0.0;
  bool film = false;
  for (const std::ptrdiff_t stride : block.extent.stride)
    for (const std::ptrdiff_t step : {-stride, stride}) {
      const auto other = static_cast<std::size_t>(c + step);
      if (water == (phi[other] < 0.0)) continue;
      if (stands[other] != 0.0) return true;
      if (water)  // a film of air under a lid
        film = film || (block.status[other] != CellStatus::blanked &&
                        -phi[static_cast<std::size_t>(c)] <= phi[other]);
      else
        film = film || (film_on(block, stands, phi, c, step) &&
                        (beside_water(block, stands, phi, c) || !film_ends(block, stands, phi, c, step)));
    }
  return film;
}

}  // namespace

template <int D>
void Band<D>::build(const std::vector<Block<D>>& blocks, const Exchange<D>& exchange,
                    const std::vector<Field>& phi, int layers) {
  const std::size_t n = blocks.size();
  layers_ = layers;
  layer_.resize(n);
  stands_.resize(n);
  cells_.assign(n, {});
  start_.assign(n, {});
  for (std::size_t b = 0; b < n; ++b) {
    layer_[b].assign(blocks[b].extent.size, k_none);
    stands_[b].assign(blocks[b].extent.size, 0.0);
    for_each_index<D>({}, blocks[b].extent.n, [&](const std::array<int, D>& index) {
      const auto c = static_cast<std::size_t>(blocks[b].extent.at(index));
      stands_[b][c] = blocks[b].status[c] == CellStatus::blanked ? 0.0 : 1.0;
    });
  }
  exchange.scalar(blocks, stands_, ScalarGhosts::cell_data);
  std::vector<std::vector<std::ptrdiff_t>> open(n);
  for (std::size_t b = 0; b < n; ++b) {
    open[b] = doors(blocks[b], stands_[b]);
    start_[b].push_back(0);
    for_each_index<D>({}, blocks[b].extent.n, [&](const std::array<int, D>& index) {
      const std::ptrdiff_t c = blocks[b].extent.at(index);
      if (stands_[b][static_cast<std::size_t>(c)] == 0.0) return;
      if (!at_surface<D>(blocks[b], stands_[b], phi[b], c)) return;
      layer_[b][static_cast<std::size_t>(c)] = 0.0;
      cells_[b].push_back(c);
    });
    start_[b].push_back(static_cast<std::ptrdiff_t>(cells_[b].size()));
  }
  for (int layer = 1; layer < layers; ++layer) {
    exchange.scalar(blocks, layer_, ScalarGhosts::cell_data);
    for (std::size_t b = 0; b < n; ++b) {
      const Extent<D>& e = blocks[b].extent;
      const auto spread = [&](std::ptrdiff_t from) {
        const std::array<int, D> index = e.index(from);
        for (std::size_t d = 0; d < D; ++d)
          for (const int step : {-1, 1}) {
            std::array<int, D> to = index;
            to[d] += step;
            bool inside = true;
            for (std::size_t k = 0; k < D; ++k) inside = inside && to[k] >= 0 && to[k] < e.n[k];
            if (!inside) continue;
            const std::ptrdiff_t other = e.at(to);
            const auto o = static_cast<std::size_t>(other);
            if (stands_[b][o] == 0.0 || layer_[b][o] <= layer) continue;
            layer_[b][o] = layer;
            cells_[b].push_back(other);
          }
      };
      const auto first = static_cast<std::size_t>(start_[b][static_cast<std::size_t>(layer) - 1]);
      const auto last = static_cast<std::size_t>(start_[b].back());
      for (std::size_t i = first; i < last; ++i) spread(cells_[b][i]);
      for (const std::ptrdiff_t ghost : open[b])
        if (layer_[b][static_cast<std::size_t>(ghost)] == layer - 1) spread(ghost);
      std::sort(cells_[b].begin() + start_[b].back(), cells_[b].end());
      start_[b].push_back(static_cast<std::ptrdiff_t>(cells_[b].size()));
    }
  }
  exchange.scalar(blocks, layer_, ScalarGhosts::cell_data);
}

template class Band<2>;
template class Band<3>;

}  // namespace littoral::fv
