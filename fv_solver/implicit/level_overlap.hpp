#pragma once

#include <vector>

#include "boundary/join.hpp"
#include "implicit/level_grid.hpp"
#include "overset/donor_links.hpp"
#include "parallel/layout.hpp"

namespace littoral::fv {

/// How the blocks of one level overlap: what the interpolation of corrections between them needs.
template <int D>
struct LevelOverlap {
  bool any = false;                    // on all ranks
  std::vector<VectorField<D>> centre;  // [m] of each own block's cells, inner ones
  DonorLinks<D> links;                 // of corrections

  bool empty() const { return !any; }
};

/// Of the finest level; empty where no cell is interpolated. comm collective
template <int D>
LevelOverlap<D> level_overlap(const std::vector<Block<D>>& blocks, const Layout<D>& layout);

/// Of the next level: centres are means of the children's, weighted with volume.
template <int D>
LevelOverlap<D> coarsen_overlap(const LevelOverlap<D>& fine,
                                const std::vector<const LevelGrid<D>*>& fine_grids,
                                const std::vector<const LevelGrid<D>*>& coarse_grids);

/// Finds the links of a level: every cell that is not solved, lies beside one that is, and belongs to a
/// fringe or hole between components (interpolated or blanked) gets its correction from solved cells of other
/// components on the same level; a fringe whose dual cell is not there, which happens where a coarse fringe
/// lies a coarse cell away, from the nearest one. For the search, and only for it, every rank gets the
/// centres of all blocks' cells and which of them are solved. grids: own ones; shapes, joins: of all blocks
/// on this level; layout: of the finest. comm collective
template <int D>
void link_corrections(LevelOverlap<D>& overlap, const std::vector<const LevelGrid<D>*>& grids,
                      const std::vector<BlockShape<D>>& shapes, const std::vector<JoinSide<D>>& joins,
                      const Layout<D>& layout);

}  // namespace littoral::fv
