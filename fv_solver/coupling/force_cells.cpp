#include "coupling/force_cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace littoral::fv {
namespace {

/// Smallest of a cell's thicknesses [m].
template <int D>
double shortest_edge(const Block<D>& block, std::size_t c) {
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t d = 0; d < D; ++d) shortest = std::min(shortest, thickness(block, d, c));
  return shortest;
}

}  // namespace

template <int D>
void force_cells(const TargetCells<D>& cells, const std::vector<Imposed<D>>& values, double K, double u_ref,
                 double dt, Stepper<D>& stepper) {
  const Equations<D>& equations = stepper.equations();
  FreeSurface<D>* surface = stepper.surface();
  for (std::size_t b = 0; b < values.size(); ++b) {
    const Block<D>& block = stepper.blocks()[b];
    const Imposed<D>& given = values[b];
    if (given.cell.empty()) continue;
    Forcing<D>& forcing = stepper.forcing()[b];
    forcing.rate.assign(block.extent.size, 0.0);
    forcing.pressure_rate.assign(block.extent.size, 0.0);
    forcing.target.resize(block.extent.size);
    forcing.psi = equations.fluid.inverse_c2 > 0.0 ? equations.fluid.inverse_c2
                                                   : 1.0 / (equations.speeds.c0 * equations.speeds.c0);
    SurfaceForcing none, &of_phi = surface != nullptr ? surface->level_set().forcing[b] : none;
    if (surface != nullptr) {
      of_phi.rate.assign(block.extent.size, 0.0);
      of_phi.target.assign(block.extent.size, 0.0);
    }
    for (std::size_t m = 0; m < given.cell.size(); ++m) {
      const std::size_t c = given.cell[m];
      const double rate = K / std::min(dt, shortest_edge(block, c) / u_ref);  // (22)
      const std::uint8_t known = cells.known(b)[m];
      // nothing to drive it to where the particles gave no value
      forcing.rate[c] = forcing.pressure_rate[c] = (known & known_state) != 0 ? rate : 0.0;
      forcing.target.p[c] = given.p[m];
      for (std::size_t k = 0; k < D; ++k) forcing.target.u[k][c] = given.u[k][m];
      if (surface == nullptr || (known & known_phi) == 0) continue;
      const double phi = given.phi[m];
      const bool other = (phi < 0.0) != (surface->phi()[b][c] < 0.0);
      if (!other && std::abs(phi) >= k_given_reach * longest_edge(block, c)) continue;
      of_phi.rate[c] = rate;
      of_phi.target[c] = phi;
    }
  }
}

template void force_cells<2>(const TargetCells<2>&, const std::vector<Imposed<2>>&, double, double, double,
                             Stepper<2>&);
template void force_cells<3>(const TargetCells<3>&, const std::vector<Imposed<3>>&, double, double, double,
                             Stepper<3>&);

}  // namespace littoral::fv
