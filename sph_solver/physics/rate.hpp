#pragma once

#include <array>
#include <vector>

namespace littoral::sph {

/// Right-hand side of the particles' equations (n_owned).
template <int D>
struct Rate {
  std::array<std::vector<double>, D> acceleration;  // [m/s^2]
  std::vector<double> volume;                       // dV/dt [m^D/s]
  void resize(std::size_t n) {
    for (auto& column : acceleration) column.resize(n);
    volume.resize(n);
  }
};

}  // namespace littoral::sph
