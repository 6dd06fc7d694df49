#pragma once

#include <cstddef>

#include "coupling/axes.hpp"

namespace littoral::sph {

/// A piece of an outer face, of about dx^(D-1).
template <int D>
struct FaceElement {
  Point<D> centre{};       // [m]
  Point<D> half{};         // [m] half its extent in each direction, 0 in the normal one
  std::size_t axis = 0;    // direction of the normal
  std::size_t side = 0;    // lower or upper face of its box
  double inward = 1.0;     // +1: the inward normal points to larger coordinates
  double area = 0.0;       // [m^(D-1)]
  std::size_t box = 0;     // region box it bounds
  double share = 1.0;      // mass of its particles over that of a whole one
  bool stretched = false;  // a row of a column that follows the level: wholly wet, or without extent
};

}  // namespace littoral::sph
