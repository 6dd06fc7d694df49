#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace littoral::sph {

/// How far ahead lists look. Particles are taken to go on at their velocities for a while and to stray from
/// these paths a little.
struct Outlook {
  double ahead = 0.0;    // [s]
  double fastest = 0.0;  // [m/s] of all particles of all ranks
  double stray = 0.0;    // [m]

  double way() const { return ahead * fastest + stray; }  ///< [m] that nobody goes beyond meanwhile
};

/// What particles of all ranks do at most, and for how many steps lists can be of use.
struct MotionBounds {
  double speed = 0.0;         // [m/s]
  double shift = 0.0;         // [m/s] velocity that is added to theirs
  double acceleration = 0.0;  // [m/s^2]
  int steps = 1000;
};

/// The number n of steps dt [s] ahead at which a step's share of making lists, and the pairs beyond R that it
/// sees, cost least. Shift and acceleration make particles stray by n dt shift + (n dt)^2 acceleration / 2;
/// the straying lengthens rows, the whole way (`most` [m] or less) only the search for them: what
/// moves alike stays together.
template <int D>
Outlook suitable_outlook(double kernel_radius, double dt, const MotionBounds& motion, double most) {
  constexpr double k_lists_over_pairs =
      0.15;                         // time to make lists over that of a step's pair loops, measured
  constexpr double k_margin = 1.1;  // particles get faster meanwhile
  constexpr double k_least = 0.01;  // [R] strayed where nothing moves yet
  const auto volume = [&](double more) {
    double ratio = 1.0;
    for (int d = 0; d < D; ++d) ratio *= 1.0 + more / kernel_radius;
    return ratio;
  };
  Outlook best;
  double least = std::numeric_limits<double>::infinity();
  for (int n = 1; n <= motion.steps; ++n) {
    Outlook next{k_margin * n * dt, motion.speed, 0.0};
    next.stray = std::max(k_least * kernel_radius,
                          next.ahead * (motion.shift + 0.5 * next.ahead * motion.acceleration));
    if (n == 1 && !(next.way() <= most)) {  // not even a step
      next.stray = std::min(next.stray, 0.5 * most);
      next.ahead = std::min(next.ahead, (most - next.stray) / motion.speed);
    }
    const double cost = k_lists_over_pairs / n * volume(2.0 * next.way()) + volume(2.0 * next.stray);
    if (!(cost < least) || next.way() > most) break;
    least = cost;
    best = next;
  }
  return best;
}

}  // namespace littoral::sph
