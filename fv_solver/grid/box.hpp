#pragma once

#include "config.hpp"
#include "grid/block.hpp"
#include "grid/face_windows.hpp"
#include "grid/stretching.hpp"

namespace littoral::fv {

/// The block of a configuration: nodes, metrics and windows. Where a face says `scene`, the condition is the
/// scene's for that side of its domain. Joins are requested, not found yet (find_joins).
/// throws ConfigError: folded cells, faces without condition, patches outside their face, y in a plane
template <int D>
Block<D> build_block(const BlockConfig& config, const support::Scene& scene,
                     const Neighbourhood& others = {});

}  // namespace littoral::fv
