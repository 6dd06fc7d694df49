#pragma once

#include <memory>
#include <optional>
#include <string>

#include "bodies/motion.hpp"
#include "bodies/shape.hpp"
#include "particles/particles.hpp"

namespace littoral::sph {

/// A solid, or a plate wet on both sides, where it is at one instant.
class Body {
 public:
  /// planar: 2-D; time_scale: of its motion's resolution [s], a kernel radius over the sound speed; surface:
  /// of shape stl
  Body(const support::BodySpec& spec, bool planar, double time_scale,
       std::shared_ptr<const TriangleSurface> surface = nullptr);

  const std::string& name() const { return name_; }
  bool moves() const { return motion_.moves(); }
  bool sticks() const { return sticks_; }             ///< no-slip
  bool holds_fluid() const { return fluid_inside_; }  ///< wet inside
  bool is_sheet() const { return sheet_.has_value(); }
  const Point2& sheet() const { return *sheet_; }  ///< half its lengths along its x and y [m]

  /// throws StabilityError: a formula of its motion has no finite value there
  void move_to(double t);
  const BodyState& state() const { return now_; }

  Vector3 to_world(const Vector3& local) const { return now_.position + now_.rotation(local); }
  Vector3 to_local(const Vector3& x) const { return now_.rotation.inverse()(x - now_.position); }

  /// Closest point of the surface. normal: out of the fluid, into the body; distance: positive in the fluid.
  SurfacePoint closest_wall(const Vector3& x) const;
  /// Of a sheet: on which side of its plane a point of its own frame is, +1 or -1; its unit normal there
  /// points along z.
  static double side(const Vector3& local) { return local[2] < 0.0 ? -1.0 : 1.0; }
  /// Where the straight way between two points of its own frame that are on different sides of a sheet's
  /// plane goes through the sheet, as a share of the way; nothing if it passes by.
  std::optional<double> passage(const Vector3& from, const Vector3& to) const;
  /// Of that box, in the scene; endless directions count as 0.
  Vector3 middle() const { return to_world(middle_); }
  /// Lowest and highest corner of a box of the scene that holds it; endless directions count as 0.
  std::array<Vector3, 2> bounds() const;
  /// Corners of a box in its own frame that holds it.
  std::array<Vector3, 2> local_bounds() const { return shape_->bounds(); }

 private:
  std::string name_;
  std::unique_ptr<Shape> shape_;
  std::optional<Point2> sheet_;
  Motion motion_;
  bool sticks_;
  bool fluid_inside_;
  Vector3 middle_{};  // in its own frame
  BodyState now_;
};

}  // namespace littoral::sph
