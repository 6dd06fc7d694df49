#pragma once

#include <array>
#include <cstddef>

#include "littoral/coupler/types.hpp"

namespace littoral::sph {

template <int D>
using Point = std::array<double, D>;

/// Component of a Vec3 that belongs to direction d of the solver: (x, z) in 2-D, (x, y, z) in 3-D.
template <int D>
constexpr std::size_t space_axis(std::size_t d) {
  return D == 2 && d == 1 ? 2 : d;
}

template <int D>
coupler::Vec3 to_vec3(const Point<D>& x) {
  coupler::Vec3 v{};
  for (std::size_t d = 0; d < D; ++d) v[space_axis<D>(d)] = x[d];
  return v;
}

template <int D>
Point<D> from_vec3(const coupler::Vec3& v) {
  Point<D> x{};
  for (std::size_t d = 0; d < D; ++d) x[d] = v[space_axis<D>(d)];
  return x;
}

/// Position of particle i out of component columns.
template <int D, class Columns>
Point<D> at(const Columns& columns, std::size_t i) {
  Point<D> x{};
  for (std::size_t d = 0; d < D; ++d) x[d] = columns[d][i];
  return x;
}

}  // namespace littoral::sph
