#pragma once

#include <memory>
#include <vector>

#include "bodies/vector3.hpp"
#include "littoral/support/body.hpp"

namespace littoral::sph {

/// The point of a surface closest to a given one.
struct SurfacePoint {
  Vector3 point{};        // [m]
  Vector3 normal{};       // unit, out of the solid shape; at edges along the line to the given point
  double distance = 0.0;  // [m] of the given point; negative inside the shape
};

/// A solid about its own origin.
class Shape {
 public:
  virtual ~Shape() = default;
  virtual SurfacePoint closest(const Vector3& x) const = 0;
  /// Corners of a box that holds it [m]; infinite along y for the section of a 2-D scene.
  virtual std::array<Vector3, 2> bounds() const = 0;
};

/// The shape of a body; planar: its section with y = 0, endless along y.
std::unique_ptr<Shape> make_shape(const support::BodySpec& spec, bool planar);

}  // namespace littoral::sph
