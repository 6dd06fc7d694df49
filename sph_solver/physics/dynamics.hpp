#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <variant>
#include <vector>

#include "bodies/walls.hpp"
#include "boundary/domain_box.hpp"
#include "boundary/ghosts.hpp"
#include "neighbors/neighbor_list.hpp"
#include "pairs/pair_rows.hpp"
#include "particles/particles.hpp"
#include "physics/gradients.hpp"
#include "physics/numerics.hpp"
#include "physics/phase_seconds.hpp"
#include "physics/rate.hpp"
#include "physics/shifting.hpp"
#include "physics/step_hooks.hpp"
#include "physics/surface.hpp"
#include "physics/term.hpp"

namespace littoral::sph {

/// Work done so far, for the rates in a run's summary.
struct WorkCount {
  std::int64_t steps = 0;
  std::int64_t particle_steps = 0;
  std::int64_t pairs = 0;  // directed pairs of lists seen by the flux loop
  std::int64_t list_builds = 0;
  std::int64_t mirrored_back = 0;  // particles that had crossed a symmetry plane by less than half a spacing
  std::int64_t kept_out = 0;       // particles that had entered a body by less than half a spacing
};

/// Advances the particles by Runge-Kutta steps of (x, u, V), classical ones unless numerics say otherwise.
/// Holds what a step needs besides the particles.
template <int D>
class Dynamics {
 public:
  /// others: the program's other ranks, which then make every step together; null: there are none
  /// walls: null where the scene has no bodies
  Dynamics(const Numerics<D>& numerics, const DomainBox<D>& box, OtherRanks<D>* others = nullptr,
           std::unique_ptr<Walls<D>> walls = nullptr);

  /// Largest stable step for the particles as they are (S11): (16), and a limit from the accelerations of the
  /// last right-hand side. The same on all ranks
  double stable_time_step() const;

  /// One step from t to t + dt. hooks may be null.
  /// throws StabilityError naming a particle whose state is not finite, whose volume is not positive, or that
  /// is lost
  void step(Particles<D>& particles, double t, double dt, StepHooks<D>* hooks);

  /// Makes copies and lists belong to the particles as they stand (sorting them if lists are made anew), so
  /// that points can be sampled and the surface is known. dt: of the step that comes next, for which they
  /// hold as well; 0: none is meant. step() does this itself
  void prepare(Particles<D>& particles, double t, StepHooks<D>* hooks, double dt = 0.0);

  /// The particles were changed from outside (put back to an earlier state, say): lists and copies are made
  /// anew.
  void forget_lists() {
    neighbors_.forget();
    surface_current_ = false;
    if (walls_) walls_->forget();
  }

  /// Pressure taken off in the pair loops from now on [Pa]. With a free surface that of the surface, p0, from
  /// the beginning. For flows without one any constant is right, since only differences of pressure
  /// accelerate them, but discretely 2 V_i p sum_j V_j grad W_ij vanishes on regular arrangements only: the
  /// nearer to p, the smaller. Without a call each stage takes the particles' own.
  void set_pressure_level(double level) {
    level_follows_ = false;
    take_off(level);
  }

  /// du/dt and dV/dt of the particles as they stand, at time t; copies refreshed. pre: prepare() since
  /// particles changed
  void right_hand_side(Particles<D>& particles, double t);

  /// What stable_time_step() remembers of the last right-hand side [m/s^2]; part of a checkpoint.
  double most_acceleration() const { return most_acceleration_; }
  void set_most_acceleration(double acceleration) { most_acceleration_ = acceleration; }

  const Rate<D>& rate() const { return rate_; }
  const NeighborList<D>& neighbors() const { return neighbors_; }
  const Ghosts<D>& ghosts() const { return ghosts_; }
  Ghosts<D>& ghosts() { return ghosts_; }
  const SurfaceDetection<D>& surface() const { return surface_; }
  const Walls<D>* walls() const { return walls_.get(); }  ///< null: no bodies
  const Numerics<D>& numerics() const { return numerics_; }
  const PhaseSeconds& seconds() const { return seconds_; }
  const WorkCount& work() const { return work_; }
  PhaseSeconds& seconds() { return seconds_; }

 private:
  bool outdated(const Particles<D>& particles, double t, double ahead);
  void build_lists(Particles<D>& particles, double t);
  void look_ahead(const Particles<D>& particles, double dt, bool others_came);
  template <class Real>
  void pair_loops(const Particles<D>& particles, PairRows<D, Real>& rows);
  void update(Particles<D>& particles, double advance, double weight, bool last, double dt);
  void take_off(double level) {
    pressure_level_ = level;
    if (tension_ != nullptr) tension_->set_level(level);
  }
  void keep_volume(const Particles<D>& particles, bool in_open_faces);
  double middle_pressure(const Particles<D>& particles) const;
  void remember_start(const Particles<D>& particles);
  void check(const Particles<D>& particles, double t, double dt) const;

  Numerics<D> numerics_;
  OtherRanks<D>* others_;
  Ghosts<D> ghosts_;
  NeighborList<D> neighbors_;
  std::variant<PairRows<D, double>, PairRows<D, float>> rows_;  // for numerics_.precision
  Rate<D> rate_;
  SurfaceDetection<D> surface_;
  Shifting<D> shifting_;
  std::vector<std::unique_ptr<Term<D>>> terms_;
  std::unique_ptr<Walls<D>> walls_;
  TensionSwitch<D>* tension_ = nullptr;  // among terms_, if the scene asks for it
  bool surface_current_ = false;         // flags and the walls' support belong to the positions
  bool crowding_known_ = false;          // detection has left it for the shift of this step
  bool level_follows_;                   // the particles' own pressure: nobody else sets it
  bool closed_;                          // by periodic sides, symmetry planes and bodies that stay
  bool may_be_open_water_;               // no surface, no body: with a level from the partner it is
  double pressure_level_;                // [Pa] taken off in the pair loops
  double most_acceleration_ = 0.0;       // [m/s^2] of the last right-hand side, driven particles apart

  // Runge-Kutta: state at the start of the step and sum of weighted slopes (n_owned)
  std::array<std::vector<double>, D> x_start_, u_start_, x_sum_, u_sum_;
  std::vector<double> V_start_, V_sum_;

  PhaseSeconds seconds_;
  WorkCount work_;
};

extern template class Dynamics<2>;
extern template class Dynamics<3>;

}  // namespace littoral::sph
