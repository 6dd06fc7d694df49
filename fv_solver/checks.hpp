#pragma once

#include "littoral/support/scene.hpp"

namespace littoral::fv {

/// throws ConfigError where the scene asks for what this solver does not compute
void check_scene(const support::Scene& scene);

}  // namespace littoral::fv
