#pragma once

#include <vector>

#include "level_set/band.hpp"
#include "level_set/patches.hpp"

namespace littoral::fv {

/// Makes phi the signed distance in a band around its zero level, and +- its largest value there beyond.
///   layer 0   kept (`frozen`): the crossings phi_i/(phi_i - phi_a) on grid lines do not move at all;
///             `all` sets it too, for a phi that is no distance yet (start)
///   others    distance to the nearest patch of the surface; signs are kept
/// Interpolated and fringe cells keep what they were given.
/// in/out phi, ghosts current on return; out band, patches of the zero level
/// comm: those of Band and SurfacePatches, and phi once
enum class InterfaceCells { frozen, all };
template <int D>
void reinitialise(const std::vector<Block<D>>& blocks, const Exchange<D>& exchange, int layers,
                  InterfaceCells interface, std::vector<Field>& phi, Band<D>& band,
                  SurfacePatches<D>& patches);

/// Rounds of `all` that make any continuous function with the right zero level a distance there.
inline constexpr int k_start_rounds = 3;

}  // namespace littoral::fv
