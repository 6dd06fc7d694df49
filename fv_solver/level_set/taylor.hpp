#pragma once

#include <array>

#include "grid/block.hpp"
#include "grid/small_matrix.hpp"

namespace littoral::fv {

/// Second-order Taylor polynomial of a field around a cell's centre, in space:
///   f(r) = value + gradient . r + 1/2 r.hessian r,  r from the cell's centre.
/// By central differences over the 3^D cells around, turned into space by those of the centres: exact for
/// quadratic fields on cells that are parallelepipeds, third order on smooth grids.
template <int D>
struct Taylor {
  double value = 0.0;
  SpaceVector<D> gradient{};
  SpaceMatrix<D> hessian{};

  double at(const SpaceVector<D>& r) const {
    return value + dot(gradient, r) + 0.5 * dot(r, times(hessian, r));
  }
  SpaceVector<D> gradient_at(const SpaceVector<D>& r) const {
    SpaceVector<D> g = times(hessian, r);
    for (std::size_t k = 0; k < D; ++k) g[k] += gradient[k];
    return g;
  }
  /// The same polynomial, r measured from a centre at `by`.
  Taylor moved(const SpaceVector<D>& by) const { return {at(by), gradient_at(by), hessian}; }
};

/// Central differences of an array around cell c in index space.
template <int D>
struct IndexDifferences {
  SpaceVector<D> first;
  SpaceMatrix<D> second;

  IndexDifferences(const Extent<D>& e, const double* f, std::ptrdiff_t c) {
    for (std::size_t d = 0; d < D; ++d) {
      const std::ptrdiff_t s = e.stride[d];
      first[d] = 0.5 * (f[c + s] - f[c - s]);
      second[d][d] = f[c + s] - 2.0 * f[c] + f[c - s];
      for (std::size_t o = 0; o < d; ++o) {
        const std::ptrdiff_t t = e.stride[o];
        second[d][o] = second[o][d] = 0.25 * (f[c + s + t] - f[c + s - t] - f[c - s + t] + f[c - s - t]);
      }
    }
  }
};

/// Derivatives of the map from index space to space around cell c, and its inverse.
template <int D>
struct LocalMap {
  std::array<SpaceMatrix<D>, D> second;  // [component] x_ij
  SpaceMatrix<D> to_space;               // [component][direction] dx/dxi
  SpaceMatrix<D> to_index;               // [direction][component] dxi/dx

  LocalMap(const Block<D>& block, std::ptrdiff_t c) {
    for (std::size_t k = 0; k < D; ++k) {
      const IndexDifferences<D> x(block.extent, block.centre[k].data(), c);
      to_space[k] = x.first;
      second[k] = x.second;
    }
    to_index = inverse<D>(to_space);
  }
  /// Index coordinates from the centre of c of the place r [m] from it: two Newton steps.
  SpaceVector<D> index_of(const SpaceVector<D>& r) const {
    SpaceVector<D> xi = times(to_index, r);
    for (int step = 0; step < 2; ++step) {
      SpaceVector<D> miss = r;
      for (std::size_t k = 0; k < D; ++k)
        miss[k] -= dot(to_space[k], xi) + 0.5 * dot(xi, times(second[k], xi));
      const SpaceVector<D> change = times(to_index, miss);
      for (std::size_t d = 0; d < D; ++d) xi[d] += change[d];
    }
    return xi;
  }
};

/// pre c and the cells around it, corners included, hold values
template <int D>
Taylor<D> taylor(const Block<D>& block, const Field& f, std::ptrdiff_t c) {
  const LocalMap<D> map(block, c);
  const IndexDifferences<D> of(block.extent, f.data(), c);
  Taylor<D> t;
  t.value = f[static_cast<std::size_t>(c)];
  for (std::size_t d = 0; d < D; ++d)
    for (std::size_t k = 0; k < D; ++k) t.gradient[k] += map.to_index[d][k] * of.first[d];
  SpaceMatrix<D> curved = of.second;  // without what the grid's own curvature contributes
  for (std::size_t i = 0; i < D; ++i)
    for (std::size_t j = 0; j < D; ++j)
      for (std::size_t k = 0; k < D; ++k) curved[i][j] -= t.gradient[k] * map.second[k][i][j];
  for (std::size_t k = 0; k < D; ++k)
    for (std::size_t l = 0; l < D; ++l)
      for (std::size_t i = 0; i < D; ++i)
        for (std::size_t j = 0; j < D; ++j)
          t.hessian[k][l] += map.to_index[i][k] * curved[i][j] * map.to_index[j][l];
  return t;
}

}  // namespace littoral::fv
