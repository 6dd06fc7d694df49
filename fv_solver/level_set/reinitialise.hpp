#pragma once

#include <vector>

#include "level_set/band.hpp"
#include "level_set/patches.hpp"

namespace littoral::fv {

/// What reinitialise does with the cells of layer 0.
///   frozen  kept, so that the crossings phi_i/(phi_i - phi_a) on grid lines do not move at all
///   all     set as others, for a phi that is no distance yet (start)
enum class InterfaceCells { frozen, all };

/// Finds band and patches of the zero level of phi. pre ghosts of phi current; comm as Band, SurfacePatches
template <int D>
void locate_surface(const std::vector<Block<D>>& blocks, const Exchange<D>& exchange,
                    const std::vector<Field>& phi, int layers, Band<D>& band, SurfacePatches<D>& patches);

/// Makes phi the signed distance in a band around its zero level, which does not move: |phi| becomes the
/// distance to the nearest patch of the surface, signs are kept. Beyond the band phi is +- the band's depth
/// in cells of the place's size: only its sign has a meaning there. Blanked cells keep what they have;
/// interpolated ones are refreshed.
/// in/out phi, ghosts current before and after; out band, patches
/// history: phi of the step before; cells that were beyond its band (`band` as it comes in) get the present
/// value less the change of their neighbours nearer to the surface, so that differences in time stay smooth
/// comm: locate_surface, phi, history once a layer
template <int D>
void reinitialise(const std::vector<Block<D>>& blocks, const Exchange<D>& exchange, int layers,
                  InterfaceCells interface, std::vector<Field>& phi, Band<D>& band,
                  SurfacePatches<D>& patches, std::vector<Field>* history = nullptr);

}  // namespace littoral::fv
