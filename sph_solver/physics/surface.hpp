#pragma once

#include <array>
#include <vector>

#include "bodies/wall_support.hpp"
#include "boundary/ghosts.hpp"
#include "neighbors/neighbor_list.hpp"
#include "particles/particles.hpp"
#include "physics/symmetric_matrix.hpp"

namespace littoral::sph {

/// Finds the particles on the free surface (S9). lambda, the smallest eigenvalue of the renormalisation
/// matrix B, is about 1 inside, 1/2 on a plane surface row, less in corners. Below k_surface_below a particle
/// is on the surface, above k_interior_above it is not; in between it is, unless a neighbour stands in the
/// cone around its normal (Marrone et al. 2010).
template <int D>
class SurfaceDetection {
 public:
  static constexpr double k_surface_below = 0.20;
  static constexpr double k_interior_above = 0.75;

  /// out: particles.surface (surface or none) and the unit normal, out of the water, of each surface
  /// particle; on request particles.shift: sum_j V_j grad W_ij, which Shifting wants as well.
  /// walls: null where the scene has no bodies.
  void detect(Particles<D>& particles, const NeighborList<D>& neighbors, const Ghosts<D>& ghosts,
              const WallSupport<D>* walls = nullptr, bool with_crowding = false);
  /// After the flags have perhaps been corrected: marks particles within the kernel radius of a surface
  /// particle as near, gives them the normal of the closest one, and finds their distance.
  void mark_near(Particles<D>& particles, const NeighborList<D>& neighbors, const Ghosts<D>& ghosts);

  /// Distance to the closest surface particle in kernel radii; 0 on the surface, 1 further away (n_owned).
  const std::vector<double>& distance() const { return distance_; }
  const std::vector<double>& eigenvalue() const { return lambda_; }

 private:
  std::vector<double> lambda_;  // (n_owned + n_ghost)
  std::vector<double> distance_;
};

extern template class SurfaceDetection<2>;
extern template class SurfaceDetection<3>;

}  // namespace littoral::sph
