#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "boundary/join.hpp"
#include "grid/block.hpp"
#include "parallel/ranks.hpp"

namespace littoral::fv {

/// Which rank has which block, and under which number. Blocks have one numbering over all ranks, which joins
/// and links use; loops use that of the rank's own blocks.
struct Owners {
  Ranks ranks;
  std::vector<int> rank;            // of each block
  std::vector<std::size_t> number;  // among its rank's own blocks

  static Owners all_here(std::size_t n_blocks);
  bool here(std::size_t block) const { return rank[block] == ranks.rank(); }
  /// Blocks of this rank, in order.
  std::vector<std::size_t> mine() const;
};

template <int D>
struct BlockShape {
  Extent<D> extent;
  std::array<bool, D> periodic{};
};

/// What every rank knows of all blocks: shapes, joins, owners; no fields.
template <int D>
struct Layout {
  Owners owners;
  std::vector<BlockShape<D>> shape;
  std::vector<JoinSide<D>> joins;
  std::vector<std::size_t> component;                        // of overlapping grids, see components()
  std::vector<std::array<std::array<double, D>, D>> period;  // [m] see GhostSources

  /// A block of the grid as it was described, before it was cut.
  struct Whole {
    std::string name;
    std::array<int, D> cells{};
    double mean_volume = 0.0;  // [m^D] of a cell
  };
  /// Where a block lies in its whole.
  struct Part {
    std::size_t whole = 0;
    std::array<int, D> first{};  // cell
  };
  std::vector<Whole> whole;
  std::vector<Part> part;  // of each block

  std::size_t size() const { return shape.size(); }
};

/// Of uncut blocks that are all here.
template <int D>
Layout<D> layout_of(const std::vector<Block<D>>& blocks);

}  // namespace littoral::fv
