#pragma once

#include <optional>

#include "boundary/window.hpp"
#include "grid/space.hpp"
#include "physics/fluid.hpp"

namespace littoral::fv {

/// Height of a surface over x, straight against gravity [m], by Newton's method on a function that is
/// negative in water and zero on the surface; none where the function does not grow upwards (water without a
/// surface, a vertical front). size: of a cell, of which a part is differenced over [m]. pure
template <int D>
std::optional<double> height_of_surface(const Prescribed& surface, const std::array<double, D>& x,
                                        const std::array<double, D>& up, double t, double size) {
  constexpr double k_part = 0.05, k_round_off = 1e-13;
  constexpr int k_iterations = 20;
  const auto value = [&](double height) {
    std::array<double, D> at = x;
    for (std::size_t k = 0; k < D; ++k) at[k] += height * up[k];
    return surface(vector_in_space<D>(at), t);
  };
  const double step = k_part * size;
  double height = 0.0;
  for (int i = 0; i < k_iterations; ++i) {
    const double slope = (value(height + step) - value(height - step)) / (2.0 * step);
    if (!(slope > 0.0)) return std::nullopt;
    const double change = -value(height) / slope;
    height += change;
    if (std::abs(change) <= k_round_off * (size + std::abs(height))) break;
  }
  return height;
}

/// Pressure less the hydrostatic reference at x [Pa] of water at rest under a surface: p0 on the surface
/// straight above or below. Where there is none the reference itself: 0. pure
template <int D>
double pressure_at_rest(const Prescribed& surface, const Fluid<D>& fluid, const std::array<double, D>& x,
                        double t, double size) {
  if (!surface || !fluid.has_gravity()) return 0.0;
  const std::array<double, D> up = against_gravity(fluid);
  const std::optional<double> height = height_of_surface<D>(surface, x, up, t, size);
  if (!height) return 0.0;
  std::array<double, D> below;  // of x from the surface
  for (std::size_t k = 0; k < D; ++k) below[k] = -*height * up[k];
  return fluid.hydrostatic(below) - fluid.hydrostatic(x);
}

}  // namespace littoral::fv
