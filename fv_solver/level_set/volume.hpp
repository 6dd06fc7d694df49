#pragma once

#include <array>
#include <vector>

#include "grid/block.hpp"

namespace littoral::fv {

/// Share of a parallelepiped that lies where value + slope . xi < 0, xi in [-1, 1]^D: exact, in [0, 1].
/// slope: change of the function from the centre to each face (Scardovelli & Zaleski 2000). pure
template <int D>
double wet_share(double value, std::array<double, D> slope);

/// Share of water in each cell of a block, cut by the plane of phi and its central differences; ghosts and
/// blanked cells 0. pre ghosts of phi current
template <int D>
void wet_shares(const Block<D>& block, const Field& phi, Field& share);

/// Volume of the water in the counted cells (counted_share) of these blocks [m^D].
template <int D>
double water_volume(const std::vector<Block<D>>& blocks, const std::vector<Field>& phi);

}  // namespace littoral::fv
