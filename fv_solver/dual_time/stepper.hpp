#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "dual_time/step_solver.hpp"
#include "physics/sponge.hpp"

namespace littoral::fv {

/// p [Pa] and u at a place and time.
template <int D>
struct PointState {
  double p = 0.0;
  std::array<double, D> u{};
};
template <int D>
using FlowFunction = std::function<PointState<D>(const std::array<double, D>& x, double t)>;
/// Source per volume of the mass row [kg/(m^3 s)] and of the momentum rows [N/m^3].
template <int D>
struct Source {
  double mass = 0.0;
  std::array<double, D> momentum{};
};
template <int D>
using SourceFunction = std::function<Source<D>(const std::array<double, D>& x, double t)>;

/// Steps all blocks in time: BDF2, started by BDF1, each step solved by the inner solver.
/// Keeps the levels before the last step, so that it can be undone and repeated with other fringe values.
/// comm collective: initialise, advance, restore
template <int D>
class Stepper {
 public:
  /// blocks: this rank's own; exchange: with all others
  Stepper(std::vector<Block<D>>&& blocks, Exchange<D> exchange, const Equations<D>& equations,
          std::unique_ptr<StepSolver<D>> inner, const InnerTolerance& tolerance);
  /// All blocks are here.
  Stepper(std::vector<Block<D>> blocks, const Equations<D>& equations, std::unique_ptr<StepSolver<D>> inner,
          const InnerTolerance& tolerance, const OversetLinks<D>& overset = {});

  /// Sets the state everywhere from a formula, at time t; forgets older levels. throws StabilityError
  void initialise(const FlowFunction<D>& flow, double t);
  void set_source(SourceFunction<D> source) { source_ = std::move(source); }

  /// Lets the water end at a free surface, from a function < 0 in water, = 0 on the surface at time().
  /// pre initialise
  void set_surface(const Prescribed& surface, const LevelSetOptions& options = {});
  /// null in scenes without a free surface
  const FreeSurface<D>* surface() const { return surface_.get(); }
  FreeSurface<D>* surface() { return surface_.get(); }

  /// Zones that damp u, and phi, outside of the cells that a partner forces.
  void set_sponges(std::vector<Sponge<D>> sponges);

  /// One step from time() to time() + dt. Fringe cells get `imposed` (one entry a block; empty: as they are),
  /// the values at the new time. Starts from extrapolated u and p = p^n (extrapolating p too lets forces
  /// flip from step to step).
  /// throws StabilityError naming block, cell, place, time, dt where the state is no longer finite or the
  /// density no longer positive
  /// from_last_try: after restore(), starts from the state that it gave up instead.
  StepReport advance(double dt, const std::vector<Imposed<D>>& imposed = {}, bool from_last_try = false);
  /// Back to before the last advance. Once per advance.
  void restore();

  /// Time derivative of p and u at time(): the backward difference; before the first step from the field
  /// equations (p: 0 where c is infinite, since p then has no equation of its own).
  void time_derivative(std::size_t block, State<D>& rate) const;

  double time() const { return time_; }
  double last_dt() const { return dt_[0]; }
  long steps() const { return steps_; }
  std::vector<Block<D>>& blocks() { return blocks_; }
  const std::vector<Block<D>>& blocks() const { return blocks_; }
  const Exchange<D>& exchange() const { return exchange_; }
  /// Statuses have changed since the grid was made. comm collective, throws ConfigError
  void seek_donors() {
    exchange_.seek_donors(blocks_);
    if (surface_) surface_->statuses_changed(blocks_, exchange_, equations_, level_[0]);
  }
  const Equations<D>& equations() const { return equations_; }
  /// Current state, ghosts current.
  std::vector<State<D>>& state() { return level_[0]; }
  const std::vector<State<D>>& state() const { return level_[0]; }
  /// Forcing of (21) for the coming steps, one entry a block.
  std::vector<Forcing<D>>& forcing() { return forcing_; }
  InnerTolerance& tolerance() { return tolerance_; }
  void set_inner(std::unique_ptr<StepSolver<D>> inner) { inner_ = std::move(inner); }
  /// Where the time of all steps went.
  const StepPhases& phases() const { return phases_; }

  /// Everything that a bitwise continuation needs, besides blocks and equations.
  struct Memory {
    std::array<std::vector<State<D>>, 4> level;
    std::array<double, 4> dt{};
    int known = 0;
    long steps = 0;
    double time = 0.0;
    typename FreeSurface<D>::Memory surface{};  // empty without a free surface
  };
  Memory memory() const {
    Memory memory{level_, dt_, known_, steps_, time_};
    if (surface_) memory.surface = surface_->memory();
    return memory;
  }
  void recall(const Memory& memory);

 private:
  BackwardDifference scheme(double dt) const;
  void set_history(const BackwardDifference& scheme, double t);
  void aim_sponges(double t);
  void aim_surface_sponges(double t);
  bool damps_surface() const {
    return std::any_of(sponges_.begin(), sponges_.end(), [](const Sponge<D>& s) { return bool(s.surface); });
  }
  std::string size_of_step(double dt) const;
  void check(const std::string& advice) const;  // comm collective
  void check_own(const std::string& advice) const;
  std::string fastest_before() const;

  std::vector<Block<D>> blocks_;
  Exchange<D> exchange_;
  Equations<D> equations_;
  std::unique_ptr<StepSolver<D>> inner_;
  InnerTolerance tolerance_;
  SourceFunction<D> source_;
  std::vector<Sponge<D>> sponges_;
  std::vector<Field> damping_;  // [block] [1/s] strength of the sponges; empty: none there
  std::vector<Forcing<D>> forcing_;
  std::unique_ptr<FreeSurface<D>> surface_;
  StepPhases phases_;
  std::vector<History<D>> history_;
  // q^n, q^n-1, q^n-2, and one more so that a restored step still knows its derivative
  std::array<std::vector<State<D>>, 4> level_;
  std::array<double, 4> dt_{};  // [s] dt_[k] = t^n-k - t^n-k-1
  int known_ = 0;               // levels that hold a state
  long steps_ = 0;
  double time_ = 0.0;  // [s] t^n
  double time_before_ = 0.0;
};

}  // namespace littoral::fv
