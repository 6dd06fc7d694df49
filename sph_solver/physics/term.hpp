#pragma once

#include <array>
#include <utility>

#include "littoral/support/formula.hpp"
#include "neighbors/neighbor_list.hpp"
#include "particles/particles.hpp"
#include "physics/rate.hpp"

namespace littoral::sph {

/// A force besides pressure: one object that a step holds or does not hold, decided from the scene.
template <int D>
struct Term {
  virtual ~Term() = default;
  /// Adds to rate.acceleration, owned part, at time t [s]; copies current. comm: local
  virtual void add(const Particles<D>& particles, const NeighborList<D>& neighbors, double t,
                   Rate<D>& rate) const = 0;
};

/// du_i/dt += g
template <int D>
class Gravity : public Term<D> {
 public:
  explicit Gravity(const std::array<double, D>& g) : g_(g) {}
  void add(const Particles<D>& particles, const NeighborList<D>&, double, Rate<D>& rate) const override {
    for (std::size_t d = 0; d < D; ++d)
      for (std::size_t i = 0; i < particles.n_owned; ++i) rate.acceleration[d][i] += g_[d];
  }

 private:
  std::array<double, D> g_;  // [m/s^2]
};

/// du_i/dt += f(x_i, t), an acceleration by formula
template <int D>
class BodyForce : public Term<D> {
 public:
  using Field = std::array<support::Formula, D>;  // [m/s^2] along each axis
  explicit BodyForce(Field field) : field_(std::move(field)) {}
  void add(const Particles<D>& particles, const NeighborList<D>& neighbors, double t,
           Rate<D>& rate) const override;

 private:
  Field field_;
};

/// Monaghan-Gingold viscosity (S8):
///   m_i du_i/dt += 2 (D+2) rho0 nu V_i sum_j V_j (u_ij . x_ij) / |x_ij|^2 grad W_ij
/// On a Cartesian lattice it returns .886 (2-D, R = 3dx), .959 (2-D, R = 4dx), .887 (3-D, R = 2.7dx) of nu
/// lap u.
template <int D>
class Viscosity : public Term<D> {
 public:
  explicit Viscosity(double dynamic_viscosity) : mu_(dynamic_viscosity) {}
  void add(const Particles<D>& particles, const NeighborList<D>& neighbors, double t,
           Rate<D>& rate) const override;

 private:
  double mu_;  // rho0 nu [Pa s]
};

/// Pressure force under tension (S15): (11) with p_j - p_i in place of p_i + p_j for a particle more than a
/// kernel radius from the surface whose pressure is below p0 (Sun et al. 2018), that is
///   m_i du_i/dt += 2 V_i (p_i - p0) sum_j V_j grad W_ij
/// Between particles that pull each other (11) makes clumps; this part of it, which is zero on an even
/// distribution, is what does. Without it momentum is conserved up to the order of the scheme only.
template <int D>
class TensionSwitch : public Term<D> {
 public:
  explicit TensionSwitch(double reference_pressure) : p0_(reference_pressure) {}
  /// What the pair loops take off, if it is not p0 (scenes without a surface) [Pa].
  void set_level(double level) { p0_ = level; }
  void add(const Particles<D>& particles, const NeighborList<D>& neighbors, double t,
           Rate<D>& rate) const override;

 private:
  double p0_;  // [Pa]
};

extern template class TensionSwitch<2>;
extern template class TensionSwitch<3>;
extern template class BodyForce<2>;
extern template class BodyForce<3>;
extern template class Viscosity<2>;
extern template class Viscosity<3>;

}  // namespace littoral::sph
