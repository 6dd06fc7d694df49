#pragma once

#include <array>
#include <string>
#include <vector>

#include "grid/block.hpp"

namespace littoral::fv {

/// An extreme of a measure over a block and the cell that has it.
template <int D>
struct Worst {
  double value = 0.0;
  std::array<int, D> cell{};
};

/// What a block's cells look like.
template <int D>
struct Quality {
  double smallest = 0.0, largest = 0.0;  // [m^D] volumes
  Worst<D> skewness;    // [degree] between a face's normal and the line through the centres beside it
  Worst<D> stretching;  // [-] thickness of a cell over that of its thinner neighbour, across joins too
  Worst<D> aspect;      // [-] thickest over thinnest direction, volume over face area
};

/// pre: metrics set, ghosts behind joins included. pure
template <int D>
Quality<D> quality(const Block<D>& block);

/// One line a block, and one for the join that cuts the thinnest cells, if they are thin (lines of the
/// smoother end there).
template <int D>
std::vector<std::string> quality_report(const std::vector<Block<D>>& blocks);

}  // namespace littoral::fv
