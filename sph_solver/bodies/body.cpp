#include "bodies/body.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "littoral/error.hpp"

namespace littoral::sph {

Body::Body(const support::BodySpec& spec, bool planar, double time_scale,
           std::shared_ptr<const TriangleSurface> surface)
    : name_(spec.name),
      shape_(make_shape(spec, planar, std::move(surface))),
      sheet_(shape_->sheet()),
      motion_(spec, time_scale),
      sticks_(spec.slip == support::BodySpec::Slip::none),
      fluid_inside_(spec.fluid == support::BodySpec::Fluid::inside),
      now_{} {
  move_to(0.0);
  const auto corners = local_bounds();
  for (std::size_t d = 0; d < 3; ++d)
    if (std::isfinite(corners[0][d])) middle_[d] = 0.5 * (corners[0][d] + corners[1][d]);
}

void Body::move_to(double t) {
  // before anything is integrated: what is not finite once stays so, and a body nowhere has no dummies
  const std::string broken = motion_.not_finite_at(t);
  if (!broken.empty()) {
    std::ostringstream text;
    text << "t = " << t << " s: body '" << name_ << "': its motion." << broken
         << " has no finite value there, or a moment before or after. Mend the formula; min, max and "
            "conditions keep it in its range.";
    throw StabilityError(text.str());
  }
  now_ = motion_.at(t);
}

std::array<Vector3, 2> Body::bounds() const {
  auto corners = local_bounds();
  for (std::size_t d = 0; d < 3; ++d)
    if (!std::isfinite(corners[0][d])) corners[0][d] = corners[1][d] = 0.0;
  std::array<Vector3, 2> box;
  for (std::size_t k = 0; k < 8; ++k) {
    const Vector3 c = to_world({corners[k & 1][0], corners[(k >> 1) & 1][1], corners[k >> 2][2]});
    for (std::size_t d = 0; d < 3; ++d) {
      box[0][d] = k == 0 ? c[d] : std::min(box[0][d], c[d]);
      box[1][d] = k == 0 ? c[d] : std::max(box[1][d], c[d]);
    }
  }
  return box;
}

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
