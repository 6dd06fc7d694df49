#pragma once

#include <array>
#include <cstddef>

#include "grid/between.hpp"
#include "grid/block.hpp"
#include "littoral/coupler/types.hpp"

namespace littoral::fv {

/// The plane of a 2-D grid is (x, z): component and direction k of the grid in space.
template <int D>
constexpr std::size_t axis_in_space(std::size_t k) {
  return D == 2 && k == 1 ? 2 : k;
}

/// A grid vector in space; y = 0 in 2-D.
template <int D>
coupler::Vec3 vector_in_space(const std::array<double, D>& v) {
  coupler::Vec3 x{};
  for (std::size_t k = 0; k < D; ++k) x[axis_in_space<D>(k)] = v[k];
  return x;
}

template <int D>
coupler::Vec3 centre_in_space(const Block<D>& block, std::ptrdiff_t c) {
  return vector_in_space<D>(centre(block, c));
}

}  // namespace littoral::fv
