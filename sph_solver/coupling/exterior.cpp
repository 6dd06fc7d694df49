#include "coupling/exterior.hpp"

#include <cmath>

namespace littoral::sph {

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
