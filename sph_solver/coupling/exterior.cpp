#include "coupling/exterior.hpp"

namespace littoral::sph {

void DonorField::set_geometry(const coupler::DonorGeometry& geometry) {
  search_ = std::make_unique<coupler::DonorSearch>(geometry, dimension_);
}

std::optional<coupler::DonorState> DonorField::at(const coupler::Vec3& x, double time,
                                                  std::int64_t& hint) const {
  const coupler::Donor donor = search_->find(x, hint);
  if (!donor.found) return std::nullopt;
  return coupler::interpolate(values_, donor, time);
}

}  // namespace littoral::sph
