#pragma once

#include <array>

#include "neighbors/neighbor_list.hpp"
#include "particles/particles.hpp"
#include "physics/rate.hpp"

namespace littoral::sph {

/// A force besides pressure: one object that a step holds or does not hold, decided from the scene.
template <int D>
struct Term {
  virtual ~Term() = default;
  /// Adds to rate.acceleration, owned part; copies current. comm: local
  virtual void add(const Particles<D>& particles, const NeighborList<D>& neighbors, Rate<D>& rate) const = 0;
};

/// du_i/dt += g
template <int D>
class Gravity : public Term<D> {
 public:
  explicit Gravity(const std::array<double, D>& g) : g_(g) {}
  void add(const Particles<D>& particles, const NeighborList<D>&, Rate<D>& rate) const override {
    for (std::size_t d = 0; d < D; ++d)
      for (std::size_t i = 0; i < particles.n_owned; ++i) rate.acceleration[d][i] += g_[d];
  }

 private:
  std::array<double, D> g_;  // [m/s^2]
};

/// Monaghan-Gingold viscosity (S8):
///   m_i du_i/dt += 2 (D+2) rho0 nu V_i sum_j V_j (u_ij . x_ij) / |x_ij|^2 grad W_ij
/// On a Cartesian lattice it returns .886 (2-D, R = 3dx), .959 (2-D, R = 4dx), .887 (3-D, R = 2.7dx) of nu
/// lap u.
template <int D>
class Viscosity : public Term<D> {
 public:
  explicit Viscosity(double dynamic_viscosity) : mu_(dynamic_viscosity) {}
  void add(const Particles<D>& particles, const NeighborList<D>& neighbors, Rate<D>& rate) const override;

 private:
  double mu_;  // rho0 nu [Pa s]
};

extern template class Viscosity<2>;
extern template class Viscosity<3>;

}  // namespace littoral::sph
