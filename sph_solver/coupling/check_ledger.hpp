#pragma once

#include "littoral/coupler/fields.hpp"

namespace littoral::sph {

/// throws StabilityError if the summed ledger's defect exceeds round-off of the mass it moved.
void check_ledger(const coupler::Ledger& total, double time);

}  // namespace littoral::sph
