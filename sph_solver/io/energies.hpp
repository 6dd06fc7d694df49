#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "coupling/zones.hpp"
#include "particles/particles.hpp"

namespace littoral::sph {

/// Sums over the particles inside the region's nominal faces: with the partner's cells outside of them the
/// flow is counted once.
struct Totals {
  double kinetic = 0.0;    // sum m |u|^2 / 2 [J] (2-D: per metre, as all below)
  double potential = 0.0;  // - sum m g . x [J], 0 at the origin
  double mass = 0.0;       // [kg]
  double speed = 0.0;      // largest |u| of all owned particles [m/s]
  std::size_t n = 0;       // all owned particles, layers included
};

template <int D>
Totals totals(const Particles<D>& particles, const std::array<double, D>& gravity, const Layers<D>& layers) {
  Totals sum;
  sum.n = particles.n_owned;
  for (std::size_t i = 0; i < particles.n_owned; ++i) {
    double u2 = 0.0, gx = 0.0;
    std::array<double, D> x;
    for (std::size_t d = 0; d < D; ++d) {
      x[d] = particles.x[d][i];
      u2 += particles.u[d][i] * particles.u[d][i];
      gx += gravity[d] * x[d];
    }
    sum.speed = std::max(sum.speed, std::sqrt(u2));
    if (layers.excess(x) > 0.0 && layers.any_open()) continue;
    sum.kinetic += 0.5 * particles.m[i] * u2;
    sum.potential -= particles.m[i] * gx;
    sum.mass += particles.m[i];
  }
  return sum;
}

}  // namespace littoral::sph
