#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace littoral::sph {

/// Symmetric D x D matrix, upper triangle by rows: (xx, xz, zz) or (xx, xy, xz, yy, yz, zz).
template <int D>
struct SymmetricMatrix {
  std::array<double, D*(D + 1) / 2> a{};

  double trace() const { return D == 2 ? a[0] + a[2] : a[0] + a[3] + a[5]; }

  double determinant() const {
    if constexpr (D == 2)
      return a[0] * a[2] - a[1] * a[1];
    else
      return a[0] * (a[3] * a[5] - a[4] * a[4]) - a[1] * (a[1] * a[5] - a[4] * a[2]) +
             a[2] * (a[1] * a[4] - a[3] * a[2]);
  }

  /// A bound from below of the smallest eigenvalue of a positive matrix: the others' product is at most the
  /// power of their mean.
  double least_eigenvalue_at_least() const {
    const double others = trace() / (D - 1);
    return others > 0.0 ? determinant() / (D == 2 ? others : others * others) : 0.0;
  }

  double smallest_eigenvalue() const {
    if constexpr (D == 2) {
      const double half = 0.5 * (a[0] + a[2]);
      return half - std::hypot(0.5 * (a[0] - a[2]), a[1]);
    } else {  // trigonometric solution of the characteristic cubic
      const double mean = trace() / 3.0;
      const double off = a[1] * a[1] + a[2] * a[2] + a[4] * a[4];
      const double bx = a[0] - mean, by = a[3] - mean, bz = a[5] - mean;
      const double scale = std::sqrt((bx * bx + by * by + bz * bz + 2.0 * off) / 6.0);
      if (!(scale > 1e-14 * std::abs(mean))) return mean;
      const SymmetricMatrix b{{bx / scale, a[1] / scale, a[2] / scale, by / scale, a[4] / scale, bz / scale}};
      const double angle = std::acos(std::clamp(0.5 * b.determinant(), -1.0, 1.0)) / 3.0;
      return mean + 2.0 * scale * std::cos(angle + 2.0943951023931953);  // 2 pi / 3: the smallest of three
    }
  }

  SymmetricMatrix inverse() const {
    const double w = 1.0 / determinant();
    if constexpr (D == 2)
      return {{a[2] * w, -a[1] * w, a[0] * w}};
    else
      return {{(a[3] * a[5] - a[4] * a[4]) * w, (a[2] * a[4] - a[1] * a[5]) * w,
               (a[1] * a[4] - a[2] * a[3]) * w, (a[0] * a[5] - a[2] * a[2]) * w,
               (a[1] * a[2] - a[0] * a[4]) * w, (a[0] * a[3] - a[1] * a[1]) * w}};
  }

  SymmetricMatrix operator+(const SymmetricMatrix& b) const {
    SymmetricMatrix sum = *this;
    for (std::size_t k = 0; k < a.size(); ++k) sum.a[k] += b.a[k];
    return sum;
  }

  std::array<double, D> operator*(const std::array<double, D>& v) const {
    if constexpr (D == 2)
      return {a[0] * v[0] + a[1] * v[1], a[1] * v[0] + a[2] * v[1]};
    else
      return {a[0] * v[0] + a[1] * v[1] + a[2] * v[2], a[1] * v[0] + a[3] * v[1] + a[4] * v[2],
              a[2] * v[0] + a[4] * v[1] + a[5] * v[2]};
  }
};

}  // namespace littoral::sph
