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
/// cells, and the derived fields asked for. width: of a planar block [m]
template <int D>
support::FieldSeries::Block field_block(const Block<D>& block, const State<D>& q,
                                        const DerivedFields& derived, double width);

/// The blocks of all ranks as they were before they were cut, on the root. A planar block gets the width of
/// its mean cell. comm collective
template <int D>
std::vector<support::FieldSeries::Block> whole_field_blocks(const Stepper<D>& stepper,
                                                            const DerivedFields& derived);

}  // namespace littoral::fv
