#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace littoral::fv {

template <int D>
using SpaceVector = std::array<double, D>;
template <int D>
using SpaceMatrix = std::array<std::array<double, D>, D>;  // [row][column]

template <std::size_t D>
double dot(const std::array<double, D>& a, const std::array<double, D>& b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < D; ++k) sum += a[k] * b[k];
  return sum;
}
template <std::size_t D>
double length(const std::array<double, D>& a) {
  return std::sqrt(dot(a, a));
}
template <std::size_t D>
std::array<double, D> times(const std::array<std::array<double, D>, D>& m, const std::array<double, D>& v) {
  std::array<double, D> out{};
  for (std::size_t k = 0; k < D; ++k) out[k] = dot(m[k], v);
  return out;
}

/// Not finite where the matrix is singular. pure
template <int D>
SpaceMatrix<D> inverse(const SpaceMatrix<D>& a) {
  SpaceMatrix<D> b;
  if constexpr (D == 2) {
    const double det = a[0][0] * a[1][1] - a[0][1] * a[1][0];
    b = {{{a[1][1] / det, -a[0][1] / det}, {-a[1][0] / det, a[0][0] / det}}};
  } else {
    double det = 0.0;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) {
        const std::size_t i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
        b[j][i] = a[i1][j1] * a[i2][j2] - a[i1][j2] * a[i2][j1];  // cofactor
      }
    for (std::size_t j = 0; j < 3; ++j) det += a[0][j] * b[j][0];
    for (auto& row : b)
      for (double& value : row) value /= det;
  }
  return b;
}

}  // namespace littoral::fv
