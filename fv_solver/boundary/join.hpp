#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace littoral::fv {

/// The other side of a point-to-point join, seen from a window: a range of cells along a face of a block,
/// and how the window's directions run there. Blocks may meet in any orientation, also with themselves.
template <int D>
struct Join {
  std::size_t block = 0;
  int direction = 0;               // of the face there
  int side = 0;                    // 0 lower, 1 upper
  std::array<int, D> lower{};      // first cell there, tangential directions; entry [direction] is not used
  std::array<int, D> upper{};      // one past the last cell
  std::array<int, D> axis{};       // [direction here] direction there; normal goes to normal
  std::array<bool, D> reversed{};  // [direction here] tangential directions: runs against `axis`
  std::array<double, D> offset{};  // [m] x here = x there + offset: not 0 for a periodic pair
};

/// One side of a join on one level of any hierarchy of blocks: its face and range, and the other side.
template <int D>
struct JoinSide {
  std::size_t block = 0;
  int direction = 0, side = 0;
  std::array<int, D> lower{}, upper{};  // tangential directions
  Join<D> there;

  /// The cell of `there.block` whose place a cell of this block has. in index: `layer` cells beyond the face
  /// in the normal direction (0: first ghost); tangential entries may lie beyond the window.
  std::array<int, D> image(const std::array<int, D>& index, int layer,
                           const std::array<int, D>& cells_there) const {
    std::array<int, D> other{};
    for (std::size_t d = 0; d < D; ++d) {
      const auto a = static_cast<std::size_t>(there.axis[d]);
      if (static_cast<int>(d) == direction)
        other[a] = there.side == 0 ? layer : cells_there[a] - 1 - layer;
      else if (there.reversed[d])
        other[a] = there.upper[a] - 1 - (index[d] - lower[d]);
      else
        other[a] = there.lower[a] + (index[d] - lower[d]);
    }
    return other;
  }
  /// Whether direction d here and its image there run the same way.
  bool same_way(std::size_t d) const {
    return static_cast<int>(d) == direction ? side != there.side : !there.reversed[d];
  }
};

/// What a window asks for before joins are found (grid/find_joins.hpp).
template <int D>
struct JoinRequest {
  enum class Kind { none, if_met, required };
  Kind kind = Kind::none;
  std::string block;                             // "" : any
  int direction = -1, side = -1;                 // of that block; -1: any
  std::vector<std::array<double, D>> offsets{};  // [m] further ones to try: x here = x there + offset
  std::string otherwise;                         // advice if nothing is met
};

}  // namespace littoral::fv
