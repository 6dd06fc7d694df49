#pragma once

#include <memory>
#include <string>

#include "littoral/coupler/partner.hpp"

namespace littoral::coupler {

/// Target littoral::record (needs HDF5). A record is what the partner of one rank said in a run, in order:
/// an HDF5 file that grows window by window and is readable up to the last whole window should the run die.

/// Passes all calls on to `real` and records at `path` what it says; every rank has a file of its own. What
/// was recorded there before is lost. `scene`: what a replay must agree in, a digest say. throws IoError
std::unique_ptr<FvPartner> recording(std::unique_ptr<FvPartner> real, const std::string& path,
                                     const std::string& scene = "");
std::unique_ptr<SphPartner> recording(std::unique_ptr<SphPartner> real, const std::string& path,
                                      const std::string& scene = "");

/// Say the same again, to the bit, to the rank that heard it and without any partner, as long as the same is
/// asked: calls in the same order, for the same windows, regions and counts, and no shorter steps. A run may
/// write more often than the recorded one, and may stop before it; of several ranks all must wish that.
/// throws IoError: no record, or a damaged one; CouplingError: another scene, or something else is asked than
/// what was recorded, or more
std::unique_ptr<FvPartner> replayed_fv_partner(const std::string& path, const std::string& scene = "");
std::unique_ptr<SphPartner> replayed_sph_partner(const std::string& path, const std::string& scene = "");

}  // namespace littoral::coupler
