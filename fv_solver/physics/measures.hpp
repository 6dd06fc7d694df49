#pragma once

#include <array>
#include <string>
#include <vector>

#include "dual_time/stepper.hpp"
#include "littoral/coupler/types.hpp"

namespace littoral::fv {

/// Integrals over the water that counts as the grid's: solved cells, the part of each outside the particle
/// region's nominal boxes.
struct Integrals {
  double mass = 0.0;              // [kg] (2-D: per metre)
  double kinetic_energy = 0.0;    // [J]
  double potential_energy = 0.0;  // [J] against gravity, 0 at the origin
};

/// Share of each cell outside the boxes, 0 where the cell is not solved: by the cells' bounding boxes, exact
/// where the grid is aligned with the region. wet: the part of each cell below a free surface
/// (level_set/volume.hpp), null: all; cells count by it whose centres are in the air, too
template <int D>
Field outside_share(const Block<D>& block, const std::vector<coupler::Box>& regions,
                    const Field* wet = nullptr);

/// phi: where a free surface cuts cells, so that what they hold is lifted by its own centre; null: nowhere
template <int D>
Integrals integrate(const Block<D>& block, const Fluid<D>& fluid, const State<D>& q, const Field& share,
                    const Field* phi = nullptr);

/// Largest sum over the directions of |u . A| (at least `least` S) over the volume: 1/CFL of a unit step
/// [1/s].
template <int D>
double convective_rate(const Block<D>& block, const State<D>& q, double least);

}  // namespace littoral::fv
