#pragma once

#include <vector>

#include "grid/block.hpp"

namespace littoral::fv {

/// Whether these blocks hold a closed body of water: no boundary and no cell of theirs knows a pressure or
/// lets water out, so that with c infinite the pressure is free to a constant. Of this rank's blocks. pure
template <int D>
bool closed_body(const std::vector<Block<D>>& blocks);

}  // namespace littoral::fv
