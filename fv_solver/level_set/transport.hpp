#pragma once

#include <vector>

#include "level_set/band.hpp"
#include "level_set/patches.hpp"
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
/// with u_s the velocity of the closest surface point (extend.hpp), on both sides. grad phi by third-order
/// upwind differences along the grid lines, turned into space by those of the centres, so that linear phi is
/// exact on any grid; in the outermost two layers, whose differences would reach beyond the band, by the
/// normal of the nearest patch. Band and patches stay those of phi^n.
template <int D>
struct SurfaceStep {
  BackwardDifference time;
  const std::vector<Field>& phi_n;             // [m] [block]
  const std::vector<Field>& phi_nm1;           // [m] not read where a2 = 0
  const std::vector<SurfaceForcing>& forcing;  // [block], or empty
  const Band<D>& band;
  const SurfacePatches<D>& patches;
};

/// Point-implicit sweeps phi -= R / (a0 + rate + 3/2 sum |U_d|), U cells a second. All cells are updated
/// at once, so their order does not matter. A sweep leaves .26 of the error at a surface CFL of .3, .57 at 1,
/// .94 at 5. The weights of upwinding, which depend on phi at its ridges, are those of the phi given.
/// in/out phi, ghosts current before and after; comm exchange of phi once a sweep
/// returns the largest residual of the phi given [m/s], of these blocks
template <int D>
double transport(const std::vector<Block<D>>& blocks, const Exchange<D>& exchange, const SurfaceStep<D>& step,
                 const std::vector<VectorField<D>>& surface_velocity, int sweeps, std::vector<Field>& phi);

/// Largest sum_d |U_d| in layers 0 and 1 [1/s], of these blocks: times dt it is the surface's CFL.
template <int D>
double surface_rate(const std::vector<Block<D>>& blocks, const Band<D>& band,
                    const std::vector<VectorField<D>>& surface_velocity);

}  // namespace littoral::fv
