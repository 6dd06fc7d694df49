#pragma once

#include <cmath>

#include "littoral/support/scene.hpp"

namespace littoral::support {

/// Whether what is written every `interval` (and was last at `last`) is due in a window that ends at `time`:
/// when that reaches the next multiple of the interval. Times of writing do not drift away from the
/// multiples, and a window that ends a little early counts for the multiple it is next to. interval 0: never.
/// pure; one rule, so that both programs propose the same
inline bool due(double last, double time, double interval) {
  if (!(interval > 0.0)) return false;
  constexpr double k_round_off = 1e-9;  // times are sums of steps
  return time >= interval * (std::round(last / interval) + 1.0 - k_round_off);
}

/// Where the coming window is expected to end, before it is agreed on: a coupled run's given window, else
/// `length`, the program's own guess.
inline double expected_end(const Scene& scene, double time, double length) {
  return time + (scene.has_region() ? scene.coupling.window.dt.value_or(length) : length);
}

}  // namespace littoral::support
