#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "implicit/lanes.hpp"
#include "implicit/level_grid.hpp"

namespace littoral::fv {

/// All grid lines of one direction, coloured so that no two neighbours share a colour (zebra; a periodic
/// direction with an odd count needs a third), each colour's lines bundled by k_lanes.
struct LineLayout {
  int direction = 0;
  int length = 0;             // cells a line
  std::ptrdiff_t stride = 0;  // between cells of a line
  bool cyclic = false;        // the line closes on itself
  struct Bundle {
    std::array<std::ptrdiff_t, k_lanes>
        first{};  // offset of each line's first cell; spare lanes repeat the last
    int n_lines = 0;
    LanePattern spacing = LanePattern::any;  // of `first`
  };
  std::vector<Bundle> bundles;          // colour by colour
  std::vector<std::size_t> colour_end;  // bundles of colour i: [colour_end[i-1], colour_end[i])
  int n_colours() const { return static_cast<int>(colour_end.size()); }
  std::size_t colour_begin(int colour) const {
    return colour == 0 ? 0 : colour_end[static_cast<std::size_t>(colour) - 1];
  }
};

template <int D>
LineLayout line_layout(const LevelGrid<D>& grid, int direction);

/// Thickness of a cell along each direction, V/S [m]: coupling through the faces of a direction goes with its
/// inverse square. pure
template <int D>
std::array<double, D> thickness(const LevelGrid<D>& grid, std::ptrdiff_t c);

/// Directions in which cells are so thin that point-wise smoothing fails: the stiffest first; further ones
/// only where more than a twentieth of the cells are at least twice as thin there as in those chosen.
/// On an isotropic grid: a direction that is not periodic, direction 1 unless the last is much longer.
template <int D>
std::vector<int> stiff_directions(const LevelGrid<D>& grid);

}  // namespace littoral::fv
