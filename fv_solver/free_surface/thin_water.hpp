#pragma once

#include <array>
#include <vector>

#include "boundary/exchange.hpp"
#include "free_surface/cut_faces.hpp"
#include "level_set/band.hpp"

namespace littoral::fv {

/// Water no thicker than a cell: solved cells with air beyond both faces of some direction, where the surface
/// turns by more than a right angle from one to the other (the topmost cell of a gentle crest has air on both
/// sides as well, under one surface). The level set carries such threads, sheets and drops, but has no two
/// points across them: their thickness, and the pressure in them, are not to be trusted.
template <int D>
struct ThinWater {
  double cells = 0.0;             // of all ranks
  std::array<double, D> place{};  // [m] the first of them
};

/// phi: ghosts current. comm collective
template <int D>
ThinWater<D> find_thin_water(const std::vector<Block<D>>& blocks, const Exchange<D>& exchange,
                             const Band<D>& band, const std::vector<Field>& phi,
                             const std::vector<WetMask>& wet);

}  // namespace littoral::fv
