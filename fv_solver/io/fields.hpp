#pragma once

#include <vector>

#include "dual_time/stepper.hpp"
#include "littoral/support/series.hpp"

namespace littoral::fv {

/// One block for ParaView: velocity, pressure, pressure beyond the hydrostatic reference, status of the
/// cells. A planar block gets the thickness of its mean cell.
template <int D>
support::FieldSeries::Block field_block(const Block<D>& block, const State<D>& q);

}  // namespace littoral::fv
