#pragma once

#include <cstddef>
#include <vector>

#include "grid/block.hpp"

namespace littoral::fv {

/// Components of a grid: blocks connected by joins. Returns the component of each block, numbered in the
/// order of their first blocks; where components overlap, a later one lies over an earlier one. pure
template <int D>
std::vector<std::size_t> components(const std::vector<Block<D>>& blocks);

}  // namespace littoral::fv
