#pragma once

#include <memory>
#include <string>

#include "companion.hpp"
#include "config.hpp"
#include "dual_time/stepper.hpp"
#include "io/output.hpp"
#include "io/surface_warnings.hpp"
#include "littoral/support/log.hpp"
#include "littoral/support/summary.hpp"
#include "littoral/support/timers.hpp"

namespace littoral::fv {

/// The grid solver of one run.
template <int D>
class Solver {
 public:
  /// `out` is the folder of results of the whole job; this program writes to OUT/fv. `restart`: a checkpoint
  /// to continue from, or empty. comm collective, as all of this. throws ConfigError, IoError
  Solver(const FvConfig& config, const support::Scene& scene, const std::string& out,
         const std::string& restart, const Ranks& ranks = {});

  double start_time() const { return stepper_.time(); }
  std::int64_t start_window() const { return window_; }

  /// Windows until the companion wants no more.
  void run(Companion<D>& companion);
  /// One window: the state is carried to its end, what is due is written.
  void step(const coupler::Agreement& agreement, Companion<D>& companion);

  Stepper<D>& stepper() { return stepper_; }

 private:
  coupler::Proposal propose() const;
  double cells() const;  // of all ranks
  void report(const StepReport& report);
  void write_summary(const Companion<D>& companion, const std::string& reason);

  FvConfig config_;
  support::Scene scene_;
  Ranks ranks_;
  std::string folder_;   // OUT/fv
  std::string restart_;  // checkpoint to continue from, or empty
  bool restarted_;
  support::Log log_;
  support::Timers timers_;
  support::Timers::Phase solve_, write_;
  std::vector<std::string> grid_notes_;
  Stepper<D> stepper_;
  std::unique_ptr<Output<D>> output_;
  std::int64_t window_ = 0;
  double last_checkpoint_ = 0.0;  // [s]
  double begin_ = 0.0;            // [s] wall clock
  long cycles_ = 0, unconverged_ = 0, steps_ = 0;
  SurfaceWarnings surface_warnings_;
};

}  // namespace littoral::fv
