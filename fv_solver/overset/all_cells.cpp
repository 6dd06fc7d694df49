#include "overset/all_cells.hpp"

#include <cstdio>

#include "grid/loops.hpp"
#include "grid/space.hpp"
#include "littoral/error.hpp"

namespace littoral::fv {

template <int D>
AllCells<D>::AllCells(const std::vector<const VectorField<D>*>& own_centre,
                      const std::vector<std::vector<std::uint8_t>>& own_usable,
                      const std::vector<BlockShape<D>>& shapes, const Owners& owners) {
  const std::vector<std::size_t> mine = owners.mine();
  std::vector<double> x;
  std::vector<std::uint8_t> is;
  for (std::size_t i = 0; i < mine.size(); ++i)
    for_each_index<D>({}, shapes[mine[i]].extent.n, [&](const std::array<int, D>& index) {
      const auto c = static_cast<std::size_t>(shapes[mine[i]].extent.at(index));
      for (const Field& component : *own_centre[i]) x.push_back(component[c]);
      is.push_back(own_usable[i][c]);
    });
  const std::vector<double> all_x = owners.ranks.gather(x);
  const std::vector<std::uint8_t> all_is = owners.ranks.gather(is);
  std::size_t at = 0;  // in the order of the ranks, of each its blocks
  centre.resize(shapes.size());
  usable.resize(shapes.size());
  for (int rank = 0; rank < owners.ranks.size(); ++rank)
    for (std::size_t b = 0; b < shapes.size(); ++b) {
      if (owners.rank[b] != rank) continue;
      for (auto& component : centre[b]) component.assign(shapes[b].extent.size, 0.0);
      usable[b].assign(shapes[b].extent.size, 0);
      for_each_index<D>({}, shapes[b].extent.n, [&](const std::array<int, D>& index) {
        const auto c = static_cast<std::size_t>(shapes[b].extent.at(index));
        for (std::size_t k = 0; k < D; ++k) centre[b][k][c] = all_x[at * D + k];
        usable[b][c] = all_is[at++];
      });
    }
}

template <int D>
std::vector<OverlapBlock<D>> AllCells<D>::blocks(const std::vector<BlockShape<D>>& shapes,
                                                 const std::vector<std::size_t>& component) const {
  std::vector<OverlapBlock<D>> all;
  for (std::size_t b = 0; b < shapes.size(); ++b)
    all.push_back({&shapes[b].extent, &centre[b], usable[b], component[b]});
  return all;
}

template <int D>
GhostSources<D> ghost_sources(const std::vector<BlockShape<D>>& shapes,
                              const std::vector<std::array<std::array<double, D>, D>>& period,
                              const std::vector<JoinSide<D>>& joins) {
  std::vector<Extent<D>> extents;
  std::vector<std::array<bool, D>> periodic;
  for (const BlockShape<D>& shape : shapes) {
    extents.push_back(shape.extent);
    periodic.push_back(shape.periodic);
  }
  return GhostSources<D>(extents, periodic, period, joins);
}

template <int D>
DonorLinks<D> seek_donors(const std::vector<Block<D>>& blocks, const Layout<D>& layout) {
  const std::vector<std::size_t> mine = layout.owners.mine();
  std::vector<const VectorField<D>*> centre;
  std::vector<std::vector<std::uint8_t>> usable;
  std::vector<CellName<D>> receivers, orphans;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    centre.push_back(&blocks[i].centre);
    usable.emplace_back(blocks[i].extent.size, 0);
    for_each_index<D>({}, blocks[i].extent.n, [&](const std::array<int, D>& index) {
      const std::ptrdiff_t c = blocks[i].extent.at(index);
      const CellStatus status = blocks[i].status[static_cast<std::size_t>(c)];
      if (status == CellStatus::interpolated) receivers.push_back({mine[i], c});
      usable.back()[static_cast<std::size_t>(c)] =
          status != CellStatus::interpolated && status != CellStatus::blanked ? 1 : 0;
    });
  }
  const AllCells<D> cells(centre, usable, layout.shape, layout.owners);
  const OversetLinks<D> links =
      find_donors<D>(cells.blocks(layout.shape, layout.component),
                     ghost_sources<D>(layout.shape, layout.period, layout.joins), receivers, false, orphans);
  layout.owners.ranks.template together<ConfigError>([&] {
    if (orphans.empty()) return;
    const Block<D>& block = blocks[layout.owners.number[orphans[0].block]];
    const coupler::Vec3 x = centre_in_space(block, orphans[0].cell);
    char text[400];
    std::snprintf(
        text, sizeof text,
        "overset: %zu cells that take their values from another grid find none beside the SPH region, "
        "as in block '%s' at (%.6g, %.6g, %.6g) m: keep the region's faces some cells away from the "
        "edge of the overlap, or let it hold the overlap as a whole",
        orphans.size(), block.name.c_str(), x[0], x[1], x[2]);
    throw ConfigError(text);
  });
  return DonorLinks<D>(links, layout.owners);
}

template struct AllCells<2>;
template struct AllCells<3>;
template GhostSources<2> ghost_sources<2>(const std::vector<BlockShape<2>>&,
                                          const std::vector<std::array<std::array<double, 2>, 2>>&,
                                          const std::vector<JoinSide<2>>&);
template GhostSources<3> ghost_sources<3>(const std::vector<BlockShape<3>>&,
                                          const std::vector<std::array<std::array<double, 3>, 3>>&,
                                          const std::vector<JoinSide<3>>&);
template DonorLinks<2> seek_donors(const std::vector<Block<2>>&, const Layout<2>&);
template DonorLinks<3> seek_donors(const std::vector<Block<3>>&, const Layout<3>&);

}  // namespace littoral::fv
