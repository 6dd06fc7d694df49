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

}  // namespace littoral::fv
