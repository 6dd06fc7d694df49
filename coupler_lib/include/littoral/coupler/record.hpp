#pragma once

#include <memory>
#include <string>

#include "littoral/coupler/partner.hpp"

namespace littoral::coupler {

/// An HDF5 record of a run: everything the partner said, in order. The recording partner passes all calls on
/// to the real one; the replaying partner says the same again to one rank, and checks that it is asked the
/// same (window, times, counts). Target littoral::record (needs HDF5). throws IoError, CouplingError (record
/// exhausted or asked out of order)
std::unique_ptr<FvPartner> recording(std::unique_ptr<FvPartner> real, const std::string& path);
std::unique_ptr<SphPartner> recording(std::unique_ptr<SphPartner> real, const std::string& path);
std::unique_ptr<FvPartner> replayed_fv_partner(const std::string& path);
std::unique_ptr<SphPartner> replayed_sph_partner(const std::string& path);

}  // namespace littoral::coupler
