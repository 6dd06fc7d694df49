#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <random>

#include "particles/particles.hpp"

namespace littoral::sph::test {

/// Fills `particles` with points at cell centres (i + 1/2) dx of the box [0, n dx) where keep() holds, moved
/// at random by up to `jitter` dx in each direction. V = dx^D, rho = 1, at rest.
template <int D>
Particles<D> cloud(const std::array<int, D>& n, double dx, double jitter = 0.0,
                   const std::function<bool(const std::array<double, D>&)>& keep = {}, unsigned seed = 7) {
  Particles<D> particles;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> offset(-jitter * dx, jitter * dx);
  const auto total = [&] {
    int t = 1;
    for (int k : n) t *= k;
    return t;
  }();
  for (int c = 0; c < total; ++c) {
    NewParticle<D> born;
    int rest = c;
    for (std::size_t d = D; d-- > 0;) {
      born.x[d] = (rest % n[d] + 0.5) * dx;
      rest /= n[d];
    }
    if (keep && !keep(born.x)) continue;
    for (std::size_t d = 0; d < D; ++d) born.x[d] += offset(random);
    born.V = std::pow(dx, D);
    born.m = born.V;
    particles.append(born);
  }
  return particles;
}

}  // namespace littoral::sph::test
