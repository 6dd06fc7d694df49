#pragma once

#include <cstdint>
#include <vector>

#include "overset/donor_links.hpp"
#include "overset/donors.hpp"
#include "parallel/layout.hpp"

namespace littoral::fv {

/// Of the blocks of all ranks: cell centres, and which cells may be donors. Gathered for a search, since a
/// place may lie in anybody's block, and given up after it.
template <int D>
struct AllCells {
  std::vector<VectorField<D>> centre;  // [m] inner cells
  std::vector<std::vector<std::uint8_t>> usable;

  /// own: of this rank's blocks, of the layout of cell arrays. comm collective
  AllCells(const std::vector<const VectorField<D>*>& own_centre,
           const std::vector<std::vector<std::uint8_t>>& own_usable, const std::vector<BlockShape<D>>& shapes,
           const Owners& owners);

  /// component: of each block
  std::vector<OverlapBlock<D>> blocks(const std::vector<BlockShape<D>>& shapes,
                                      const std::vector<std::size_t>& component) const;
};

template <int D>
GhostSources<D> ghost_sources(const std::vector<BlockShape<D>>& shapes,
                              const std::vector<std::array<std::array<double, D>, D>>& period,
                              const std::vector<JoinSide<D>>& joins);

/// Donors for the interpolated cells of this rank's blocks by the statuses as they are: cells that are solved
/// or imposed. Wanted where statuses have changed since the grid was assembled, as by a particle region. comm
/// collective. throws ConfigError (on all ranks) naming a cell without donors
template <int D>
DonorLinks<D> seek_donors(const std::vector<Block<D>>& blocks, const Layout<D>& layout);

}  // namespace littoral::fv
