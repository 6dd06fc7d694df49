#pragma once

#include <vector>

#include "dual_time/stepper.hpp"

namespace littoral::fv {

/// Mass flux through all faces between computed and fringe cells, into the SPH region: central, fourth order
/// along the grid line, which is what the mean of both reconstructions is; the Riemann problem's dissipation
/// is left out.
/// in    state with ghosts current
/// out   [kg/s] (per metre in 2-D)
template <int D>
double interface_mass_flux(const std::vector<Block<D>>& blocks, const Equations<D>& equations,
                           const std::vector<State<D>>& state);

}  // namespace littoral::fv
