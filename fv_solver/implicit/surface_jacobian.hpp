#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "free_surface/line_stencil.hpp"
#include "implicit/face_jacobian.hpp"

namespace littoral::fv {

/// Derivative of the flux through a face between water and air, as CutFaces has it, by the two water cells of
/// the line; scaled as face_jacobian.
template <int D>
struct SurfaceJacobian {
  SmallMatrix<D> own;                // by the cell beside the surface
  std::array<double, D> behind_p{};  // of the momentum rows by the pressure behind it
};

/// in   area pointing into the air; volume of the cell; normal of the surface, out of the water; weights of
///      the pressure on the face
/// The mass flux has no pressure term in the residual; here it keeps that of other faces, without which the
/// correction of pressures just below the surface is too large. The surface's own pressure p0 - P(x_s)
/// follows the flow within the step, d p_s/d(u.n) = -rho0 g.n/a0: that makes large steps on short waves
/// converge.
template <int D>
SurfaceJacobian<D> surface_jacobian(const std::array<double, D>& area, double volume,
                                    const FaceState<D>& inside, const std::array<double, D>& normal,
                                    const LineWeights& weights, const CorrectionPhysics<D>& physics) {
  SurfaceJacobian<D> jacobian;
  double s2 = 0.0, flow = 0.0, fall = 0.0;
  for (std::size_t k = 0; k < D; ++k) {
    s2 += area[k] * area[k];
    flow += inside.u[k] * area[k];
    fall -= physics.fluid.gravity[k] * normal[k];
  }
  if (s2 <= 0.0) return jacobian;
  const double s = std::sqrt(s2), c0 = physics.speeds.c0;
  std::array<double, D + 1> m;
  m[0] = 0.5 * c0 * s * physics.mass_speed().inverse(volume / s) +
         c0 * physics.fluid.inverse_c2 * std::max(flow, 0.0);
  for (std::size_t k = 0; k < D; ++k) m[k + 1] = area[k];
  const double stiffness =
      physics.time.a0 > 0.0 ? weights.surface * std::max(fall, 0.0) / physics.time.a0 : 0.0;
  for (std::size_t j = 0; j <= D; ++j) {
    jacobian.own[0][j] = c0 * m[j];
    for (std::size_t i = 0; i < D; ++i) jacobian.own[i + 1][j] = inside.u[i] * m[j];
  }
  for (std::size_t i = 0; i < D; ++i) {
    jacobian.own[i + 1][0] += weights.own * c0 * area[i];
    jacobian.own[i + 1][i + 1] += std::max(flow, 0.0);
    for (std::size_t j = 0; j < D; ++j) jacobian.own[i + 1][j + 1] += stiffness * area[i] * normal[j];
    jacobian.behind_p[i] = weights.behind * c0 * area[i];
  }
  return jacobian;
}

/// Normal of the surface at a cell from phi around it, out of the water. pure
template <int D>
std::array<double, D> level_normal(const LevelGrid<D>& grid, std::ptrdiff_t c) {
  std::array<double, D> n{};
  double size2 = 0.0;
  for (std::size_t d = 0; d < D; ++d) {
    const std::ptrdiff_t s = grid.extent.stride[d];
    const double slope =
        grid.phi[static_cast<std::size_t>(c + s)] - grid.phi[static_cast<std::size_t>(c - s)];
    for (std::size_t k = 0; k < D; ++k)
      n[k] += slope * (grid.area[d][k][static_cast<std::size_t>(c)] +
                       grid.area[d][k][static_cast<std::size_t>(c + s)]);
  }
  for (const double x : n) size2 += x * x;
  for (double& x : n) x /= std::sqrt(std::max(size2, 1e-300));
  return n;
}

}  // namespace littoral::fv
