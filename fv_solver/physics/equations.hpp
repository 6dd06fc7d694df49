#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "grid/block.hpp"
#include "physics/fluid.hpp"
#include "physics/time_scheme.hpp"

namespace littoral::fv {

enum class Limiter : std::uint8_t { none, van_albada };

/// What momentum is carried with through a face (F8).
///   upwind3   the third-order value of the side it comes from
///   central4  the mean of both sides, which is fourth-order central, with a quarter of the upwind value's
///             third-difference dissipation: |m|/48, between the 1/64 and 1/32 usual in central schemes
enum class FluxScheme : std::uint8_t { upwind3, central4 };
inline double upwinding(FluxScheme scheme) { return scheme == FluxScheme::upwind3 ? 1.0 : 0.25; }

/// The wave speed of the mass flux (F8), c_p = max(c0, kappa h/dt, 2 nu/h): pressure is damped by as much as
/// the momentum's inertia or friction, whichever is larger, leaves of the compact Laplacian of the projected
/// equations. Residual, Jacobian and coarse levels use the same rule, each with its own h.
template <class Real>
struct MassSpeedOf {
  Real slowest;    // [s/m] 1/c0
  Real inertia;    // [1/s] kappa/dt
  Real diffusion;  // [m^2/s] 2 nu
  template <class Other>
  MassSpeedOf<Other> as() const {
    return {static_cast<Other>(slowest), static_cast<Other>(inertia), static_cast<Other>(diffusion)};
  }
  /// 1/c_p [s/m].   h: volume of the face's dual cell over the face's measure [m]
  /// T: Real, or several of them in lanes
  template <class T>
  T inverse(const T& h) const {
    const T wide = inertia * h * h, thin = diffusion + T{}, at_most = slowest + T{};
    const T slow = h / (wide > thin ? wide : thin);
    return slow < at_most ? slow : at_most;
  }
};
using MassSpeed = MassSpeedOf<double>;

/// The two speeds of the Riemann problem (F8): c0 = sqrt(beta) in the momentum's dissipation, c_p in the mass
/// flux.
struct WaveSpeeds {
  double c0 = 1.0;     // [m/s]
  double kappa = 0.5;  // [-]
  /// The slowest wave speed of a far field [m/s]: still water needs one, too.
  double least_far() const { return 0.1 * c0; }
  MassSpeed mass(double dt, double viscosity) const {
    constexpr double k_diffusion = 2.0;  // Fourier modes at rest: implicit/README.md
    return {1.0 / c0, kappa / dt, k_diffusion * viscosity};
  }
};

/// Forcing of (21) on one block: empty arrays where the block has no forced cell.
template <int D>
struct Forcing {
  Field rate;           // [1/s] of u: K/delta, or a damping zone's strength; 0 in cells that are not forced
  Field pressure_rate;  // [1/s] of p: K/delta, 0 where u alone is; empty: so everywhere
  State<D> target;      // q*
  double psi = 0.0;     // [s^2/m^2] d rho/d p in the mass row: 1/c^2, or 1/c0^2 where c is infinite
  bool active() const { return !rate.empty(); }
};

template <int D>
struct BlockSurface;  // free_surface/cut_faces.hpp

/// The old time levels and sources of one step, per volume: the time term of a row is
/// V (a0 q + history), q = (p - P)/c^2 (the part of rho that changes) or rho u. Steady: minus the sources.
template <int D>
using History = Residual<D>;  // [kg/(m^3 s)], [N/m^3]

/// The discrete equations (4)-(5) of one fluid: what every block solves. A row's residual is
///
///   mass      V (a0 (p - P)/c^2 + history) + sum_f m_f                       [+ V K/delta psi (p - p*)]
///   momentum  V (a0 rho u + history) + sum_f (m_f u_f + p_f A - T A) - V (rho - rho(P)) g
///                                                                    [+ V K/delta rho0 (u - u*)]
/// with pressures relative to the hydrostatic reference P, and at a face with area vector A, S = |A|,
/// states L and R by third-order reconstruction of p - P and u (F6-F8):
///
///   m_f = rho_f [ (u_L + u_R)/2 . A + S (p_L - p_R) / (2 rho0 c_p) ]
///   p_f = (p_L + p_R)/2 + rho0 c0 (u_L - u_R) . A / (2 S)
///   u_f = (u_L + u_R)/2 + a sign(m_f) (u_L - u_R)/2, a = 1: upwind; see FluxScheme
///
/// Rows of blanked and fringe cells are zero.
template <int D>
struct Equations {
  Fluid<D> fluid;
  WaveSpeeds speeds;
  Limiter limiter = Limiter::none;
  FluxScheme flux = FluxScheme::upwind3;

  /// in   q with ghosts current (fill_ghosts), block metrics, windows evaluated
  ///      surface: where the free surface cuts the block, its cut faces found; null: nowhere
  /// out  r (resized if needed), inner cells
  /// comm local; OpenMP inside; not to be called for two blocks at the same time (workspace)
  void residual(const Block<D>& block, const State<D>& q, const BackwardDifference& time,
                const History<D>& history, const Forcing<D>& forcing, Residual<D>& r,
                const BlockSurface<D>* surface = nullptr) const;

 private:
  mutable Field relative_pressure_;  // [Pa] p - P, of the block last evaluated
};

}  // namespace littoral::fv
