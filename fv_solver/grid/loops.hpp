#pragma once

#include <array>
#include <cstddef>

namespace littoral::fv {

/// body(index) for every index in [lower, upper), direction 0 fastest. For set-up and surfaces; the hot loops
/// run over rows with plain pointers.
template <int D, class Body>
void for_each_index(const std::array<int, D>& lower, const std::array<int, D>& upper, Body&& body) {
  for (std::size_t d = 0; d < D; ++d)
    if (upper[d] <= lower[d]) return;
  std::array<int, D> index = lower;
  while (true) {
    body(index);
    std::size_t d = 0;
    while (d < D && ++index[d] == upper[d]) {
      index[d] = lower[d];
      ++d;
    }
    if (d == D) return;
  }
}

/// body(step, offset) for the 3^D cells around the one at offset c, itself among them; stride: of the array.
template <int D, class Body>
void for_each_around(const std::array<std::ptrdiff_t, D>& stride, std::ptrdiff_t c, Body&& body) {
  std::array<int, D> lower, upper;
  lower.fill(-1);
  upper.fill(2);
  for_each_index<D>(lower, upper, [&](const std::array<int, D>& step) {
    std::ptrdiff_t other = c;
    for (std::size_t d = 0; d < D; ++d) other += step[d] * stride[d];
    body(step, other);
  });
}

}  // namespace littoral::fv
