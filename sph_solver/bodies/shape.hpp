#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "bodies/section.hpp"
#include "bodies/vector3.hpp"
#include "littoral/support/body.hpp"

namespace littoral::sph {

/// The point of a surface closest to a given one.
struct SurfacePoint {
  Vector3 point{};        // [m]
  Vector3 normal{};       // unit, out of the solid shape; at edges along the line to the given point
  double distance = 0.0;  // [m] of the given point; negative inside the shape
  int patch = -1;         // of the curved part of the surface that has no edge within it; -1: a plane
};

/// A solid about its own origin, or a sheet, which has no inside: its distances are never negative.
class Shape {
 public:
  virtual ~Shape() = default;
  virtual SurfacePoint closest(const Vector3& x) const = 0;
  /// Corners of a box that holds it [m]; infinite along y for the section of a 2-D scene.
  virtual std::array<Vector3, 2> bounds() const = 0;
  /// Of a sheet, which lies in its plane z = 0: half its lengths along x and y [m].
  virtual std::optional<Point2> sheet() const { return std::nullopt; }
};

class TriangleSurface;

/// The shape of a body; planar: its section with y = 0, endless along y; surface: of a body from a file.
std::unique_ptr<Shape> make_shape(const support::BodySpec& spec, bool planar,
                                  std::shared_ptr<const TriangleSurface> surface = nullptr);

}  // namespace littoral::sph
