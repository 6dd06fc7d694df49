#pragma once

#include "littoral/support/scene.hpp"

namespace littoral::support {

/// Conditions between keys of a scene, reported to the binder at the key a user would change.
void check_scene(const Scene& scene, Binder& b);

}  // namespace littoral::support
