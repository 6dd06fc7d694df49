#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "implicit/lanes.hpp"
#include "implicit/level_grid.hpp"
#include "physics/equations.hpp"

namespace littoral::fv {

/// What the linear correction has to know of the equations and of the time step.
template <int D>
struct CorrectionPhysics {
  Fluid<D> fluid;
  WaveSpeeds speeds;
  BackwardDifference time;
  double forcing_psi = 0.0;  // [s^2/m^2] d rho/d p in the mass row's forcing
  double jump = 1.0;         // [-] of a level: part of the pressure's first-order jump in the mass flux (I8)

  /// In front of a known pressure, where the jump is whole in the residual, too.
  MassSpeed mass_speed() const { return speeds.mass(time.dt, fluid.viscosity); }
  MassSpeed mass_speed_between_cells() const {
    return WaveSpeeds{speeds.c0, speeds.kappa / jump}.mass(time.dt, fluid.viscosity);
  }
};

/// T: a number, or one in each lane.
template <int D, class T = double>
struct SmallMatrix {
  T entry[D + 1][D + 1] = {};
  T* operator[](std::size_t i) { return entry[i]; }
  const T* operator[](std::size_t i) const { return entry[i]; }
};

/// The velocity a face sees on one side.
template <int D, class T = double>
struct FaceState {
  std::array<T, D> u{};  // [m/s]
};

/// Derivatives of the first-order flux through a face by the states on its two sides, scaled:
/// unknowns (p / (rho0 c0), u), rows (mass c0 / rho0, momentum / rho0), so that the entries compare.
///
///   m = rho [ (u_L + u_R).S / 2 - S (p_R - p_L) / (2 rho c_p) ],
///       c_p = max(c0, kappa h / (jump dt), 2 nu/h)
///   F = m u_upwind + S (p_L + p_R)/2 - S rho c0 (u_R - u_L).n / 2
///       - rho nu/V_f [S^2 (u_R - u_L) + S (u_R - u_L).S]
/// The last bracket is the full stress's compact part: friction along the face's normal counts twice. With
/// once, the normal momentum of thin cells at a wall is under-relaxed so far that it grows from cycle to
/// cycle. in    area S [m^(D-1)], pointing from left to right; volume V_f of the face's cell [m^D]
template <int D, class T, class Area>
inline void face_jacobian(const Area& area, const T& volume, const FaceState<D, T>& left,
                          const FaceState<D, T>& right, const CorrectionPhysics<D>& physics,
                          const MassSpeedOf<LaneReal<T>>& mass_speed, SmallMatrix<D, T>& by_left,
                          SmallMatrix<D, T>& by_right) {
  using Real = LaneReal<T>;
  constexpr Real half = Real(0.5);
  T s2{}, flow{};
  for (std::size_t k = 0; k < D; ++k) {
    s2 += area[k] * area[k];
    flow += half * (left.u[k] + right.u[k]) * area[k];
  }
  // a face collapsed to an axis passes nothing: all terms but the first carry its area
  constexpr Real k_no_area = std::numeric_limits<Real>::min();
  s2 = s2 > k_no_area ? s2 : k_no_area + T{};
  const T s = square_root(s2);
  const auto c0 = static_cast<Real>(physics.speeds.c0);
  const auto density_by_p =
      static_cast<Real>(physics.speeds.c0 * physics.fluid.inverse_c2);  // d(rho/rho0)/dP
  const T h = volume / s;
  const T pressure_term = half * c0 * s * mass_speed.inverse(h);
  const T zero{};
  const T out = flow > zero ? flow : zero, in = flow > zero ? zero : flow;

  // dm/rho0 by the scaled unknowns
  T m_left[D + 1], m_right[D + 1], upwind[D];
  for (std::size_t k = 0; k < D; ++k) upwind[k] = flow >= zero ? left.u[k] : right.u[k];
  m_left[0] = pressure_term + density_by_p * out;
  m_right[0] = density_by_p * in - pressure_term;
  for (std::size_t k = 0; k < D; ++k) m_left[k + 1] = m_right[k + 1] = half * area[k];

  const T per_area2 = static_cast<Real>(physics.fluid.viscosity) / volume;
  const T friction = per_area2 * s2;
  const T carry_left = out + friction;
  const T carry_right = in - friction;
  const T along_normal_per_s2 = half * c0 / s + per_area2;
  for (std::size_t j = 0; j <= D; ++j) {
    by_left[0][j] = c0 * m_left[j];
    by_right[0][j] = c0 * m_right[j];
  }
  for (std::size_t i = 0; i < D; ++i) {
    for (std::size_t j = 0; j <= D; ++j) {
      by_left[i + 1][j] = upwind[i] * m_left[j];
      by_right[i + 1][j] = upwind[i] * m_right[j];
    }
    by_left[i + 1][0] += half * c0 * area[i];
    by_right[i + 1][0] += half * c0 * area[i];
    by_left[i + 1][i + 1] += carry_left;
    by_right[i + 1][i + 1] += carry_right;
    for (std::size_t j = 0; j < D; ++j) {
      const T along_normal = along_normal_per_s2 * area[i] * area[j];
      by_left[i + 1][j + 1] += along_normal;
      by_right[i + 1][j + 1] -= along_normal;
    }
  }
}

/// Physical-time term, gravity on the density's correction, and the forcing K/delta (21): the cell's own
/// block.
template <int D, class T>
inline void add_cell_jacobian(const T& volume, const T& forcing, const FaceState<D, T>& state,
                              const CorrectionPhysics<D>& physics, SmallMatrix<D, T>& block) {
  const T rate = volume * (physics.time.a0 + forcing);
  const double c0 = physics.speeds.c0;
  const double density_by_p = c0 * physics.fluid.inverse_c2;
  block[0][0] += volume * c0 * (physics.time.a0 * density_by_p + forcing * c0 * physics.forcing_psi);
  for (std::size_t i = 0; i < D; ++i) {
    block[i + 1][i + 1] += rate;
    block[i + 1][0] += volume * density_by_p * (physics.time.a0 * state.u[i] - physics.fluid.gravity[i]);
  }
}

/// Derivative of the flux through a boundary face by the state of the cell inside, as the residual closes
/// that face; scaled as face_jacobian. in    area pointing outward; volume of the cell inside;
/// imposed_distance see LevelGrid
template <int D>
inline SmallMatrix<D> boundary_jacobian(EdgeCondition condition, const std::array<double, D>& area,
                                        double volume, const FaceState<D>& inside,
                                        const CorrectionPhysics<D>& physics, double far_speed,
                                        double imposed_distance) {
  SmallMatrix<D> block{};
  double s2 = 0.0, flow = 0.0, speed2 = 0.0;
  for (std::size_t k = 0; k < D; ++k) {
    s2 += area[k] * area[k];
    flow += inside.u[k] * area[k];
    speed2 += inside.u[k] * inside.u[k];
  }
  if (s2 <= 0.0) return block;
  const double s = std::sqrt(s2), c0 = physics.speeds.c0;
  const auto push = [&](double part) {  // pressure on the face, from the cell inside
    for (std::size_t i = 0; i < D; ++i) block[i + 1][0] += part * c0 * area[i];
  };
  const auto rub = [&] {  // the face's velocity is known
    const double rate = 2.0 * physics.fluid.viscosity / volume;
    for (std::size_t i = 0; i < D; ++i) {
      block[i + 1][i + 1] += rate * s2;
      for (std::size_t j = 0; j < D; ++j) block[i + 1][j + 1] += rate * area[i] * area[j];
    }
  };
  const auto carry = [&](double slowness,
                         double part) {  // m = part (u.S + S p slowness/rho0), and what it carries
    std::array<double, D + 1> m;
    m[0] = part * c0 * s * slowness + c0 * physics.fluid.inverse_c2 * std::max(flow, 0.0);
    for (std::size_t k = 0; k < D; ++k) m[k + 1] = part * area[k];
    for (std::size_t j = 0; j <= D; ++j) {
      block[0][j] += c0 * m[j];
      for (std::size_t i = 0; i < D; ++i) block[i + 1][j] += inside.u[i] * m[j];
    }
    for (std::size_t i = 0; i < D; ++i) block[i + 1][i + 1] += std::max(flow, 0.0);
  };
  switch (condition) {
    case EdgeCondition::wall:
      push(1.0);
      rub();
      break;
    case EdgeCondition::slip:
    case EdgeCondition::link:
      push(1.0);
      break;
    case EdgeCondition::inflow:
      push(1.0);
      rub();
      break;
    case EdgeCondition::outflow:
      carry(physics.mass_speed().inverse(volume / s), 1.0);
      break;
    case EdgeCondition::far_field: {
      const double speed =
          far_speed > 0.0 ? far_speed : std::max(std::sqrt(speed2), physics.speeds.least_far());
      carry(1.0 / speed, 0.5);
      push(0.5);
      for (std::size_t i = 0; i < D; ++i)
        for (std::size_t j = 0; j < D; ++j) block[i + 1][j + 1] += 0.5 * speed * area[i] * area[j] / s;
      break;
    }
    case EdgeCondition::imposed: {
      // linear from the cell through the known value: the ghost's correction is `image` times the cell's
      const double image = -(1.0 - imposed_distance) / (1.0 + imposed_distance);
      SmallMatrix<D> by_ghost;
      face_jacobian<D, double>(area, volume, inside, inside, physics, physics.mass_speed_between_cells(),
                               block, by_ghost);
      for (std::size_t i = 0; i <= D; ++i)
        for (std::size_t j = 0; j <= D; ++j) block[i][j] += image * by_ghost[i][j];
      break;
    }
  }
  return block;
}

/// How a correction continues beyond a face when levels are interpolated: the ghost's value is this matrix
/// times the cell's.
template <int D>
inline SmallMatrix<D> mirror(EdgeCondition condition, const std::array<double, D>& area,
                             double imposed_distance) {
  SmallMatrix<D> m{};
  double s2 = 0.0;
  for (double a : area) s2 += a * a;
  const double image = -(1.0 - imposed_distance) / (1.0 + imposed_distance);
  const bool anchored = condition == EdgeCondition::imposed || condition == EdgeCondition::far_field;
  m[0][0] = anchored ? image : condition == EdgeCondition::outflow ? -1.0 : 1.0;
  const bool known_velocity = condition == EdgeCondition::wall || condition == EdgeCondition::inflow;
  for (std::size_t i = 0; i < D; ++i) {
    m[i + 1][i + 1] = anchored ? image : known_velocity ? -1.0 : 1.0;
    if (condition == EdgeCondition::slip && s2 > 0.0)
      for (std::size_t j = 0; j < D; ++j) m[i + 1][j + 1] -= 2.0 * area[i] * area[j] / s2;
  }
  return m;
}

}  // namespace littoral::fv
