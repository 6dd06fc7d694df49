#pragma once

#include <array>
#include <cstddef>

#include "grid/block.hpp"

namespace littoral::fv {

/// Centre of a cell [m].
template <int D, class Index>
std::array<double, D> centre(const Block<D>& block, Index c) {
  std::array<double, D> x;
  for (std::size_t k = 0; k < D; ++k) x[k] = block.centre[k][static_cast<std::size_t>(c)];
  return x;
}

/// From the centre of one cell to that of another [m].
template <int D, class Index>
std::array<double, D> between(const Block<D>& block, Index from, Index to) {
  std::array<double, D> r;
  for (std::size_t k = 0; k < D; ++k)
    r[k] = block.centre[k][static_cast<std::size_t>(to)] - block.centre[k][static_cast<std::size_t>(from)];
  return r;
}

}  // namespace littoral::fv
