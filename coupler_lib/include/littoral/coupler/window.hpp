#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace littoral::coupler {

/// How the two solvers take turns in a window [t^n, t^n+1] (coupler_lib/README.md shows each as a sequence).
///   serial      SPH on donors extrapolated in time (24), then FV with the samples of t^n+1 (the paper)
///   predicted   FV first with extrapolated samples; SPH on donors towards that; FV again from t^n
///   iterated    the serial window `passes` times, later passes on donors towards FV's last result
///   concurrent  both at once on extrapolated data; then FV again, from its try, with the true samples
enum class Schedule : std::uint8_t { serial, predicted, iterated, concurrent };
const char* name(Schedule schedule);

struct SchedulePolicy {
  Schedule schedule = Schedule::predicted;
  int passes = 2;  // iterated only
  /// How often SPH runs through the window.
  int sph_passes() const { return schedule == Schedule::iterated ? passes : 1; }
};

/// How long a window is: `dt` given, then M is the smallest integer with dt/M <= the stable SPH step (25); or
/// `substeps` given, then dt = M times the stable SPH step.
struct WindowPolicy {
  std::optional<double> dt;  // [s]
  int substeps = 1;          // M where dt is absent
};

/// One coupling window.
struct Window {
  std::int64_t index = 0;
  double t_begin = 0.0;  // t^n [s]
  double t_end = 0.0;    // t^n+1 [s]
  int substeps = 1;      // M
  double dt() const { return t_end - t_begin; }
  double substep_dt() const { return (t_end - t_begin) / substeps; }
};

/// What one side brings to the agreement about the next window.
struct Proposal {
  double dt_stable = 0.0;  // SPH: its stable step (16); FV: its accuracy limit on dt_FV; infinity: none [s]
  bool write = false;
  bool checkpoint = false;
  bool stop = false;             // after this agreement: no further window
  bool region_changed = false;   // geometry and targets must be exchanged anew (a new epoch)
  bool wants_particles = false;  // FV asks for the Particles message of this window
  std::string reason;            // of the stop
};

/// What both sides then do; identical on all ranks of both programs.
struct Agreement {
  Window window;
  bool write = false;
  bool checkpoint = false;
  bool stop = false;
  bool region_changed = false;
  bool wants_particles = false;
  std::string reason;
};

/// The rule of agreement: flags by "either wants it"; length by the policy, cut so that the last window ends
/// at t_end without a sliver (the last two share the remainder). pure: both sides compute it and must find
/// the same. throws CouplingError if no positive, finite window results (says who proposed what)
Agreement agree(const Proposal& sph, const Proposal& fv, const WindowPolicy& policy, std::int64_t index,
                double time, double end_time);

}  // namespace littoral::coupler
