#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "boundary/window.hpp"
#include "littoral/coupler/types.hpp"

namespace littoral::fv {

/// A zone that damps the flow towards a given velocity (F12): the momentum rows get V sigma rho0 (u - u*),
/// implicit; the mass row is left alone, so that no water is made.
/// With a surface given, sigma (phi - phi*) is added to the equation of phi, so that waves end in the zone.
/// sigma = rate s^power, s from 0 to 1 between two positions along an axis, or of the distance from a centre,
/// and 1 beyond.
template <int D>
struct Sponge {
  int axis = 0;                        // 0, 1, 2: x, y, z; 3: distance from `centre`
  coupler::Vec3 centre{};              // [m]
  double from = 0, to = 1;             // [m] where sigma begins and where it is `rate`
  double rate = 0;                     // [1/s]
  double power = 2;                    // [-]
  std::array<Prescribed, D> velocity;  // [m/s] u*; empty: 0
  Prescribed surface;                  // < 0 in water: phi is damped towards it, too; empty: it is not

  /// x in space; in 2-D y is 0 on both sides. pure
  double strength(const coupler::Vec3& x) const {
    double position = 0.0;
    if (axis < 3) {
      position = x[static_cast<std::size_t>(axis)];
    } else {
      for (std::size_t k = 0; k < 3; ++k) position += (x[k] - centre[k]) * (x[k] - centre[k]);
      position = std::sqrt(position);
    }
    const double s = (position - from) / (to - from);
    return s <= 0.0 ? 0.0 : rate * std::pow(std::min(s, 1.0), power);
  }
};

}  // namespace littoral::fv
