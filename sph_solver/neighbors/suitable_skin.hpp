#pragma once

#include <algorithm>
#include <cmath>

namespace littoral::sph {

/// Skin of the lists [m] at which lists and pairs together cost least: lists that live n steps of `moved` [m]
/// each need a skin of 2 n moved, which makes pairs more by D skin / R. At least one step, if `most` [m]
/// allows it.
template <int D>
double suitable_skin(double kernel_radius, double moved, double most) {
  constexpr double k_lists_over_pairs =
      0.15;                         // time to make lists over that of a step's pair loops, measured
  constexpr double k_margin = 1.1;  // particles get faster meanwhile
  constexpr double k_least = 0.02;  // [R] where nothing moves yet
  const double least = std::min(most, k_least * kernel_radius);
  if (!(moved > 0.0)) return least;
  const double steps = std::sqrt(k_lists_over_pairs * kernel_radius / (2.0 * D * moved));
  return std::clamp(2.0 * k_margin * std::max(1.0, std::floor(steps)) * moved, least, most);
}

}  // namespace littoral::sph
