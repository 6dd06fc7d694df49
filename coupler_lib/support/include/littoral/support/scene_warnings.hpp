#pragma once

#include <string>
#include <vector>

#include "littoral/support/scene.hpp"

namespace littoral::support {

/// What a scene may ask for, but hardly means: gravity that points up, a sound speed too low for the flow.
/// One sentence each; both programs say them in --check and at the start of a run. pure
std::vector<std::string> scene_warnings(const Scene& scene);

}  // namespace littoral::support
