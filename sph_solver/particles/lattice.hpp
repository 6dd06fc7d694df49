#pragma once

#include <array>

#include "bodies/walls.hpp"
#include "littoral/support/scene.hpp"
#include "particles/particles.hpp"
#include "physics/eos.hpp"

namespace littoral::sph {

/// The part of a lattice that one of several ranks places at first: as many places each, one after the other.
struct LatticeShare {
  int rank = 0;
  int size = 1;
};

/// Fills a box with particles at lower + (i + 1/2) dx, where the scene has water at the start: V = dx^D,
/// states from the scene's formulas, m = rho(p) V. Appends to what is there.
/// Places inside a body stay empty (walls: null without bodies).
/// Places of other ranks' shares only count: a particle has the same id on any number of ranks.
template <int D>
void fill_lattice(const std::array<double, D>& lower, const std::array<double, D>& upper, double spacing,
                  const support::Scene& scene, const LinearEos& eos, Particles<D>& particles,
                  const LatticeShare& share = {}, const Walls<D>* walls = nullptr);

/// Gives the owned particles, wherever they are now, velocity, pressure and mass of the scene's start.
template <int D>
void set_start_states(const support::Scene& scene, const LinearEos& eos, Particles<D>& particles);

extern template void set_start_states<2>(const support::Scene&, const LinearEos&, Particles<2>&);
extern template void set_start_states<3>(const support::Scene&, const LinearEos&, Particles<3>&);
extern template void fill_lattice<2>(const std::array<double, 2>&, const std::array<double, 2>&, double,
                                     const support::Scene&, const LinearEos&, Particles<2>&,
                                     const LatticeShare&, const Walls<2>*);
extern template void fill_lattice<3>(const std::array<double, 3>&, const std::array<double, 3>&, double,
                                     const support::Scene&, const LinearEos&, Particles<3>&,
                                     const LatticeShare&, const Walls<3>*);

}  // namespace littoral::sph
