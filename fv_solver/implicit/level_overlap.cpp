#include "implicit/level_overlap.hpp"

#include <algorithm>

#include "overset/all_cells.hpp"

namespace littoral::fv {

template <int D>
LevelOverlap<D> level_overlap(const std::vector<Block<D>>& blocks, const Layout<D>& layout) {
  LevelOverlap<D> overlap;
  const auto interpolated = [](const Block<D>& block) {
    return std::find(block.status.begin(), block.status.end(), CellStatus::interpolated) !=
           block.status.end();
  };
  overlap.any = layout.owners.ranks.any(std::any_of(blocks.begin(), blocks.end(), interpolated));
  if (!overlap.any) return overlap;
  for (const Block<D>& block : blocks) overlap.centre.push_back(block.centre);
  return overlap;
}

template <int D>
LevelOverlap<D> coarsen_overlap(const LevelOverlap<D>& fine,
                                const std::vector<const LevelGrid<D>*>& fine_grids,
                                const std::vector<const LevelGrid<D>*>& coarse_grids) {
  LevelOverlap<D> coarse;
  coarse.any = fine.any;
  for (std::size_t b = 0; b < fine.centre.size(); ++b) {
    const LevelGrid<D>&from = *fine_grids[b], &to = *coarse_grids[b];
    std::array<int, D> ratio;
    for (std::size_t d = 0; d < D; ++d) ratio[d] = from.extent.n[d] == to.extent.n[d] ? 1 : 2;
    VectorField<D> centre;
    for (auto& component : centre) component.assign(to.extent.size, 0.0);
    for_each_cell<D>(from.extent, [&](const std::array<int, D>& index, std::ptrdiff_t c) {
      std::array<int, D> up;
      for (std::size_t d = 0; d < D; ++d) up[d] = index[d] / ratio[d];
      const auto f = static_cast<std::size_t>(c), p = static_cast<std::size_t>(to.extent.at(up));
      for (std::size_t k = 0; k < D; ++k)
        centre[k][p] += fine.centre[b][k][f] * from.volume[f] / to.volume[p];
    });
    coarse.centre.push_back(std::move(centre));
  }
  return coarse;
}

namespace {

/// Ghosts beyond an overset face with a solved cell beside it, as on coarse levels, where the fringe is less
/// than half a cell: one cell further out, their places continue the centres. b: among all blocks
template <int D>
void add_open_ghosts(const LevelGrid<D>& grid, const GhostSources<D>& sources, std::size_t b,
                     VectorField<D>& centre, std::vector<CellName<D>>& receivers) {
  for_each_cell<D>(grid.extent, [&](const std::array<int, D>& index, std::ptrdiff_t c) {
    if (!grid.solved(c)) return;
    for (std::size_t d = 0; d < D; ++d)
      for (std::size_t side = 0; side < 2; ++side) {
        if (index[d] != (side == 0 ? 0 : grid.extent.n[d] - 1)) continue;
        if (grid.edge[d][side][grid.face_index(static_cast<int>(d), index)] != EdgeCondition::link) continue;
        const std::ptrdiff_t outward = side == 0 ? -grid.extent.stride[d] : grid.extent.stride[d];
        if (sources.find(b, c + outward) != nullptr) continue;
        const std::ptrdiff_t inner = grid.extent.n[d] > 1 ? c - outward : c;
        for (std::size_t k = 0; k < D; ++k)
          centre[k][static_cast<std::size_t>(c + outward)] =
              2.0 * centre[k][static_cast<std::size_t>(c)] - centre[k][static_cast<std::size_t>(inner)];
        receivers.push_back({b, c + outward});
      }
  });
}

}  // namespace

template <int D>
void link_corrections(LevelOverlap<D>& overlap, const std::vector<const LevelGrid<D>*>& grids,
                      const std::vector<BlockShape<D>>& shapes, const std::vector<JoinSide<D>>& joins,
                      const Layout<D>& layout) {
  const Owners& owners = layout.owners;
  const GhostSources<D> sources = ghost_sources<D>(shapes, layout.period, joins);
  std::vector<const VectorField<D>*> centre;
  std::vector<std::vector<std::uint8_t>> solved;
  for (std::size_t i = 0; i < grids.size(); ++i) {
    centre.push_back(&overlap.centre[i]);
    solved.emplace_back(grids[i]->extent.size, 0);
    for_each_cell<D>(grids[i]->extent, [&](const auto&, std::ptrdiff_t c) {
      solved.back()[static_cast<std::size_t>(c)] = grids[i]->solved(c) ? 1 : 0;
    });
  }
  AllCells<D> cells(centre, solved, shapes, owners);
  std::vector<CellName<D>> fringes, holes, orphans;
  const std::vector<std::size_t> mine = owners.mine();
  for (std::size_t i = 0; i < grids.size(); ++i) {
    const std::size_t b = mine[i];
    for_each_cell<D>(shapes[b].extent, [&](const auto&, std::ptrdiff_t c) {
      const CellStatus status = grids[i]->status[static_cast<std::size_t>(c)];
      if (status != CellStatus::interpolated && status != CellStatus::blanked) return;
      bool beside = false;
      for (std::size_t d = 0; d < D; ++d)
        for (const std::ptrdiff_t step : {-shapes[b].extent.stride[d], shapes[b].extent.stride[d]}) {
          const GhostSource<D>* ghost = sources.find(b, c + step);
          beside = beside ||
                   (ghost != nullptr ? cells.usable[ghost->block][static_cast<std::size_t>(ghost->cell)] != 0
                                     : cells.usable[b][static_cast<std::size_t>(c + step)] != 0);
        }
      if (beside) (status == CellStatus::interpolated ? fringes : holes).push_back({b, c});
    });
    add_open_ghosts<D>(*grids[i], sources, b, cells.centre[b], fringes);
  }
  const std::vector<OverlapBlock<D>> blocks = cells.blocks(shapes, layout.component);
  OversetLinks<D> links = find_donors<D>(blocks, sources, fringes, true, orphans);
  // a hole beside solved cells is a region's where no other component is near: its correction stays 0
  const OversetLinks<D> further = find_donors<D>(blocks, sources, holes, false, orphans);
  links.receivers.insert(links.receivers.end(), further.receivers.begin(), further.receivers.end());
  overlap.links = DonorLinks<D>(links, owners);
}

template LevelOverlap<2> level_overlap<2>(const std::vector<Block<2>>&, const Layout<2>&);
template LevelOverlap<3> level_overlap<3>(const std::vector<Block<3>>&, const Layout<3>&);
template LevelOverlap<2> coarsen_overlap<2>(const LevelOverlap<2>&, const std::vector<const LevelGrid<2>*>&,
                                            const std::vector<const LevelGrid<2>*>&);
template LevelOverlap<3> coarsen_overlap<3>(const LevelOverlap<3>&, const std::vector<const LevelGrid<3>*>&,
                                            const std::vector<const LevelGrid<3>*>&);
template void link_corrections<2>(LevelOverlap<2>&, const std::vector<const LevelGrid<2>*>&,
                                  const std::vector<BlockShape<2>>&, const std::vector<JoinSide<2>>&,
                                  const Layout<2>&);
template void link_corrections<3>(LevelOverlap<3>&, const std::vector<const LevelGrid<3>*>&,
                                  const std::vector<BlockShape<3>>&, const std::vector<JoinSide<3>>&,
                                  const Layout<3>&);

}  // namespace littoral::fv
