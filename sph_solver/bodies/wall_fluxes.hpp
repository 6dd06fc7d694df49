#pragma once

#include "bodies/dummy_states.hpp"
#include "bodies/wall_list.hpp"
#include "physics/gradients.hpp"
#include "physics/numerics.hpp"
#include "physics/rate.hpp"

namespace littoral::sph {

/// Forces of the particles of a row on the bodies they see, [row * n_bodies + body][d], in N (N/m in 2-D).
template <int D>
using RowForces = std::vector<std::array<double, D>>;

/// Pairs of particle and dummy (S12):
///   dV_i/dt += 2 V_i sum_j V_j (u_E - u_i) . grad W_ij,   m_i du_i/dt -= 2 V_i sum_j V_j (p_E - p*) grad
///   W_ij
/// in    particles, gradients of the rows with reconstruction
///       states: of the dummies, where numerics.wall_states are extrapolated
///       mass_force: of each row
///       level: p* [Pa], as in the pairs of particles: p0 with a free surface
/// out   rate added to; forces (n_rows * n_bodies): the reaction, to the bit
/// comm  local
template <int D>
void add_wall_fluxes(const Particles<D>& particles, const Gradients<D>& gradients,
                     const std::vector<Body>& bodies, const Dummies<D>& dummies, const DummyStates<D>& states,
                     const WallList<D>& list, const RowAccelerations<D>& mass_force,
                     const Numerics<D>& numerics, double level, std::size_t n_bodies, Rate<D>& rate,
                     RowForces<D>& forces);

extern template void add_wall_fluxes<2>(const Particles<2>&, const Gradients<2>&, const std::vector<Body>&,
                                        const Dummies<2>&, const DummyStates<2>&, const WallList<2>&,
                                        const RowAccelerations<2>&, const Numerics<2>&, double, std::size_t,
                                        Rate<2>&, RowForces<2>&);
extern template void add_wall_fluxes<3>(const Particles<3>&, const Gradients<3>&, const std::vector<Body>&,
                                        const Dummies<3>&, const DummyStates<3>&, const WallList<3>&,
                                        const RowAccelerations<3>&, const Numerics<3>&, double, std::size_t,
                                        Rate<3>&, RowForces<3>&);

}  // namespace littoral::sph
