#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "dual_time/stepper.hpp"
#include "io/state_file.hpp"
#include "littoral/support/scene.hpp"

namespace littoral::fv {

/// Everything a bitwise continuation needs: all time levels with ghosts, their steps, the window reached, and
/// what `more` puts (the companion's memory). comm collective
template <int D>
void write_checkpoint(const std::string& path, const Stepper<D>& stepper, std::int64_t window,
                      const support::Scene& scene, const std::function<void(StateWriter<D>&)>& more = {});

/// Sets the stepper to a checkpoint; returns the next window's index. Every rank reads its part, from a
/// checkpoint of any number of ranks.
/// throws ConfigError where it belongs to another scene or grid, IoError
template <int D>
std::int64_t read_checkpoint(const std::string& path, Stepper<D>& stepper, const support::Scene& scene);

}  // namespace littoral::fv
