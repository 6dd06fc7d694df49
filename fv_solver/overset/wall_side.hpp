#pragma once

#include <array>
#include <vector>

#include "grid/block.hpp"

namespace littoral::fv {

/// The walls of some blocks as facets (segments in a plane, triangles in space) that know their wet side, so
/// that places inside a body can be told from places in the water, also where the body is open at symmetry
/// planes or periodic ends.
template <int D>
class WallSide {
 public:
  /// Facets of all wall and slip windows of the given blocks.
  WallSide(const std::vector<Block<D>>& blocks, const std::vector<std::size_t>& which);

  bool empty() const { return facets_.empty(); }
  /// Whether x lies behind the nearest wall. Where several facets are equally near (at an edge) the one seen
  /// at the steepest angle decides, which is right at convex and concave edges; on a sheet that is wet on
  /// both sides every place is in the water.
  bool behind(const std::array<double, D>& x) const;

 private:
  using Point = std::array<double, D>;
  struct Facet {
    std::array<Point, D> corner;
    Point normal;  // unit, into the water
  };
  struct Chunk {  // consecutive facets and the box around them
    std::size_t begin, end;
    Point lower, upper;
  };
  void add_face(const Block<D>& block, const Window<D>& window, const std::array<int, D>& index);
  void bound();

  std::vector<Facet> facets_;
  std::vector<Chunk> chunks_;
};

extern template class WallSide<2>;
extern template class WallSide<3>;

}  // namespace littoral::fv
