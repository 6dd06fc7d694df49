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
/// With a free surface (phi not null) also level_set: phi [m], a distance near the surface, elsewhere of
/// meaning by its sign; and elevation: height against gravity of the nearest place of the surface [m], nan
/// more than two cells away from it. up: unit vector against gravity
template <int D>
support::FieldSeries::Block field_block(const Block<D>& block, const State<D>& q,
                                        const DerivedFields& derived, double width,
                                        const Field* phi = nullptr, const std::array<double, D>& up = {});

/// The blocks of all ranks as they were before they were cut, on the root. A planar block gets the width of
/// its mean cell. comm collective
template <int D>
std::vector<support::FieldSeries::Block> whole_field_blocks(const Stepper<D>& stepper,
                                                            const DerivedFields& derived);

}  // namespace littoral::fv
