#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "dual_time/stepper.hpp"
#include "io/state_file.hpp"
#include "littoral/coupler/window.hpp"

namespace littoral::fv {

/// With whom the solver marches: nobody, or the particle solver. Decides on windows and carries the state
/// over them; the solver's loop (Solver::run) is the same for both.
template <int D>
class Companion {
 public:
  virtual ~Companion() = default;

  /// Called once, before the first window: statuses of cells may be set here (region blanked or forced).
  virtual void begin(Stepper<D>& stepper) = 0;
  /// The next window, or no window any more. `mine.dt_stable` is the grid's own limit on the step.
  /// comm collective; may talk to the partner
  virtual std::optional<coupler::Agreement> agree(const coupler::Proposal& mine) = 0;
  /// Carries the state over the window: one step, or several tries of it (schedules).
  virtual StepReport advance(const coupler::Window& window, Stepper<D>& stepper) = 0;
  virtual void goodbye(const std::string& reason) = 0;
  /// Wall time spent waiting for the partner so far [s].
  virtual double waited() const { return 0.0; }
  /// [s] that a partner cost beyond waiting and the steps themselves: donors, messages, samples put to use.
  virtual double coupling_seconds() const { return 0.0; }
  virtual std::string description() const = 0;

  /// What a bitwise continuation needs of the companion; load after begin.
  /// comm collective
  virtual void save(StateWriter<D>&) const {}
  virtual void load(const support::CheckpointReader&) {}

  /// Where a companion says something: the solver's log.
  std::function<void(const std::string&)> tell = [](const std::string&) {};
  std::function<void(const std::string&)> warn = [](const std::string&) {};
};

/// Nobody: steps as long as the solver itself wants them, to the end time.
template <int D>
class Alone : public Companion<D> {
 public:
  /// start, start_window: where a continued run stands; max_windows counts from there
  Alone(double start, double end, long max_windows, std::int64_t start_window = 0)
      : start_window_(start_window), time_(start), end_(end), max_windows_(max_windows) {}
  void begin(Stepper<D>&) override {}
  std::optional<coupler::Agreement> agree(const coupler::Proposal& mine) override {
    if (mine.stop || !(time_ < end_) || (max_windows_ >= 0 && windows_ >= max_windows_)) return {};
    coupler::WindowPolicy policy;
    policy.dt = mine.dt_stable;
    coupler::Proposal nobody;
    nobody.dt_stable = std::numeric_limits<double>::infinity();
    return coupler::agree(nobody, mine, policy, start_window_ + windows_, time_, end_);
  }
  StepReport advance(const coupler::Window& window, Stepper<D>& stepper) override {
    ++windows_;
    time_ = window.t_end;
    return stepper.advance(window.dt());
  }
  void goodbye(const std::string&) override {}
  std::string description() const override { return "alone"; }

 private:
  std::int64_t start_window_;
  std::int64_t windows_ = 0;  // since the start of this run
  double time_, end_;         // [s]
  long max_windows_;
};

}  // namespace littoral::fv
