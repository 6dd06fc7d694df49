#pragma once

#include <cmath>

#include "bodies/body.hpp"
#include "bodies/dummies.hpp"

namespace littoral::sph {

/// The whole periods that bring a point of the scene next to a body, which is described where it is itself:
/// of the point's images the one nearest to the middle of the body. A point within a body that is no longer
/// than the period is then found inside it, wherever it stands [m].
template <int D>
Vector3 to_nearest_image(const DomainBox<D>& box, const Body& body, const Vector3& x) {
  Vector3 shift{};
  const Vector3 middle = body.middle();
  for (std::size_t d = 0; d < D; ++d) {
    if (!box.is_periodic(d)) continue;
    const std::size_t axis = scene_axis<D>(d);
    shift[axis] = -box.length(d) * std::round((x[axis] - middle[axis]) / box.length(d));
  }
  return shift;
}

template <int D>
Vector3 nearest_image(const DomainBox<D>& box, const Body& body, const Vector3& x) {
  return x + to_nearest_image<D>(box, body, x);
}

}  // namespace littoral::sph
