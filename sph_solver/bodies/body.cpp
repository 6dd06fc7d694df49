#include "bodies/body.hpp"

#include <cmath>

namespace littoral::sph {

Body::Body(const support::BodySpec& spec, bool planar, double time_scale,
           std::shared_ptr<const TriangleSurface> surface)
    : name_(spec.name),
      shape_(make_shape(spec, planar, std::move(surface))),
      sheet_(shape_->sheet()),
      motion_(spec, time_scale),
      sticks_(spec.slip == support::BodySpec::Slip::none),
      fluid_inside_(spec.fluid == support::BodySpec::Fluid::inside),
      now_(motion_.at(0.0)) {}

SurfacePoint Body::closest_wall(const Vector3& x) const {
  const SurfacePoint local = shape_->closest(to_local(x));
  const double sign = fluid_inside_ ? -1.0 : 1.0;
  return {to_world(local.point), -sign * now_.rotation(local.normal), sign * local.distance, local.patch};
}

std::optional<double> Body::passage(const Vector3& from, const Vector3& to) const {
  constexpr double k_edge = 1e-9;  // of the sheet's length: what runs along its edge goes through
  const double drop = from[2] - to[2];
  const double s = drop != 0.0 ? from[2] / drop : 0.0;
  const Vector3 through = from + s * (to - from);
  for (std::size_t d = 0; d < 2; ++d)
    if (std::fabs(through[d]) > (*sheet_)[d] * (1.0 + k_edge)) return std::nullopt;
  return s;
}

}  // namespace littoral::sph
