#pragma once

#include <vector>

#include "boundary/links.hpp"
#include "implicit/level_grid.hpp"

namespace littoral::fv {

/// Which directions each block halves on the way to the next level (coarsening_ratio) so that joined faces go
/// on meeting point to point: a join's tangential directions are halved on both sides or on neither, and only
/// where its range begins and ends between coarse cells. Shapes, joins and held directions
/// (`held_directions.hpp`) of all blocks of all ranks. pure
template <int D>
std::vector<std::array<int, D>> joint_ratios(const std::vector<BlockShape<D>>& shapes,
                                             const std::vector<JoinSide<D>>& joins,
                                             const std::vector<std::array<bool, D>>& held = {});

/// The shapes of the next level.
template <int D>
std::vector<BlockShape<D>> coarse_shapes(const std::vector<BlockShape<D>>& shapes,
                                         const std::vector<std::array<int, D>>& ratios);

/// The same joins between the blocks of the next level.
template <int D>
std::vector<JoinSide<D>> coarse_joins(const std::vector<JoinSide<D>>& joins,
                                      const std::vector<std::array<int, D>>& ratios);

}  // namespace littoral::fv
