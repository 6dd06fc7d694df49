#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "grid/block.hpp"
#include "physics/equations.hpp"

namespace littoral::fv {

/// Fluxes through a row of faces: consecutive offsets along direction 0, whatever the faces' direction.
template <int D>
struct FluxRow {
  double* mass;                     // [kg/s]
  std::array<double*, D> momentum;  // [N]
};

/// What the flux kernels need that does not change along a row.
template <int D>
struct FluxConstants {
  double rho0, p0, inverse_c2;
  double c0;
  MassSpeed speed;   // c_p
  double mu;         // [Pa s]
  double upwinding;  // [-] a of u_f
};

/// Third-order upwind-biased value on the near side of a face (F6), kappa = 1/3, from the far cell, the cell
/// beside the face and the cell across it.
inline double reconstruct(double far, double near, double across) {
  return near + (near - far) * (1.0 / 6.0) + (across - near) * (1.0 / 3.0);
}
/// The same limited by van Albada's function: second order at extrema, no new ones at steps (F7).
inline double reconstruct_limited(double far, double near, double across, double smallest) {
  const double back = near - far, forth = across - near;
  const double s = (2.0 * back * forth + smallest) / (back * back + forth * forth + smallest);
  return near + 0.25 * s * ((1.0 - s * (1.0 / 3.0)) * back + (1.0 + s * (1.0 / 3.0)) * forth);
}

template <bool Limited>
inline double face_value(double far, double near, double across, [[maybe_unused]] double smallest) {
  if constexpr (Limited)
    return reconstruct_limited(far, near, across, smallest);
  else
    return reconstruct(far, near, across);
}

/// Mass and momentum flux without friction through `count` faces from offset `first`, faces of direction
/// `direction` (F8). p is relative to the hydrostatic reference.
template <int D, bool Compressible, bool Limited>
void inviscid_row(const Block<D>& block, const double* p, const State<D>& q, std::size_t direction,
                  std::ptrdiff_t first, std::ptrdiff_t count, const FluxConstants<D>& k,
                  const FluxRow<D>& out) {
  const std::ptrdiff_t s = block.extent.stride[direction];
  const double* __restrict p_c = p + first;
  const double* __restrict p_r = block.reference_pressure.data() + first;
  const double* __restrict volume = block.volume.data() + first;
  const double* __restrict u_0 = q.u[0].data() + first;
  const double* __restrict u_1 = q.u[1].data() + first;
  const double* __restrict u_2 = q.u[D - 1].data() + first;
  const double* __restrict a_0 = block.area[direction][0].data() + first;
  const double* __restrict a_1 = block.area[direction][1].data() + first;
  const double* __restrict a_2 = block.area[direction][D - 1].data() + first;
  double* __restrict f_m = out.mass;
  double* __restrict f_0 = out.momentum[0];
  double* __restrict f_1 = out.momentum[1];
  double* __restrict f_2 = out.momentum[D - 1];
  const double c0 = k.c0, rho0 = k.rho0, half_rho_c0 = 0.5 * k.rho0 * k.c0;
  const double half_over_rho = 0.5 / k.rho0;
  const MassSpeed speed = k.speed;
  const double inverse_c2 = k.inverse_c2, p0 = k.p0;
  const double half_upwinding = 0.5 * k.upwinding;
  // differences far below these are round-off, not structure
  const double small_u = 1e-12 * c0 * c0, small_p = small_u * rho0 * rho0 * c0 * c0;
#pragma omp simd
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const double p_l = face_value<Limited>(p_c[i - 2 * s], p_c[i - s], p_c[i], small_p);
    const double p_rt = face_value<Limited>(p_c[i + s], p_c[i], p_c[i - s], small_p);
    const double u0_l = face_value<Limited>(u_0[i - 2 * s], u_0[i - s], u_0[i], small_u);
    const double u0_r = face_value<Limited>(u_0[i + s], u_0[i], u_0[i - s], small_u);
    const double u1_l = face_value<Limited>(u_1[i - 2 * s], u_1[i - s], u_1[i], small_u);
    const double u1_r = face_value<Limited>(u_1[i + s], u_1[i], u_1[i - s], small_u);
    const double a0 = a_0[i], a1 = a_1[i];
    double through_l = u0_l * a0 + u1_l * a1;
    double through_r = u0_r * a0 + u1_r * a1;
    double s2 = a0 * a0 + a1 * a1;
    double u2_l = 0.0, u2_r = 0.0, a2 = 0.0;
    if constexpr (D == 3) {
      u2_l = face_value<Limited>(u_2[i - 2 * s], u_2[i - s], u_2[i], small_u);
      u2_r = face_value<Limited>(u_2[i + s], u_2[i], u_2[i - s], small_u);
      a2 = a_2[i];
      through_l += u2_l * a2;
      through_r += u2_r * a2;
      s2 += a2 * a2;
    }
    const double measure = std::sqrt(s2);
    const double inverse_measure = 1.0 / measure;
    const double h = 0.5 * (volume[i] + volume[i - s]) * inverse_measure;
    const double flow =
        0.5 * (through_l + through_r) + measure * (p_l - p_rt) * half_over_rho * speed.inverse(h);
    const double p_mean = 0.5 * (p_l + p_rt);
    const double p_face = p_mean + half_rho_c0 * (through_l - through_r) * inverse_measure;
    double rho = rho0;
    if constexpr (Compressible) rho += (p_mean + 0.5 * (p_r[i] + p_r[i - s]) - p0) * inverse_c2;
    const double m = rho * flow;
    f_m[i] = m;
    const double from_l = 0.5 * m + half_upwinding * std::abs(m), from_r = m - from_l;
    f_0[i] = from_l * u0_l + from_r * u0_r + p_face * a0;
    f_1[i] = from_l * u1_l + from_r * u1_r + p_face * a1;
    if constexpr (D == 3) f_2[i] = from_l * u2_l + from_r * u2_r + p_face * a2;
  }
}

/// Subtracts the full stress's force T A through the faces (F9). The gradient is that of the dual cell around
/// the face: compact difference along `direction`, means of central ones across.
template <int D>
void subtract_stress_row(const Block<D>& block, const State<D>& q, std::size_t direction,
                         std::ptrdiff_t first, std::ptrdiff_t count, double mu, const FluxRow<D>& out) {
  const std::ptrdiff_t s = block.extent.stride[direction];
  const double* __restrict volume = block.volume.data() + first;
  std::array<const double*, D> u, a;
  for (std::size_t c = 0; c < D; ++c) {
    u[c] = q.u[c].data() + first;
    a[c] = block.area[direction][c].data() + first;
  }
  std::array<std::ptrdiff_t, D - 1> t;                // the strides across
  std::array<std::array<const double*, D>, D - 1> b;  // and their faces' areas
  for (std::size_t e = 0, other = 0; other < D; ++other) {
    if (other == direction) continue;
    t[e] = block.extent.stride[other];
    for (std::size_t c = 0; c < D; ++c) b[e][c] = block.area[other][c].data() + first;
    ++e;
  }
#pragma omp simd
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    double gradient[D][D];  // [velocity component][derivative], times the dual cell's volume
    for (std::size_t c = 0; c < D; ++c) {
      const double along = u[c][i] - u[c][i - s];
      for (std::size_t l = 0; l < D; ++l) gradient[c][l] = a[l][i] * along;
    }
    for (std::size_t e = 0; e + 1 < D; ++e) {
      double b_mean[D];
      for (std::size_t l = 0; l < D; ++l)
        b_mean[l] = 0.25 * (b[e][l][i] + b[e][l][i + t[e]] + b[e][l][i - s] + b[e][l][i - s + t[e]]);
      for (std::size_t c = 0; c < D; ++c) {
        const double across =
            0.25 * (u[c][i + t[e]] - u[c][i - t[e]] + u[c][i - s + t[e]] - u[c][i - s - t[e]]);
        for (std::size_t l = 0; l < D; ++l) gradient[c][l] += b_mean[l] * across;
      }
    }
    const double factor = 2.0 * mu / (volume[i] + volume[i - s]);
    for (std::size_t c = 0; c < D; ++c) {
      double traction = 0.0;
      for (std::size_t l = 0; l < D; ++l) traction += (gradient[c][l] + gradient[l][c]) * a[l][i];
      out.momentum[c][i] -= factor * traction;
    }
  }
}

}  // namespace littoral::fv
