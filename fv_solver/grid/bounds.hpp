#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "grid/block.hpp"
#include "grid/loops.hpp"
#include "grid/space.hpp"
#include "littoral/coupler/types.hpp"

namespace littoral::fv {

/// The box around the nodes of all blocks; in 2-D it has no extent in y. pure
template <int D>
coupler::Box bounds(const std::vector<Block<D>>& blocks) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  coupler::Box box{{inf, inf, inf}, {-inf, -inf, -inf}};
  for (const auto& block : blocks) {
    std::array<int, D> upper = block.extent.n;
    for (int& n : upper) ++n;
    for_each_index<D>({}, upper, [&](const std::array<int, D>& index) {
      const auto node = static_cast<std::size_t>(block.node_extent.at(index));
      for (std::size_t d = 0; d < D; ++d) {
        const std::size_t a = axis_in_space<D>(d);
        box.lower[a] = std::min(box.lower[a], block.node[d][node]);
        box.upper[a] = std::max(box.upper[a], block.node[d][node]);
      }
    });
  }
  if (D == 2) box.lower[1] = box.upper[1] = 0.0;
  return box;
}

}  // namespace littoral::fv
