#pragma once

#include <vector>

#include "dual_time/stepper.hpp"
#include "littoral/support/series.hpp"

namespace littoral::fv {

/// Fields that cost a gradient: computed only where asked for.
struct DerivedFields {
  bool vorticity = false, q_criterion = false;
};

/// One block for ParaView: velocity, pressure, pressure beyond the hydrostatic reference, status of the
/// cells, and the derived fields asked for. A planar block gets the thickness of its mean cell.
template <int D>
support::FieldSeries::Block field_block(const Block<D>& block, const State<D>& q,
                                        const DerivedFields& derived = {});

}  // namespace littoral::fv
