#pragma once

#include <array>
#include <cstddef>

#include "grid/block.hpp"

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

/// body(offset in a part of a block, offset in the whole) for each cell of the part, and its ghosts where
/// asked for. first: cell of the whole that is (0, ..., 0) in the part
template <int D, class Body>
void for_each_place(const Extent<D>& part, const Extent<D>& whole, const std::array<int, D>& first,
                    bool ghosts, Body&& body) {
  std::array<int, D> lower{}, upper = part.n;
  for (std::size_t d = 0; d < D && ghosts; ++d) {
    lower[d] -= k_ghost;
    upper[d] += k_ghost;
  }
  for_each_index<D>(lower, upper, [&](const std::array<int, D>& index) {
    std::array<int, D> there = index;
    for (std::size_t d = 0; d < D; ++d) there[d] += first[d];
    body(static_cast<std::size_t>(part.at(index)), static_cast<std::size_t>(whole.at(there)));
  });
}

}  // namespace littoral::fv
