#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace littoral::sph {

using Point2 = std::array<double, 2>;  // (x, z)

/// Closest point of the edge of a plane section; distance negative inside.
struct EdgePoint {
  Point2 point{};
  Point2 normal{};
  double distance = 0.0;
  bool curved = false;
};

/// Of a disc about the origin.
EdgePoint closest_on_disc(double radius, const Point2& x);
/// Of a convex polygon, corners anticlockwise in (x, z).
EdgePoint closest_on_polygon(const std::vector<Point2>& corners, const Point2& x);

}  // namespace littoral::sph
