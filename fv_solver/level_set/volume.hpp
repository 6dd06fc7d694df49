#pragma once

#include <vector>

#include "level_set/band.hpp"

namespace littoral::fv {

/// Share of each cell's volume that is water, in [0, 1]: cut by the plane that phi and its gradient give at
/// the cell's centre. 1 and 0 away from the surface. pure
/// value, gradient: of phi at the centre [m], [-]; edges: half the cell's edge vectors [m]
template <int D>
double wet_share(double value, const std::array<double, D>& gradient,
                 const std::array<std::array<double, D>, D>& half_edges);

/// Of all cells of a block, ghosts 0. pre ghosts of phi current
template <int D>
void wet_shares(const Block<D>& block, const Field& phi, Field& share);

/// Volume of the water in solved cells (statuses computed and forced) [m^D]; cells that two overlapping
/// blocks both solve count twice, as do other integrals.
template <int D>
double water_volume(const std::vector<Block<D>>& blocks, const std::vector<Field>& phi);

/// Area of the surface in those cells [m^(D-1)].
template <int D>
double surface_area(const std::vector<Block<D>>& blocks, const std::vector<Field>& phi);

}  // namespace littoral::fv
