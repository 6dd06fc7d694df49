#pragma once

#include <cstddef>
#include <cstdint>

#include "pairs/lanes.hpp"
#include "particles/particles.hpp"

namespace littoral::sph {

/// x_j - x_i of the neighbours j[0], j[1], ... of particle i, and their distances, from the columns: for
/// loops that read little else and run once a step, where packing rows would not pay.
template <int D>
inline Lanes<double> distances(const Particles<D>& particles, std::size_t i, const std::int32_t* j,
                               Lanes<double>* x) {
  Lanes<double> r2 = {};
  for (std::size_t d = 0; d < D; ++d) {
    x[d] = gather(particles.x[d].data(), j) - particles.x[d][i];
    r2 += x[d] * x[d];
  }
  return sqrt(r2);
}

}  // namespace littoral::sph
