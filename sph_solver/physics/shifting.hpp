#pragma once

#include "neighbors/neighbor_list.hpp"
#include "particles/particles.hpp"
#include "physics/surface.hpp"

namespace littoral::sph {

/// Particle shifting (S10), Di Mascio et al. 2021, eqs. (13)-(15):
///   n_i = R sum_j V_j grad W_ij,   shift_i = -U n_i, its length at most U/4.
/// The paper's particles are all alike and have dx^D for V_j. Those of a stretched row are not: spread to
/// equal distances, they would leave sum_j V_j grad W_ij, on which the pressure acts as a force (S7). The
/// paper caps with |u_i|/4, which vanishes at rest and depends on the frame; here U is the scene's reference
/// velocity in both places. Within one kernel radius of the surface only the tangential part remains, fading
/// to nothing on the surface itself, so that shifting neither moves the surface nor creates volume.
template <int D>
class Shifting {
 public:
  explicit Shifting(double reference_velocity) : velocity_(reference_velocity) {}
  /// out: particles.shift. surface: null where the scene has no free surface; walls: null where it has no
  /// bodies; crowding_known: sum_j V_j grad W_ij stands in particles.shift already.
  void compute(Particles<D>& particles, const NeighborList<D>& neighbors, const SurfaceDetection<D>* surface,
               const WallSupport<D>* walls = nullptr, bool crowding_known = false) const;

 private:
  void restrict_to_surface(Particles<D>& particles, const SurfaceDetection<D>& surface) const;

  double velocity_;  // U [m/s]
};

extern template class Shifting<2>;
extern template class Shifting<3>;

}  // namespace littoral::sph
