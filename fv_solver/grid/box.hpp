#pragma once

#include "config.hpp"
#include "grid/block.hpp"

namespace littoral::fv {

/// Position of node i of n cells along [0, 1].
double stretched(const Stretching& stretching, int i, int n);

/// The block of a configuration: nodes, metrics and windows. Where a face says `scene`, the condition is the
/// scene's for that side of its domain.
/// throws ConfigError: folded cells, faces without condition, patches outside their face, y in a plane
template <int D>
Block<D> build_block(const BlockConfig& config, const support::Scene& scene);

}  // namespace littoral::fv
