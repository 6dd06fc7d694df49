#pragma once

#include <memory>
#include <string>

#include "bodies/motion.hpp"
#include "bodies/shape.hpp"
#include "particles/particles.hpp"

namespace littoral::sph {

/// A solid where it is at one instant.
class Body {
 public:
  /// planar: 2-D; time_scale: of its motion's resolution [s], a kernel radius over the sound speed
  Body(const support::BodySpec& spec, bool planar, double time_scale);

  const std::string& name() const { return name_; }
  bool moves() const { return motion_.moves(); }
  bool sticks() const { return sticks_; }             ///< no-slip
  bool holds_fluid() const { return fluid_inside_; }  ///< wet inside

  void move_to(double t) { now_ = motion_.at(t); }
  const BodyState& state() const { return now_; }

  Vector3 to_world(const Vector3& local) const { return now_.position + now_.rotation(local); }
  Vector3 to_local(const Vector3& x) const { return now_.rotation.inverse()(x - now_.position); }

  /// Closest point of the surface. normal: out of the fluid, into the body; distance: positive in the fluid.
  SurfacePoint closest_wall(const Vector3& x) const;
  /// Corners of a box in its own frame that holds it.
  std::array<Vector3, 2> local_bounds() const { return shape_->bounds(); }

 private:
  std::string name_;
  std::unique_ptr<Shape> shape_;
  Motion motion_;
  bool sticks_;
  bool fluid_inside_;
  BodyState now_;
};

}  // namespace littoral::sph
