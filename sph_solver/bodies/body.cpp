#include "bodies/body.hpp"

namespace littoral::sph {

Body::Body(const support::BodySpec& spec, bool planar, double time_scale)
    : name_(spec.name),
      shape_(make_shape(spec, planar)),
      motion_(spec, time_scale),
      sticks_(spec.slip == support::BodySpec::Slip::none),
      fluid_inside_(spec.fluid == support::BodySpec::Fluid::inside),
      now_(motion_.at(0.0)) {}

SurfacePoint Body::closest_wall(const Vector3& x) const {
  const SurfacePoint local = shape_->closest(to_local(x));
  const double sign = fluid_inside_ ? -1.0 : 1.0;
  return {to_world(local.point), -sign * now_.rotation(local.normal), sign * local.distance};
}

}  // namespace littoral::sph
