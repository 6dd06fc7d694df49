#include "coupling/exterior.hpp"

#include <cmath>

namespace littoral::sph {

double phi_slope(const Exterior& fv, const coupler::Vec3& x, double phi_here, std::size_t axis, double half,
                 double time, std::int64_t hint) {
  double change = 0.0, length = 0.0;
  for (const double sign : {-1.0, 1.0}) {
    coupler::Vec3 beside = x;
    beside[axis] += sign * half;
    std::int64_t memory = hint;
    const auto state = fv.at(beside, time, memory);
    if (!state) continue;
    change += sign * (state->phi - phi_here);
    length += half;
  }
  return length > 0.0 ? change / length : 0.0;
}

DonorField::DonorField(const support::Scene& scene)
    : dimension_(scene.dimension), lower_(scene.domain.lower), period_{} {
  for (std::size_t d = 0; d < 3; ++d)
    if (scene.domain.sides[d][0] == support::Scene::Side::periodic)
      period_[d] = scene.domain.upper[d] - scene.domain.lower[d];
}

coupler::Vec3 DonorField::wrapped(const coupler::Vec3& x) const {
  coupler::Vec3 inside = x;
  for (std::size_t d = 0; d < 3; ++d)
    if (period_[d] > 0.0) inside[d] -= period_[d] * std::floor((x[d] - lower_[d]) / period_[d]);
  return inside;
}

void DonorField::set_geometry(const coupler::DonorGeometry& geometry) {
  search_ = std::make_unique<coupler::DonorSearch>(geometry, dimension_);
}

std::optional<coupler::DonorState> DonorField::at(const coupler::Vec3& x, double time,
                                                  std::int64_t& hint) const {
  const coupler::Donor donor = search_->find(wrapped(x), hint);
  if (!donor.found) return std::nullopt;
  return coupler::interpolate(values_, donor, time);
}

}  // namespace littoral::sph
