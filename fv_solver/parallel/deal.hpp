#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "grid/block.hpp"

namespace littoral::fv {

/// A part of a block, and the rank that gets it.
template <int D>
struct Piece {
  std::size_t whole = 0;
  std::array<int, D> lower{}, upper{};  // cells of the whole
  int rank = 0;
  std::int64_t cells() const {
    std::int64_t n = 1;
    for (std::size_t d = 0; d < D; ++d) n *= upper[d] - lower[d];
    return n;
  }
};

/// Where a block may be cut.
template <int D>
struct CutPlanes {
  std::array<int, D> cells{};
  std::array<std::vector<std::uint8_t>, D> may;  // [direction][i]: between cells i - 1 and i
};

/// Planes of the blocks that do not cut the thin cells between walls: lines through a layer are solved as a
/// whole only within a block (implicit/README.md). layers: cut those, too
template <int D>
std::vector<CutPlanes<D>> cut_planes(const std::vector<Block<D>>& blocks, bool layers);

/// Deals blocks to ranks by their cells: halves of the ranks get halves of the cells, recursively, and a
/// block that fits into neither half is cut. A cut is chosen for equal loads, a small face, and a count of
/// cells that can still be halved often. Pieces are ordered by block, then by place. pure throws ConfigError
/// where a rank would get nothing
template <int D>
std::vector<Piece<D>> deal(const std::vector<CutPlanes<D>>& blocks, int n_ranks);

}  // namespace littoral::fv
