#pragma once

#include <limits>
#include <vector>

#include "grid/block.hpp"
#include "littoral/coupler/types.hpp"

namespace littoral::fv {

/// Height of the surface on a line in one block.
struct Elevation {
  double height = std::numeric_limits<double>::quiet_NaN();  // [m] x . up; NaN: none
  double reach = 0.0;                                        // [m] height of the cells there
  double component = 0.0;                                    // of the block: higher ones lie above
};

/// Of what the blocks of all overlapping grids read on one line the highest surface, in the uppermost of the
/// grids that see it (those whose height is a cell's from it); the same however blocks are cut. pure
Elevation highest(const std::vector<Elevation>& readings);

/// A line against gravity through a block, on which the surface's height is read: phi is interpolated
/// trilinearly at places half a cell apart and wherever the line passes from the centres of some cells to
/// others, so that the result does not depend on where it begins. comm local
template <int D>
class ElevationLine {
 public:
  /// through: a place on the line; up: unit vector against gravity, both in space. found() is false where the
  /// line meets no cell.
  ElevationLine(const Block<D>& block, const coupler::Vec3& through, const coupler::Vec3& up);
  bool found() const { return !places_.empty(); }

  /// The highest place where air lies on water; `component` is left alone. pre ghosts of phi current
  Elevation read(const Field& phi) const;

 private:
  struct Place {
    double height = 0.0;   // [m] along up
    double reach = 0.0;    // [m] height of the cells around
    bool follows = false;  // on the place before, without a gap
    std::vector<std::size_t> cell;
    std::vector<double> weight;
  };
  std::vector<Place> places_;  // upward
};

}  // namespace littoral::fv
