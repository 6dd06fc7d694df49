#include "littoral/coupler/window.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "littoral/error.hpp"

namespace littoral::coupler {

namespace {

// Times are sums of many windows: lengths closer than this (relative) are the same length.
constexpr double k_round_off = 1e-9;
// More substeps than this in one window mean that a stable step collapsed.
constexpr double k_max_substeps = 1e6;

[[noreturn]] void refuse(const Proposal& sph, const Proposal& fv, const WindowPolicy& policy,
                         std::int64_t index, double time, const std::string& what) {
  std::ostringstream text;
  text.precision(9);
  text << "no window " << index << " from t = " << time << " s: " << what
       << ". sph proposed dt = " << sph.dt_stable << " s, fv dt = " << fv.dt_stable << " s; policy ";
  if (policy.dt)
    text << "dt = " << *policy.dt << " s";
  else
    text << "substeps = " << policy.substeps;
  throw CouplingError(text.str());
}

std::string join_reasons(const Proposal& sph, const Proposal& fv) {
  const std::string s = sph.stop ? sph.reason : "", f = fv.stop ? fv.reason : "";
  if (s.empty() || s == f) return f;
  return f.empty() ? s : s + "; " + f;
}

}  // namespace

const char* name(Schedule schedule) {
  switch (schedule) {
    case Schedule::serial:
      return "serial";
    case Schedule::predicted:
      return "predicted";
    case Schedule::iterated:
      return "iterated";
    case Schedule::concurrent:
      return "concurrent";
  }
  return "unknown";
}

Agreement agree(const Proposal& sph, const Proposal& fv, const WindowPolicy& policy, std::int64_t index,
                double time, double end_time) {
  Agreement a;
  a.window = {index, time, time, 1};
  a.write = sph.write || fv.write;
  a.checkpoint = sph.checkpoint || fv.checkpoint;
  a.stop = sph.stop || fv.stop;
  a.region_changed = sph.region_changed || fv.region_changed;
  a.wants_particles = sph.wants_particles || fv.wants_particles;
  a.reason = join_reasons(sph, fv);
  if (a.stop) return a;

  const double remaining = end_time - time;
  if (remaining <= 0.0) {
    a.stop = true;
    a.reason = "end time reached";
    return a;
  }
  const auto check = [&](bool ok, const char* what) {
    if (!ok) refuse(sph, fv, policy, index, time, what);
  };
  check(sph.dt_stable > 0.0 && fv.dt_stable > 0.0, "a proposed step is not positive");  // NaN fails here too
  check(!policy.dt || *policy.dt > 0.0, "the prescribed step is not positive");
  check(policy.substeps >= 1, "fewer than one substep is prescribed");

  double dt = std::min(policy.dt ? *policy.dt : policy.substeps * sph.dt_stable, fv.dt_stable);
  check(!std::isnan(remaining), "the end time is not a number");
  if (remaining <= dt * (1.0 + k_round_off))
    dt = remaining;
  else if (remaining < 2.0 * dt)
    dt = 0.5 * remaining;
  check(std::isfinite(dt), "its length would be infinite");
  check(time + dt > time, "its length vanishes beside t");

  const double substeps = std::ceil(dt / sph.dt_stable * (1.0 - k_round_off));
  check(substeps <= k_max_substeps, "it would need more than a million substeps");
  a.window.substeps = std::max(1, static_cast<int>(substeps));
  a.window.t_end = dt == remaining ? end_time : time + dt;
  return a;
}

}  // namespace littoral::coupler
