#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "bodies/body.hpp"
#include "bodies/dummies.hpp"
#include "bodies/wall_fluxes.hpp"
#include "bodies/wall_list.hpp"
#include "bodies/wall_sensors.hpp"
#include "bodies/wall_support.hpp"

namespace littoral::sph {

/// Force and moment of the water on a body; moment about its origin. 2-D: per metre, moment about y.
struct BodyLoad {
  Vector3 pressure{}, viscous{};  // [N] without that of the pressure level (p0 with a free surface)
  Vector3 pressure_moment{}, viscous_moment{};  // [N m]
};

/// The bodies of a scene as the step of the particles sees them. A scene without bodies has none of this.
/// Every rank holds all bodies and dummies; rows, rates and loads concern the particles it owns.
template <int D>
class Walls {
 public:
  Walls(std::vector<Body> bodies, const Numerics<D>& numerics, const DomainBox<D>& box,
        const Lattice<D>& lattice);

  /// Bodies and dummies to where they are at time t. throws StabilityError: a body faster than sound
  void move_to(double t);
  /// True if a body has moved by more than half the skin since build().
  bool outdated() const;
  /// way [m]: that no particle goes beyond while the particles' lists live
  void build(const Particles<D>& particles, double way);
  /// Particles on different sides of a sheet are no neighbours. comm: local
  void part(const Particles<D>& particles, NeighborList<D>& neighbors) const {
    if (!sheets_.none()) sheets_.part(bodies_, box_, particles, neighbors);
  }
  bool any_sheet() const { return !sheets_.none(); }
  void forget() { built_ = false; }

  /// Particles that in this step, begun at `start`, entered a body or went through a sheet by less than
  /// `tolerance` go back to their mirror image about its surface, velocity included; the body gets their
  /// momentum, among the loads of the step. Returns their number. pre: nobody was added, removed or sorted
  /// since build()
  /// throws StabilityError naming a particle that is deeper inside, and the body
  std::size_t keep_out(Particles<D>& particles, const std::array<std::vector<double>, D>& start,
                       double tolerance, double time);

  /// What the terms of a stage at time t need: the mass force of each row, and the dummies' states where they
  /// have some. comm: one sum over `others` with extrapolated wall states, else local
  void begin_stage(const Particles<D>& particles, double t, OtherRanks<D>* others);
  /// What walls know of the gradients of this stage (S13).
  const KnownSlopes<D>& known_slopes(const Particles<D>& particles);
  /// To be filled where pairs have gradients: those of the list's rows.
  Gradients<D>& gradients() { return gradients_; }
  /// Terms of a stage (S12), (S14).
  /// level: of the pressure, taken off [Pa], as in the pairs of particles
  void add_rates(const Particles<D>& particles, double level, Rate<D>& rate);

  /// For detection and shifting.
  void find_support(const Particles<D>& particles, const NeighborList<D>& neighbors);
  const WallSupport<D>& support() const { return support_; }

  /// Mean loads of a step of length dt: each stage adds its share, so that they are what the particles lost.
  void begin_step(double dt);
  void add_stage_loads(const Particles<D>& particles, double weight);
  /// Of the last step, from the owned particles.
  const std::vector<BodyLoad>& loads() const { return loads_; }

  /// Discs of walls whose force is wanted from now on. throws ConfigError: a disc in no wall that stays
  void watch(const std::vector<WallDisc>& discs, const DomainBox<D>& box) {
    sensors_ = WallSensors<D>(discs, bodies_, dummies_, box, numerics_.spacing, numerics_.kernel_radius);
  }
  /// Their mean pressures above the level, of the last step and from the owned particles [Pa].
  const std::vector<double>& sensed() const { return sensors_.mean(); }
  double pressure_level() const { return level_; }  ///< of the last stage [Pa]

  const std::vector<Body>& bodies() const { return bodies_; }
  const Dummies<D>& dummies() const { return dummies_; }
  const WallList<D>& list() const { return list_; }
  double coverage(const std::array<double, D>& x) const;     ///< sum_w V_w W at a point: the bodies' share
  bool inside(const std::array<double, D>& x) const;         ///< a body, or on a sheet
  const Body* holder(const std::array<double, D>& x) const;  ///< that body; null: none
  /// A sheet stands between two points.
  bool between(const std::array<double, D>& x, const std::array<double, D>& y) const {
    return sheets_.between(bodies_, box_, x, y);
  }

 private:
  Numerics<D> numerics_;
  DomainBox<D> box_;
  std::vector<Body> bodies_;
  std::vector<char> sticks_;
  bool any_moves_ = false, any_sticks_ = false;
  double time_ = std::numeric_limits<double>::quiet_NaN();  // [s] for which bodies and dummies stand
  double most_reach_;                                       // of the lists [m]
  Sheets<D> sheets_;
  Dummies<D> dummies_;
  WallList<D> list_;
  WallSupport<D> support_;
  DummyStates<D> states_;
  RowAccelerations<D> mass_force_;
  KnownSlopes<D> known_;
  Gradients<D> gradients_;
  RowForces<D> pressure_, friction_;  // of the last stage
  std::vector<BodyLoad> loads_;
  double dt_ = 1.0;  // of the step that the loads belong to [s]
  WallSensors<D> sensors_;
  double level_ = 0.0;                         // of the pressure [Pa]
  std::vector<BodyState> at_build_, at_step_;  // the bodies' states then
  bool built_ = false;
};

extern template class Walls<2>;
extern template class Walls<3>;

}  // namespace littoral::sph
