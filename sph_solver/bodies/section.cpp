#include "bodies/section.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace littoral::sph {

EdgePoint closest_on_disc(double radius, const Point2& x) {
  const double r = std::hypot(x[0], x[1]);
  const Point2 n = r > 0.0 ? Point2{x[0] / r, x[1] / r} : Point2{1.0, 0.0};
  return {{radius * n[0], radius * n[1]}, n, r - radius, true};
}

EdgePoint closest_on_polygon(const std::vector<Point2>& corners, const Point2& x) {
  EdgePoint best;
  double least = std::numeric_limits<double>::infinity();
  double deepest = -std::numeric_limits<double>::infinity();  // over the edges' lines: negative inside
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Point2 &a = corners[k], &b = corners[(k + 1) % corners.size()];
    const Point2 along = {b[0] - a[0], b[1] - a[1]};
    const double length2 = along[0] * along[0] + along[1] * along[1], length = std::sqrt(length2);
    const Point2 normal = {along[1] / length, -along[0] / length};
    const Point2 from = {x[0] - a[0], x[1] - a[1]};
    deepest = std::max(deepest, from[0] * normal[0] + from[1] * normal[1]);
    const double s = std::clamp((from[0] * along[0] + from[1] * along[1]) / length2, 0.0, 1.0);
    const Point2 p = {a[0] + s * along[0], a[1] + s * along[1]};
    const Point2 away = {x[0] - p[0], x[1] - p[1]};
    const double r = std::hypot(away[0], away[1]);
    if (r >= least) continue;
    least = r;
    best.point = p;
    const bool at_end = s == 0.0 || s == 1.0;
    best.normal = at_end && r > 0.0 ? Point2{away[0] / r, away[1] / r} : normal;
  }
  best.distance = deepest > 0.0 ? least : -least;
  return best;
}

}  // namespace littoral::sph
