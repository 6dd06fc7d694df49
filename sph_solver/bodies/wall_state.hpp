#pragma once

#include <algorithm>
#include <cmath>

#include "bodies/wall_view.hpp"
#include "physics/kernel.hpp"
#include "physics/riemann.hpp"

namespace littoral::sph {

/// What the pair terms need of one particle: its state and, with reconstruction, its gradients.
template <int D>
struct PairSide {
  Vector<D> u;                      // [m/s]
  double p, rho;                    // [Pa, kg/m^D]
  Vector<D> grad_p{};               // [Pa/m]
  std::array<Vector<D>, D> grad_u;  // [1/s] grad_u[a][b] = d u_a / d x_b; 0: first order
};

/// The field that a particle and a wall make behind the wall: states at the midpoint between the particle and
/// a dummy.
template <int D>
struct WallFace {
  Vector<D> jump;  // u_E - u_i [m/s]
  double p;        // p_E [Pa]
};

/// One-sided Riemann problem (S12). The particle's state is carried on linearly by its gradients, only the
/// pressure's slope along the normal is the wall's, rho (f - a_w) . n (f: mass force), and to the wall the
/// velocity
///   u_n^L = (u_i + d grad u_i . n) . n       (d: distance from the wall; limited against u_w - u_i)
/// meets its mirror image about the wall's. The star state takes the difference e = u_n^L - u_w . n away:
///   u_E = u_i + grad u_i . dx/2 - e n,   p_E = p_i + grad p . dx/2 + rho c e,
/// so that a field that satisfies the wall's conditions is carried through it unchanged. First order: the
/// slopes are zero, but that of the pressure rho (f - a_w). Whatever the pairs of particles use, a wall
/// answers with the full impedance rho c: it alone keeps particles out. dx: from the particle to the dummy
template <int D, Reconstruction variant>
inline WallFace<D> wall_face(const PairSide<D>& i, const WallPlane<D>& wall, const Vector<D>& dx,
                             const Vector<D>& f, double c) {
  WallFace<D> face{};
  Vector<D> still;  // slope of the pressure in water at rest with the wall
  for (std::size_t d = 0; d < D; ++d) still[d] = i.rho * (f[d] - wall.a[d]);
  double excess = dot_of<D>(i.u, wall.n) - dot_of<D>(wall.u, wall.n);
  face.p = i.p;
  if constexpr (variant == Reconstruction::first_order) {
    face.p += 0.5 * dot_of<D>(still, dx);
  } else {
    const double along = dot_of<D>(dx, wall.n);
    face.p += 0.5 * (dot_of<D>(i.grad_p, dx) + along * dot_of<D>(still, wall.n) -
                     along * dot_of<D>(i.grad_p, wall.n));
    double slope = 0.0;
    for (std::size_t d = 0; d < D; ++d) {
      face.jump[d] = 0.5 * dot_of<D>(i.grad_u[d], dx);
      slope += wall.n[d] * dot_of<D>(i.grad_u[d], wall.n);
    }
    excess += 0.5 * limited_difference<variant>(2.0 * wall.distance * slope, -2.0 * excess);
  }
  for (std::size_t d = 0; d < D; ++d) face.jump[d] -= excess * wall.n[d];
  face.p += i.rho * c * excess;
  return face;
}

/// A dummy with a state of its own.
template <int D>
struct DummySide {
  Vector<D> u, a;  // [m/s, m/s^2] a: of the wall
  double p, rho;   // [Pa, kg/m^D]
};

/// Riemann problem (S5) between a particle and a dummy (Adami, Hu & Adams 2012, in Riemann form): pressures
/// are carried on to the midpoint, by the particle's gradient and by the slope of water at rest, velocities
/// stay.
template <int D, Reconstruction variant>
inline WallFace<D> dummy_face(const PairSide<D>& i, const DummySide<D>& dummy, const Vector<D>& dx,
                              const Vector<D>& f, double c, double kernel_radius) {
  const double r = std::max(k_least_distance * kernel_radius, std::sqrt(dot_of<D>(dx, dx)));
  double rest = 0.0;
  for (std::size_t d = 0; d < D; ++d) rest += i.rho * (f[d] - dummy.a[d]) * dx[d];
  const double dp = dummy.p - i.p, u_l = dot_of<D>(i.u, dx) / r, u_r = dot_of<D>(dummy.u, dx) / r;
  const double p_l = i.p + 0.5 * limited_difference<variant>(dot_of<D>(i.grad_p, dx), dp);
  const double p_r = dummy.p - 0.5 * limited_difference<variant>(rest, dp);
  const FaceState star = riemann_state(i.rho, u_l, p_l, dummy.rho, u_r, p_r, c);
  WallFace<D> face{};
  for (std::size_t d = 0; d < D; ++d) face.jump[d] = (star.u - u_l) * dx[d] / r;
  face.p = star.p;
  return face;
}

}  // namespace littoral::sph
