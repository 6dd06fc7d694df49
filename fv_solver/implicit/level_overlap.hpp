#pragma once

#include <vector>

#include "boundary/join.hpp"
#include "implicit/level_grid.hpp"
#include "overset/donors.hpp"

namespace littoral::fv {

/// How the blocks of one level overlap: what the interpolation of corrections between them needs.
template <int D>
struct LevelOverlap {
  std::vector<VectorField<D>> centre;                        // [m] of each block's cells, inner ones
  std::vector<std::size_t> component;                        // of each block
  std::vector<std::array<std::array<double, D>, D>> period;  // see GhostSources
  OversetLinks<D> links;                                     // of corrections

  bool empty() const { return centre.empty(); }
};

/// Of the finest level; empty where no cell is interpolated.
template <int D>
LevelOverlap<D> level_overlap(const std::vector<Block<D>>& blocks);

/// Of the next level: centres are means of the children's, weighted with volume.
template <int D>
LevelOverlap<D> coarsen_overlap(const LevelOverlap<D>& fine,
                                const std::vector<const LevelGrid<D>*>& fine_grids,
                                const std::vector<std::array<int, D>>& ratios,
                                const std::vector<const LevelGrid<D>*>& coarse_grids);

/// Finds the links of a level: every cell that is not solved, lies beside one that is, and belongs to a
/// fringe or hole between components (interpolated or blanked) gets its correction from solved cells of other
/// components on the same level; a fringe whose dual cell is not there, which happens where a coarse fringe
/// lies a coarse cell away, from the nearest one.
template <int D>
void link_corrections(LevelOverlap<D>& overlap, const std::vector<const LevelGrid<D>*>& grids,
                      const std::vector<JoinSide<D>>& joins);

}  // namespace littoral::fv
