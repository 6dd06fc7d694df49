#pragma once

#include <vector>

#include "grid/block.hpp"
#include "littoral/support/scene.hpp"

namespace littoral::fv {

/// throws ConfigError where the scene asks for what this solver does not compute
void check_scene(const support::Scene& scene);

/// Of all blocks. throws ConfigError where two meet, but nothing passes from one to the other
template <int D>
void check_apart(const std::vector<Block<D>>& blocks);

/// Of the blocks as they are about to be solved, the SPH region carved out of them. level_set: a free surface
/// in them is computed
/// throws ConfigError: a fringe face beside a solved cell, a free surface in solved cells without a level set
template <int D>
void check_blocks(const std::vector<Block<D>>& blocks, const support::Scene& scene, bool level_set = false);

}  // namespace littoral::fv
