#pragma once

#include "config.hpp"
#include "dual_time/stepper.hpp"

namespace littoral::fv {

/// The blocks of a configuration with their windows. throws ConfigError with the problems of all blocks
template <int D>
std::vector<Block<D>> build_blocks(const FvConfig& config, const support::Scene& scene);

/// The discrete problem of a configuration: blocks, fluid, wave speeds, inner solver, sources, initial state.
/// throws ConfigError
template <int D>
Stepper<D> make_stepper(const FvConfig& config, const support::Scene& scene);

}  // namespace littoral::fv
