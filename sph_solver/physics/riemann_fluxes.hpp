#pragma once

#include "neighbors/neighbor_list.hpp"
#include "pairs/pair_rows.hpp"
#include "particles/particles.hpp"
#include "physics/eos.hpp"
#include "physics/gradients.hpp"
#include "physics/rate.hpp"
#include "physics/riemann.hpp"

namespace littoral::sph {

/// Rate of volume and of momentum from the face states of all pairs (S6, S7):
///   dV_i/dt     =  2 V_i sum_j V_j (u_E - u_i) . grad W_ij
///   m_i du_i/dt = -2 V_i sum_j V_j (p_E - p0) grad W_ij
/// The pressure on the surface is taken off, so that a truncated kernel sees no force from it.
/// in    particles.V .m, owned; rows with states and faces, copies current
/// out   rate, owned part, overwritten
/// pre   lists hold every pair within the kernel radius
/// comm  local
template <int D, class Real>
void riemann_fluxes(const Particles<D>& particles, const PairRows<D, Real>& rows,
                    const NeighborList<D>& neighbors, const LinearEos& eos, Reconstruction reconstruction,
                    RiemannSolver solver, Rate<D>& rate);
/// The same in double, packing rows for this call alone; gradients are not read if first_order.
template <int D>
void riemann_fluxes(const Particles<D>& particles, const NeighborList<D>& neighbors,
                    const Gradients<D>& gradients, const LinearEos& eos, Reconstruction reconstruction,
                    RiemannSolver solver, Rate<D>& rate);

extern template void riemann_fluxes<2>(const Particles<2>&, const NeighborList<2>&, const Gradients<2>&,
                                       const LinearEos&, Reconstruction, RiemannSolver, Rate<2>&);
extern template void riemann_fluxes<3>(const Particles<3>&, const NeighborList<3>&, const Gradients<3>&,
                                       const LinearEos&, Reconstruction, RiemannSolver, Rate<3>&);

}  // namespace littoral::sph
