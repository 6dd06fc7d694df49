#pragma once

#include <algorithm>
#include <vector>

#include "grid/block.hpp"
#include "grid/metrics.hpp"

namespace littoral::fv {

/// Values imposed on cells of one block (fringe cells, or ghosts behind a fringe window).
template <int D>
struct Imposed {
  std::vector<std::size_t> cell;  // offsets
  Field p;                        // [Pa] (cell.size())
  VectorField<D> u;               // [m/s]
  Field phi;                      // [m] level set; empty: no free surface, or none of it imposed
};

/// How far from the surface a distance given from outside is taken for one, in lengths of a cell's longest
/// edge: the cells at the surface, whose values define it. Beyond, only its sign counts.
constexpr double k_given_reach = 1.5;

/// Largest of an inner cell's thicknesses [m].
template <int D>
double longest_edge(const Block<D>& block, std::size_t c) {
  double longest = 0.0;
  for (std::size_t d = 0; d < D; ++d) longest = std::max(longest, thickness(block, d, c));
  return longest;
}

}  // namespace littoral::fv
