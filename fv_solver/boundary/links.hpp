#pragma once

#include <cstddef>
#include <vector>

#include "boundary/join.hpp"
#include "grid/block.hpp"

namespace littoral::fv {

/// Cells of one block whose values are those of other cells, given once as a list of copies.
struct CellCopies {
  std::size_t to_block = 0, from_block = 0;
  std::vector<std::ptrdiff_t> to, from;  // offsets, of one length
};

/// The ghosts behind all joins of a set of blocks. Beside a corner of a block a ghost belongs to several
/// faces; there the join has the last word, through the other block's own ghosts. The copies are ordered so
/// that each reads what is already right: ghosts beyond a face (which read inner cells), then beyond an edge
/// (which read face ghosts), then beyond a corner. pre of copying: the ghosts behind all other windows are
/// current
template <int D>
class JoinLinks {
 public:
  JoinLinks() = default;
  /// layers: of ghosts, at most k_ghost
  JoinLinks(const std::vector<JoinSide<D>>& joins, const std::vector<Extent<D>>& extents, int layers);

  bool empty() const { return copies_[0].empty(); }
  /// body(const CellCopies&), in order. faces_only: not the ghosts beyond edges and corners
  template <class Body>
  void for_each(Body&& body, bool faces_only = false) const {
    for (std::size_t k = 0; k < (faces_only ? 1 : copies_.size()); ++k)
      for (const CellCopies& c : copies_[k]) body(c);
  }
  /// fields[block] of the layout of cell arrays
  template <class Fields>
  void copy(Fields&& field_of, bool faces_only = false) const {
    for_each(
        [&](const CellCopies& c) {
          auto& to = field_of(c.to_block);
          const auto& from = field_of(c.from_block);
          for (std::size_t i = 0; i < c.to.size(); ++i)
            to[static_cast<std::size_t>(c.to[i])] = from[static_cast<std::size_t>(c.from[i])];
        },
        faces_only);
  }

 private:
  std::array<std::vector<CellCopies>, D> copies_;  // [faces a ghost is beyond, less one]
};

/// All join windows of the blocks.
template <int D>
std::vector<JoinSide<D>> join_sides(const std::vector<Block<D>>& blocks);

/// body(index, layer, beyond) for each ghost behind a join, `beyond` block faces less one; layer 0 is next to
/// the face. The window grows by `layers` where it touches the block's edge.
template <int D, class Body>
void for_each_ghost(const JoinSide<D>& side, const std::array<int, D>& cells, int layers, Body&& body);

}  // namespace littoral::fv

#include "grid/loops.hpp"

namespace littoral::fv {

template <int D, class Body>
void for_each_ghost(const JoinSide<D>& side, const std::array<int, D>& cells, int layers, Body&& body) {
  const auto n = static_cast<std::size_t>(side.direction);
  std::array<int, D> lower = side.lower, upper = side.upper;
  for (std::size_t d = 0; d < D; ++d) {
    if (lower[d] == 0) lower[d] = -layers;
    if (upper[d] == cells[d]) upper[d] += layers;
  }
  for (int layer = 0; layer < layers; ++layer) {
    lower[n] = side.side == 0 ? -1 - layer : cells[n] + layer;
    upper[n] = lower[n] + 1;
    for_each_index<D>(lower, upper, [&](const std::array<int, D>& index) {
      std::size_t beyond = 0;
      for (std::size_t d = 0; d < D; ++d)
        if (d != n && (index[d] < 0 || index[d] >= cells[d])) ++beyond;
      body(index, layer, beyond);
    });
  }
}

}  // namespace littoral::fv
