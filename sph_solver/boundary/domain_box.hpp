#pragma once

#include <array>
#include <cstddef>

#include "littoral/support/scene.hpp"

namespace littoral::sph {

/// The domain of the scene in the components of the particles.
template <int D>
struct DomainBox {
  using Side = support::Scene::Side;
  std::array<double, D> lower{};  // [m]
  std::array<double, D> upper{};  // [m]
  std::array<std::array<Side, 2>, D> sides{};

  bool is_periodic(std::size_t d) const { return sides[d][0] == Side::periodic; }
  double length(std::size_t d) const { return upper[d] - lower[d]; }
};

/// Direction of the scene (0 x, 1 y, 2 z) of component d: 2-D particles live in the plane (x, z).
template <int D>
constexpr std::size_t scene_axis(std::size_t d) {
  return D == 2 && d == 1 ? 2 : d;
}

}  // namespace littoral::sph
