#pragma once

#include <vector>

#include "dual_time/stepper.hpp"
#include "littoral/coupler/fields.hpp"
#include "littoral/support/scene.hpp"

namespace littoral::fv {

/// The cells offered to the particles: per block of this rank one patch of all cells and one layer of ghosts.
/// A cell is usable where it holds a state (computed, forced or fringe), a ghost where the cell does that it
/// stands for, or else continues.
template <int D>
class DonorOffer {
 public:
  /// comm neighbours
  DonorOffer(const std::vector<Block<D>>& blocks, const Exchange<D>& exchange);
  coupler::DonorGeometry& geometry() { return geometry_; }
  const coupler::DonorGeometry& geometry() const { return geometry_; }

  /// p, u of the stepper's state into the value fields; with a free surface also phi, and the air beside it
  /// continues the water (continue_into_air).
  void put_state(const Stepper<D>& stepper, coupler::DonorValues& values) const;
  /// rates() of all blocks into the rate fields; of phi its last change. pre put_state
  void put_rates(const Stepper<D>& stepper, coupler::DonorValues& values) const;
  /// Rates that carry `values` to `end` (an offer's fields at t_end), linearly over dt.
  static void put_secant(const coupler::DonorValues& end, double dt, coupler::DonorValues& values);

 private:
  std::vector<std::vector<std::size_t>> cells_;  // of each block: offsets in the patch's order
  std::vector<Field> usable_;                    // 0 in blanked cells and ghosts that stand for them
  coupler::DonorGeometry geometry_;
};

/// Time derivative at the stepper's time of all cells of all blocks that hold a state, ghosts included.
/// Imposed cells: from their own history; before there is one, from the nearest cells that have a rate. comm
/// collective
template <int D>
std::vector<State<D>> rates(const Stepper<D>& stepper);

/// The driven and blending layers outside every open face of the region must find donors: checked at points
/// on a lattice over their outer faces. geometry: of this rank's blocks. comm collective
/// throws ConfigError naming the region, the face and the point
template <int D>
void check_layers_covered(const coupler::DonorGeometry& geometry, const support::Scene& scene,
                          const Ranks& ranks = {});

}  // namespace littoral::fv
