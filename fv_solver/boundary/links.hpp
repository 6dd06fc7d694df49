#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "boundary/join.hpp"
#include "grid/block.hpp"
#include "parallel/halo.hpp"
#include "parallel/layout.hpp"

namespace littoral::fv {

/// The ghosts behind all joins of a set of blocks: each is the copy of one cell. Beside a corner of a block a
/// ghost belongs to several faces; there the join has the last word, and the cell is found through the other
/// block's own ghosts: an inner cell, or a ghost behind another window. So all copies are made in one pass,
/// and one message a neighbour rank holds what it needs. pre of copying: the ghosts behind all other windows
/// are current
template <int D>
class JoinLinks {
 public:
  JoinLinks() = default;
  /// joins and extents of all blocks of all ranks; layers: of ghosts, at most k_ghost
  JoinLinks(const std::vector<JoinSide<D>>& joins, const std::vector<Extent<D>>& extents, int layers,
            const Owners& owners);
  JoinLinks(const std::vector<JoinSide<D>>& joins, const std::vector<Extent<D>>& extents, int layers)
      : JoinLinks(joins, extents, layers, Owners::all_here(extents.size())) {}

  /// Copies several fields at once: fields[own block][k], of the layout of cell arrays. T: double, float
  /// faces_only: not the ghosts beyond edges and corners    comm: neighbours
  template <class T>
  void copy_fields(const std::vector<std::vector<T*>>& fields, bool faces_only = false) const;
  /// One field; field_of(own block)
  template <class FieldOf>
  void copy(FieldOf&& field_of, bool faces_only = false) const {
    using T = std::decay_t<decltype(field_of(std::size_t{0})[0])>;
    std::vector<std::vector<T*>> fields;
    for (std::size_t b = 0; b < n_blocks_; ++b) fields.push_back({field_of(b).data()});
    copy_fields<T>(fields, faces_only);
  }

 private:
  struct Cells {  // of one own block, copied to or from one other
    std::size_t block = 0, other = 0;
    std::vector<std::ptrdiff_t> cell;
  };
  struct Copies {
    Cells to, from;
  };
  struct Peer {
    int rank = 0;
    std::vector<Cells> gives, takes;
    std::size_t n_gives = 0, n_takes = 0;
  };
  struct Pass {
    std::vector<Copies> copies;
    std::vector<Peer> peers;
    struct Sized {
      std::size_t bytes;  // an entry
      Halo halo;
    };
    mutable std::vector<Sized> halos;  // made at the first copy of so many fields
  };
  struct Copy {  // numbers of all blocks
    std::size_t to_block, from_block;
    std::ptrdiff_t to, from;
  };
  static void add(Pass& pass, const Copy& copy, const Owners& owners);
  Halo& halo(const Pass& pass, std::size_t bytes) const;

  Ranks ranks_;
  std::size_t n_blocks_ = 0;  // own ones
  Pass all_, faces_;
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
