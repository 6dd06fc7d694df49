#pragma once

#include <vector>

#include "parallel/layout.hpp"

namespace littoral::fv {

/// Fields of the blocks as they were before they were cut, ghosts included, on the root: what is written does
/// not depend on the number of ranks. own: one field for each block of this rank. Elsewhere the result is
/// empty. comm collective
template <int D>
std::vector<Field> gather_whole(const Layout<D>& layout, const std::vector<const Field*>& own);

/// The part of a whole block's field that an own block has, ghosts included. b: among all blocks
template <int D>
Field part_of(const Layout<D>& layout, std::size_t b, const Field& whole);

}  // namespace littoral::fv
