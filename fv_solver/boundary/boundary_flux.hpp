#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "grid/block.hpp"
#include "physics/fluid.hpp"

namespace littoral::fv {

struct WaveSpeeds;

/// Fluxes without friction through one face of a block, where its windows prescribe them: along +direction,
/// direction 0 (or the lower tangential one) fastest, ghosts not included.
template <int D>
struct FaceFlux {
  std::vector<std::uint8_t> given;  // 1: use the values; 0: the ordinary flux
  Field mass;                       // [kg/s]
  VectorField<D> momentum;          // [N] pressure relative to the hydrostatic reference
  bool any = false;
};

/// [direction][side]
template <int D>
using BoundaryFluxes = std::array<std::array<FaceFlux<D>, 2>, D>;

/// Fluxes of all windows but periodic, state, fringe and join, which use the ordinary flux over their ghosts.
/// in   q with ghosts current, p the pressure relative to the reference
template <int D>
void compute_boundary_fluxes(const Block<D>& block, const Fluid<D>& fluid, const WaveSpeeds& speeds,
                             double dt, const double* p, const State<D>& q, BoundaryFluxes<D>& fluxes);

/// Wave speed [m/s] of a far field's Riemann problem at a place of its window (of its given values).
template <int D>
double far_field_speed(const Window<D>& window, std::size_t given, const WaveSpeeds& speeds);

/// Position in FaceFlux of a cell beside a face of `direction`.
template <int D>
std::size_t face_position(const Block<D>& block, std::size_t direction, const std::array<int, D>& index) {
  std::size_t position = 0, stride = 1;
  for (std::size_t k = 0; k < D; ++k) {
    if (k == direction) continue;
    position += static_cast<std::size_t>(index[k]) * stride;
    stride *= static_cast<std::size_t>(block.extent.n[k]);
  }
  return position;
}

/// Reference-relative pressure on a wall face: linear through two cells; at a symmetry plane that of the
/// mirrored field.
double pressure_on_face(Condition condition, double p0, double p1, double d0, double slope);

}  // namespace littoral::fv
