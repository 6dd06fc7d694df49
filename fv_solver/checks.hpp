#pragma once

#include <string>
#include <vector>

#include "grid/block.hpp"
#include "littoral/support/scene.hpp"

namespace littoral::fv {

/// Of all blocks. throws ConfigError where two meet, but nothing passes from one to the other
template <int D>
void check_apart(const std::vector<Block<D>>& blocks);

/// Of all blocks: water of the domain beyond the grid's outermost nodes that no region of the particles
/// holds, looked for on a lattice. Returns a sentence for each such side of the domain, where the grid is
/// alone (the domain then only says what closes the flow). throws ConfigError beside particles: their water
/// would lack what is beyond
template <int D>
std::vector<std::string> check_covered(const std::vector<Block<D>>& blocks, const support::Scene& scene);

/// Of the blocks as they are about to be solved, the SPH region carved out of them. level_set: a free surface
/// in them is computed
/// throws ConfigError: a fringe face beside a solved cell, a free surface in solved cells without a level set
template <int D>
void check_blocks(const std::vector<Block<D>>& blocks, const support::Scene& scene, bool level_set = false);

}  // namespace littoral::fv
