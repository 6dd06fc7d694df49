#pragma once

#include <vector>

#include "level_set/band.hpp"
#include "level_set/patches.hpp"

namespace littoral::fv {

/// Continues u linearly from water (phi < 0) into the first `layers` layers of air cells:
///   u_c = sum_b w_b (u_b + G_b (x_c - x_b)),  G_c = sum_b w_b G_b
/// over the neighbours b (diagonals included) that are water or were reached before, w_b growing with how
/// well x_c - x_b follows the surface's normal; G_b of water is a least-squares gradient of water cells.
/// Linear u is exact on any grid. Air beyond is left alone.
/// Cells that were water a step ago and are air now need no special care: they are continued as others.
/// in/out u of all blocks (pass the velocity fields of one time level); ghosts are not filled: call
/// Exchange::states. pre ghosts of u and phi current; band of phi with at least `layers` layers
/// comm exchange of u, its gradient and a mark, once a layer
template <int D>
void extend_velocity(const std::vector<Block<D>>& blocks, const Exchange<D>& exchange, const Band<D>& band,
                     const SurfacePatches<D>& patches, const std::vector<Field>& phi, int layers,
                     const std::vector<VectorField<D>*>& u);

/// u_s: the velocity of each band cell's closest surface point, [block] ghosts behind joins and periodic
/// faces included. Layer 0 interpolates u (quadratic in the grid's directions, water and continued air) at
/// its foot; layers beyond carry that along the normal (first-order, layer by layer). pre u is continued into
/// two layers of air at least, ghosts current; comm exchange of u_s once a layer
template <int D>
void surface_velocity(const std::vector<Block<D>>& blocks, const Exchange<D>& exchange, const Band<D>& band,
                      const SurfacePatches<D>& patches, const std::vector<const VectorField<D>*>& u,
                      std::vector<VectorField<D>>& u_s);

}  // namespace littoral::fv
