#pragma once

#include <array>
#include <functional>
#include <string>

#include "grid/block.hpp"

namespace littoral::fv {

/// Sets node_extent, ghost nodes, centres, volumes, face area vectors and statuses (computed inside, fringe
/// in the ghosts) from block.name, extent, periodic and the inner nodes. Ghost nodes are the mirror image of
/// the inner ones through the face's node, or, where periodic, the image of the opposite side.
/// Cells are closed: the area vectors of each sum to zero to round-off.
/// throws ConfigError naming block and cell where a volume is not positive
template <int D>
void set_metrics(Block<D>& block);

/// Recomputes `solved` from the statuses. Call after any change of status.
template <int D>
void set_solved_mask(Block<D>& block);

/// An empty block: sizes set, inner nodes at position(i, j, k), metrics set.
template <int D>
Block<D> make_block(const std::string& name, const std::array<int, D>& cells,
                    const std::array<bool, D>& periodic,
                    const std::function<std::array<double, D>(const std::array<int, D>&)>& position);

}  // namespace littoral::fv
