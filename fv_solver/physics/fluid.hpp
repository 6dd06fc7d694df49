#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "grid/block.hpp"

namespace littoral::fv {

/// The fluid and the forces on it: rho = rho0 + (p - p0)/c^2 (F3).
template <int D>
struct Fluid {
  double density = 1000.0;          // rho0 [kg/m^3]
  double reference_pressure = 0.0;  // p0 [Pa]
  double inverse_c2 = 0.0;          // 1/c^2 [s^2/m^2]; 0: incompressible
  double viscosity = 0.0;           // nu [m^2/s]
  std::array<double, D> gravity{};  // [m/s^2]

  double rho(double p) const { return density + (p - reference_pressure) * inverse_c2; }
  bool has_gravity() const {
    for (double g : gravity)
      if (g != 0.0) return true;
    return false;
  }
  /// Hydrostatic reference P: grad P = rho(P) g exactly, P = p0 at the origin (F4). The equations are
  /// discretised for p - P, so that water at rest stays at rest on any grid.
  double hydrostatic(const std::array<double, D>& x) const {
    double gx = 0.0;
    for (std::size_t d = 0; d < D; ++d) gx += gravity[d] * x[d];
    if (inverse_c2 == 0.0) return reference_pressure + density * gx;
    return reference_pressure + density / inverse_c2 * std::expm1(gx * inverse_c2);
  }
};

/// Unit vector against gravity; where there is none, along the last axis.
template <int D>
std::array<double, D> against_gravity(const Fluid<D>& fluid) {
  double g = 0.0;
  for (const double component : fluid.gravity) g += component * component;
  g = std::sqrt(g);
  std::array<double, D> up{};
  up[D - 1] = 1.0;
  for (std::size_t k = 0; k < D && g > 0.0; ++k) up[k] = -fluid.gravity[k] / g;
  return up;
}

template <int D>
void set_reference_pressure(Block<D>& block, const Fluid<D>& fluid) {
  block.reference_pressure.resize(block.extent.size);
  for (std::size_t c = 0; c < block.extent.size; ++c) {
    std::array<double, D> x;
    for (std::size_t d = 0; d < D; ++d) x[d] = block.centre[d][c];
    block.reference_pressure[c] = fluid.hydrostatic(x);
  }
}

}  // namespace littoral::fv
