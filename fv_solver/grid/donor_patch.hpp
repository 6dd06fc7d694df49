#pragma once

#include <vector>

#include "grid/block.hpp"
#include "littoral/coupler/fields.hpp"

namespace littoral::fv {

/// A block's cell centres with `ghost_layers` (0 to 2) of ghosts around them, as donors. Offsets of the cells
/// in the order of the patch are appended to `cells`. Blanked cells are not usable.
template <int D>
coupler::DonorPatch donor_patch(const Block<D>& block, int ghost_layers, std::vector<std::size_t>& cells);

}  // namespace littoral::fv
