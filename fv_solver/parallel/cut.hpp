#pragma once

#include <vector>

#include "overset/donors.hpp"
#include "parallel/deal.hpp"
#include "parallel/layout.hpp"

namespace littoral::fv {

/// A grid cut into pieces: ordinary blocks with joins.
template <int D>
struct CutGrid {
  std::vector<Block<D>> blocks;  // one a piece, in their order
  OversetLinks<D> overset;       // between them
  Layout<D> layout;
};

/// Cuts blocks with joins and statuses set into pieces that cover them (see deal). Geometry is copied, ghosts
/// included, so that a cell's residual is the one in the whole block. pure
template <int D>
CutGrid<D> cut(const std::vector<Block<D>>& whole, const OversetLinks<D>& overset,
               const std::vector<Piece<D>>& pieces, const Ranks& ranks);

}  // namespace littoral::fv
