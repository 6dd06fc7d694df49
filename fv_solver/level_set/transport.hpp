#pragma once

#include <vector>

#include "level_set/band.hpp"
#include "physics/time_scheme.hpp"

namespace littoral::fv {

/// (23) on one block: rate (phi - phi*) is added to the equation of phi. Empty where nothing is forced.
struct SurfaceForcing {
  Field rate;    // [1/s] K/delta, or a damping zone's strength; 0 in cells that are not forced
  Field target;  // [m] phi*
  bool active() const { return !rate.empty(); }
};

/// The equation of phi (7), (23) in one step, for the solved cells of a band:
///   R = a0 phi + a1 phi^n + a2 phi^n-1 + u_s . grad phi + rate (phi - phi*)   [m/s]
/// u_s: the velocity of the closest surface point (extend.hpp), on both sides. Third-order upwind differences
/// along the grid lines, turned into space by those of the centres, so linear phi is exact on any grid.
template <int D>
struct SurfaceStep {
  BackwardDifference time;
  const std::vector<Field>* phi_n = nullptr;             // [m] phi^n
  const std::vector<Field>* phi_nm1 = nullptr;           // [m] phi^n-1; not read where a2 = 0
  const std::vector<SurfaceForcing>* forcing = nullptr;  // one a block; null: none
};

/// out r [m/s] in the band's solved cells (others untouched), resized if needed
/// pre ghosts of phi current; comm local
template <int D>
void transport_residual(const std::vector<Block<D>>& blocks, const Band<D>& band, const SurfaceStep<D>& step,
                        const std::vector<Field>& phi, const std::vector<VectorField<D>>& surface_velocity,
                        std::vector<Field>& r);

struct TransportReport {
  int sweeps = 0;
  double first = 0.0, last = 0.0;  // [m/s] largest residual before and after
};

/// Point-implicit sweeps phi -= R / (a0 + rate + 3/2 sum |U_d|), U_d the contravariant velocity in cells a
/// second, until the largest residual is below `tolerance` [m/s] or for `max_sweeps`. The order of cells does
/// not matter. Converges for any surface CFL (by .26 a sweep at .3, .57 at 1, .94 at 5).
/// in/out phi, ghosts current on return; comm exchange of phi once a sweep, and a maximum
template <int D>
TransportReport transport(const std::vector<Block<D>>& blocks, const Exchange<D>& exchange,
                          const Band<D>& band, const SurfaceStep<D>& step,
                          const std::vector<VectorField<D>>& surface_velocity, int max_sweeps,
                          double tolerance, std::vector<Field>& phi);

/// Largest sum_d |U_d| of the cells of layers 0 and 1 [1/s]: times dt it is the surface's Courant number.
template <int D>
double surface_rate(const std::vector<Block<D>>& blocks, const Band<D>& band,
                    const std::vector<VectorField<D>>& surface_velocity);

}  // namespace littoral::fv
