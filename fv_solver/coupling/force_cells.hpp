#pragma once

#include <vector>

#include "coupling/target_cells.hpp"

namespace littoral::fv {

/// Coupling II: aims the forcing of the stepper's next step at `values` (the order of `cells`), with the rate
///   K / min(dt, h_d / u_ref)                                                                     (22)
/// p and u, (21), in cells whose sample the particles gave; phi, (23), in the cells at the surface, and where
/// its sign is another. K [-], u_ref [m/s], dt [s]. comm local
template <int D>
void force_cells(const TargetCells<D>& cells, const std::vector<Imposed<D>>& values, double K, double u_ref,
                 double dt, Stepper<D>& stepper);

}  // namespace littoral::fv
