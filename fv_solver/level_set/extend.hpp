#pragma once

#include <cstdint>
#include <vector>

#include "level_set/band.hpp"
#include "level_set/patches.hpp"

namespace littoral::fv {

/// Continues u linearly from water into the first layers of air cells:
///   u_c = sum_b w_b (u_b + G_b (x_c - x_b)),  G_c = sum_b w_b G_b
/// over the neighbours b (diagonals included) that are water or were reached before, weighted with how near
/// they are and how well x_c - x_b follows the surface's normal; G_b of water is the least-squares gradient
/// of the water cells around. Linear u is exact on any grid. A cell with no such neighbour below it, within
/// 60 degrees of the normal, gets their mean without G: a film ahead of a front, thinner than half a cell,
/// goes as fast as the water beside it, for a change along the surface says nothing about what lies beyond
/// the water's end. Cells at the surface are reached however far they are. Air beyond keeps its values.
template <int D>
class VelocityExtension {
 public:
  /// in/out u[block]: of one time level, its air cells set `layers` deep; in the ghosts only those that stand
  /// for cells are: call Exchange::states
  /// wet: may have changed since the band and the patches, whose normals are used
  /// pre ghosts of u and wet current; the band has more than `layers` layers
  /// comm exchange of u, its gradient and a mark, once a layer; collective
  void extend(const std::vector<Block<D>>& blocks, const Exchange<D>& exchange, const Band<D>& band,
              const SurfacePatches<D>& patches, const std::vector<WetMask>& wet, int layers,
              const std::vector<VectorField<D>*>& u);
  /// Whether a cell is water or has got a velocity in the last call.
  bool reached(std::size_t block, std::size_t cell) const;

 private:
  void gradients_of_water(const std::vector<Block<D>>& blocks, const Band<D>& band,
                          const std::vector<VectorField<D>*>& u);
  struct Pass {
    bool found = false;   // a velocity for some cell
    bool misses = false;  // one for a cell at the surface
  };
  /// One pass over the cells of layers [0, layers) that have no velocity yet.
  void reach_further(const Block<D>& block, const Band<D>& band, const SurfacePatches<D>& patches,
                     std::size_t b, int pass, int layers, VectorField<D>& u, Pass& done);

  using Gradient = std::array<VectorField<D>, D>;  // [component][derivative] [1/s]
  std::vector<Gradient> gradient_;                 // [block]
  std::vector<Field> reached_;                     // [block] pass in which a cell got its value; 0: water
};

/// From a cell to the middle of the stencil that interpolates at its foot, along each direction of the grid.
template <int D>
using StencilStep = std::array<std::int8_t, D>;

/// u_s [m/s]: the velocity of the closest surface point, for the cells of a band and ghosts that stand for
/// them. Layer 0 interpolates u and its gradient (quadratic along the grid's directions, in water and
/// continued air) at its foot on the surface of phi; a cell further out takes both from where it has its
/// patch, and u_s = u + G (foot - base): second order in every layer.
template <int D>
class SurfaceVelocity {
 public:
  /// phi: may have moved on since the band and the patches
  /// settled: cells of layer 0 keep the stencil of the call before, on the same band: a foot halfway between
  /// two centres must not keep an inner iteration from converging
  /// pre u is continued into two layers of air at least, ghosts of u and phi current
  /// comm exchange of u and its gradient at the bases after each layer but the last, of u_s once
  void follow(const std::vector<Block<D>>& blocks, const Exchange<D>& exchange, const Band<D>& band,
              const SurfacePatches<D>& patches, const std::vector<Field>& phi,
              const std::vector<const VectorField<D>*>& u, bool settled, std::vector<VectorField<D>>& u_s);

 private:
  std::vector<VectorField<D>> base_;                     // [block] [m/s] u at the patch's base
  std::vector<std::array<VectorField<D>, D>> gradient_;  // [block][component] [1/s] there
  std::vector<std::vector<StencilStep<D>>> step_;        // [block][cell of layer 0]
};

}  // namespace littoral::fv
