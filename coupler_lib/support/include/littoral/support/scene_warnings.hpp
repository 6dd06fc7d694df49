#pragma once

#include <string>
#include <vector>

#include "littoral/support/scene.hpp"

namespace littoral::support {

/// Particle steps a window that were compared with one step; what is warned of, for where the particles
/// choose their step it may be a few more.
constexpr int k_measured_substeps = 10, k_too_many_substeps = 2 * k_measured_substeps;

/// What a scene may ask for, but hardly means: gravity that points up, a sound speed too low for the flow,
/// windows of very many steps.
/// One sentence each; both programs say them in --check and at the start of a run. pure
std::vector<std::string> scene_warnings(const Scene& scene);

}  // namespace littoral::support
