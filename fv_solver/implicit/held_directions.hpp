#pragma once

#include <array>
#include <vector>

#include "implicit/level_grid.hpp"
#include "parallel/layout.hpp"

namespace littoral::fv {

/// Directions that a block does not halve on the way to the next level (semi-coarsening). In a cell that is
/// thin in two directions and long in the third, lines in one of the two leave the other's error as it is
/// wherever it is smooth there and rough along the third; a grid halved in the third, too, does not see it.
/// So a direction is held while it is the long one in more than a twentieth of the cells, at most two of
/// them, and only where another one can still be halved. In the plane there are none. in    ratio: 2 where
/// the block could be halved.  pure
template <int D>
std::array<bool, D> held_directions(const LevelGrid<D>& grid, const std::array<int, D>& ratio);

/// The same for the blocks of all ranks, in the order of the layout.
/// in    grids of this rank's own blocks; shapes of all.  comm collective
template <int D>
std::vector<std::array<bool, D>> all_held_directions(const std::vector<const LevelGrid<D>*>& grids,
                                                     const std::vector<BlockShape<D>>& shapes,
                                                     const Owners& owners);

}  // namespace littoral::fv
