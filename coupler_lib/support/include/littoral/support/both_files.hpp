#pragma once

#include <functional>
#include <string>
#include <vector>

#include "littoral/support/config.hpp"
#include "littoral/support/scene.hpp"

namespace littoral::support {

/// The scene named under `scene` in a program's file, then that file's own keys, which may use the scene's
/// constants: `bind_own` binds them, with defaults from the scene if it likes. `settings` are those of the
/// scene. throws ConfigError with all problems of both files
Scene read_both_files(const Document& own, const std::vector<std::string>& settings,
                      const std::function<void(Binder&, const Scene&)>& bind_own);

}  // namespace littoral::support
