#include "littoral/support/scene_warnings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace littoral::support {
namespace {

// Compressions go with (u/c)^2: 4% here, 1% at the ten times that weak compressibility asks for.
constexpr double k_least_ratio = 5.0;

std::string with_unit(double value, const char* unit) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.4g %s", value, unit);
  return text.data();
}

std::string speed_text(double speed) { return with_unit(speed, "m/s"); }

/// Highest initial speed of the water on a lattice of the domain [m/s]; a first look, not a bound.
double initial_speed(const Scene& s) {
  constexpr int k_points = 9;
  double highest = 0.0;
  const auto at = [&](std::size_t d, int i) {
    return s.domain.lower[d] + (i + 0.5) / k_points * (s.domain.upper[d] - s.domain.lower[d]);
  };
  for (int i = 0; i < k_points; ++i)
    for (int j = 0; j < (s.active(1) ? k_points : 1); ++j)
      for (int k = 0; k < k_points; ++k) {
        const double x = at(0, i), y = s.active(1) ? at(1, j) : 0.0, z = at(2, k);
        if (s.initial.surface && !((*s.initial.surface)(x, y, z, 0.0) < 0.0)) continue;
        const double speed =
            std::hypot(s.initial.u(x, y, z, 0.0), s.initial.v(x, y, z, 0.0), s.initial.w(x, y, z, 0.0));
        if (speed > highest) highest = speed;  // false for NaN, which has an error of its own
      }
  return highest;
}

/// sqrt(g H), H the domain's extent along gravity: of the fastest wave of gravity, and of free fall over H/2.
double wave_speed(const Scene& s) {
  double g_h = 0.0;
  for (std::size_t d = 0; d < 3; ++d)
    if (s.active(d)) g_h += std::abs(s.gravity[d]) * (s.domain.upper[d] - s.domain.lower[d]);
  return std::sqrt(g_h);
}

}  // namespace

std::vector<std::string> scene_warnings(const Scene& s) {
  std::vector<std::string> warnings;
  if (s.gravity[2] > 0.0)
    warnings.push_back("gravity points up, " + with_unit(s.gravity[2], "m/s^2") +
                       " along z; in a scene z is up, so that water falls with a negative one");
  const double c = s.fluid.sound_speed;
  const double u = std::max(s.reference_velocity, initial_speed(s));
  if (c < k_least_ratio * u)
    warnings.push_back("fluid.sound_speed is " + speed_text(c) + ", less than five times the flow's " +
                       speed_text(u) +
                       " (reference_velocity, or the highest initial velocity); weak compressibility asks "
                       "for ten times");
  else if (c < wave_speed(s))
    warnings.push_back("fluid.sound_speed is " + speed_text(c) +
                       ", less than sqrt(g H) = " + speed_text(wave_speed(s)) +
                       " with the domain's extent along gravity: its waves outrun the sound; weak "
                       "compressibility asks for ten times");
  const coupler::WindowPolicy& window = s.coupling.window;
  if (s.coupling.kind != Scene::CouplingKind::none && !window.dt && window.substeps > k_too_many_substeps)
    warnings.push_back("coupling.substeps is " + std::to_string(window.substeps) + "; up to " +
                       std::to_string(k_measured_substeps) + " were compared with M = 1");
  return warnings;
}

}  // namespace littoral::support
