#pragma once

#include <cmath>

namespace littoral::sph {

constexpr double k_pi = 3.14159265358979323846;
constexpr double k_least_distance = 1e-9;  // of R; keeps 1/r finite for coincident particles

/// Wendland C2 on the compact radius R (S1):  W = A (1-s)^4 (1+4s) / R^D,  s = r/R <= 1.
template <int D>
struct Kernel {
  static_assert(D == 2 || D == 3);
  static constexpr double k_norm = D == 2 ? 7.0 / k_pi : 21.0 / (2.0 * k_pi);  // A

  double R;          // compact radius [m]
  double inv_R;      // [1/m]
  double amplitude;  // A / R^D [1/m^D]
  double slope;      // -20 A / R^(D+2) [1/m^(D+2)]

  explicit Kernel(double radius)
      : R(radius),
        inv_R(1.0 / radius),
        amplitude(k_norm / (D == 2 ? radius * radius : radius * radius * radius)),
        slope(-20.0 * amplitude / (radius * radius)) {}

  /// W(r) [1/m^D]
  double value(double r) const {
    const double s = r * inv_R;
    const double q = s < 1.0 ? 1.0 - s : 0.0;
    return amplitude * q * q * q * q * (1.0 + 4.0 * s);
  }

  /// F(r) = W'(r)/r [1/m^(D+2)], so that grad_i W_ij = F (x_i - x_j). Finite at r = 0, never positive.
  double slope_over_r(double r) const {
    const double s = r * inv_R;
    const double q = s < 1.0 ? 1.0 - s : 0.0;
    return slope * q * q * q;
  }
};

}  // namespace littoral::sph
