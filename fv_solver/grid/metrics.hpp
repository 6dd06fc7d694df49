#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <string>

#include "grid/block.hpp"

namespace littoral::fv {

/// Sets node_extent, ghost nodes, centres, volumes, face area vectors and statuses (computed inside, fringe
/// in the ghosts) from block.name, extent, periodic and the inner nodes. Ghost nodes are the mirror image of
/// the inner ones through the face's node, or, where periodic, the image of the opposite side.
/// Cells are closed: the area vectors of each sum to zero to round-off.
/// throws ConfigError naming block and cell where a volume is not positive
template <int D>
void set_metrics(Block<D>& block);

/// Recomputes `solved` from the statuses. Call after any change of status.
template <int D>
void set_solved_mask(Block<D>& block);

/// Measure of the lower face of a cell in direction d [m^(D-1)].
template <int D>
double face_measure(const Block<D>& block, std::size_t d, std::size_t c) {
  double s2 = 0.0;
  for (std::size_t k = 0; k < D; ++k) s2 += block.area[d][k][c] * block.area[d][k][c];
  return std::sqrt(s2);
}

/// Thickness of a cell along d: volume over the mean of its two faces [m]; 0 where they have no measure.
template <int D>
double thickness(const Block<D>& block, std::size_t d, std::size_t c) {
  const std::size_t up = c + static_cast<std::size_t>(block.extent.stride[d]);
  const double s = 0.5 * (face_measure(block, d, c) + face_measure(block, d, up));
  return s > 0.0 ? block.volume[c] / s : 0.0;
}

/// An empty block: sizes set, inner nodes at position(i, j, k), metrics set.
template <int D>
Block<D> make_block(const std::string& name, const std::array<int, D>& cells,
                    const std::array<bool, D>& periodic,
                    const std::function<std::array<double, D>(const std::array<int, D>&)>& position);

}  // namespace littoral::fv
