#include "level_set/reinitialise.hpp"

#include <algorithm>
#include <cmath>

#include "grid/between.hpp"
#include "grid/loops.hpp"
#include "grid/small_matrix.hpp"

namespace littoral::fv {
namespace {

/// Longest of a cell's widths, between the centres around it [m].
template <int D>
double size(const Block<D>& block, std::ptrdiff_t c) {
  double most2 = 0.0;
  for (std::size_t d = 0; d < D; ++d) {
    const SpaceVector<D> across = between(block, c - block.extent.stride[d], c + block.extent.stride[d]);
    most2 = std::max(most2, 0.25 * dot(across, across));
  }
  return std::sqrt(most2);
}

/// Cells that are new in the band take over their neighbours' change since `before`, layer by layer.
template <int D>
void carry_history(const std::vector<Block<D>>& blocks, const Exchange<D>& exchange, const Band<D>& was,
                   const Band<D>& band, const std::vector<Field>& phi, std::vector<Field>& before) {
  for (int layer = 1; layer < band.layers(); ++layer) {
    exchange.scalar(blocks, before, ScalarGhosts::level_set);
    for (std::size_t b = 0; b < blocks.size(); ++b)
      for (const std::ptrdiff_t c : band.cells(b, layer, layer + 1)) {
        if (was.layer(b, c) != Band<D>::k_none) continue;
        double change = 0.0;
        int n = 0;
        for (const std::ptrdiff_t s : blocks[b].extent.stride)
          for (const std::ptrdiff_t other : {c - s, c + s}) {
            if (band.layer(b, other) >= layer) continue;
            const auto o = static_cast<std::size_t>(other);
            change += phi[b][o] - before[b][o];
            ++n;
          }
        const auto i = static_cast<std::size_t>(c);
        before[b][i] = phi[b][i] - change / std::max(n, 1);
      }
  }
  exchange.scalar(blocks, before, ScalarGhosts::level_set);
}

}  // namespace

template <int D>
void locate_surface(const std::vector<Block<D>>& blocks, const Exchange<D>& exchange,
                    const std::vector<Field>& phi, int layers, Band<D>& band, SurfacePatches<D>& patches) {
  band.build(blocks, exchange, phi, layers);
  patches.build(blocks, exchange, band, phi);
}

template <int D>
void reinitialise(const std::vector<Block<D>>& blocks, const Exchange<D>& exchange, int layers,
                  InterfaceCells interface, std::vector<Field>& phi, Band<D>& band,
                  SurfacePatches<D>& patches, std::vector<Field>* history) {
  Band<D> was;
  if (history != nullptr) was = std::move(band);
  locate_surface(blocks, exchange, phi, layers, band, patches);
  const int first = interface == InterfaceCells::frozen ? 1 : 0;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const Block<D>& block = blocks[b];
    double* f = phi[b].data();
    const auto set = [&](std::ptrdiff_t c, double distance) {
      const CellStatus status = block.status[static_cast<std::size_t>(c)];
      if (status == CellStatus::blanked) return;
      f[c] = f[c] < 0.0 ? -distance : distance;
    };
    for_each_index<D>({}, block.extent.n, [&](const std::array<int, D>& index) {
      const std::ptrdiff_t c = block.extent.at(index);
      if (band.layer(b, c) == Band<D>::k_none) set(c, layers * size(block, c));
    });
    const auto cells = band.cells(b);
    for (std::ptrdiff_t i = 0; i < cells.size(); ++i)
      if (band.layer(b, cells[i]) >= first && patches.has(b, cells[i]))
        set(cells[i], std::abs(patches.foot(b, i).distance));
  }
  exchange.scalar(blocks, phi, ScalarGhosts::level_set);
  if (history != nullptr) carry_history(blocks, exchange, was, band, phi, *history);
}

template void locate_surface(const std::vector<Block<2>>&, const Exchange<2>&, const std::vector<Field>&, int,
                             Band<2>&, SurfacePatches<2>&);
template void locate_surface(const std::vector<Block<3>>&, const Exchange<3>&, const std::vector<Field>&, int,
                             Band<3>&, SurfacePatches<3>&);
template void reinitialise(const std::vector<Block<2>>&, const Exchange<2>&, int, InterfaceCells,
                           std::vector<Field>&, Band<2>&, SurfacePatches<2>&, std::vector<Field>*);
template void reinitialise(const std::vector<Block<3>>&, const Exchange<3>&, int, InterfaceCells,
                           std::vector<Field>&, Band<3>&, SurfacePatches<3>&, std::vector<Field>*);

}  // namespace littoral::fv
