#pragma once

#include <vector>

#include "dual_time/stepper.hpp"

namespace littoral::fv {

/// The stepper's state as the particles interpolate it beside the surface: in the first layers of air
///   p = p0 + a phi,  a = sum phi (p - p0) / sum phi^2 over the water cells around,
/// so that between water and air p is p0 at phi = 0 and falls as it does in the water, accelerations
/// included; u is continued there already (FreeSurface::end). Ghosts current. comm exchange
/// in usable[block]: 0 in cells without a state and in ghosts that stand for one
template <int D>
std::vector<State<D>> continue_into_air(const Stepper<D>& stepper, const std::vector<Field>& usable);

}  // namespace littoral::fv
