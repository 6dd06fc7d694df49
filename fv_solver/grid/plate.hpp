#pragma once

#include <vector>

#include "config.hpp"
#include "grid/block.hpp"
#include "grid/face_windows.hpp"

namespace littoral::fv {

/// The blocks around a plate; they join one another (find_joins). Lines between the plate and the outer edge
/// are not cut.
/// throws ConfigError: spacing that does not fit, outer faces without condition
template <int D>
std::vector<Block<D>> build_plate(const PlateConfig& config, const support::Scene& scene,
                                  const Neighbourhood& others);

}  // namespace littoral::fv
