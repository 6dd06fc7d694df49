#pragma once

#include <vector>

#include "grid/block.hpp"
#include "littoral/coupler/types.hpp"

namespace littoral::fv {

/// A line against gravity through the grid, on which the surface's height is read: phi is interpolated
/// trilinearly at places half a cell apart. comm local
template <int D>
class ElevationLine {
 public:
  /// through: a place on the line; up: unit vector against gravity, both in space. found() is false where the
  /// line meets no cell.
  ElevationLine(const std::vector<Block<D>>& blocks, const coupler::Vec3& through, const coupler::Vec3& up);
  bool found() const { return !places_.empty(); }

  /// Height x . up [m] of the highest place where air lies on water; NaN where there is none.
  /// pre ghosts of phi current
  double height(const std::vector<Field>& phi) const;

 private:
  struct Place {
    double height = 0.0;   // [m] along up
    bool follows = false;  // on the place before, without a gap
    std::vector<std::size_t> block, cell;
    std::vector<double> weight;
  };
  std::vector<Place> places_;  // upward
};

}  // namespace littoral::fv
