#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "littoral/support/timers.hpp"

namespace littoral::fv {

/// Wall time of the parts of a step on this rank, since the start [s]:
///   surface     what the free surface does: follows the flow in each cycle, is a distance again at the end
///   residual    ghosts, fluxes, residuals, their norm
///   jacobian    blocks of all levels, and their elimination
///   correction  multigrid cycles
///   mixing      Anderson, and the correction's way into the state
class StepPhases {
 public:
  enum Phase : std::size_t { surface, residual, jacobian, correction, mixing };
  StepPhases() {
    for (const char* name : {"surface", "residual", "jacobian", "correction", "mixing"})
      timers_.declare(name);
  }
  support::Timers::Scope scope(Phase phase) { return timers_.scope(phase); }
  std::vector<std::pair<std::string, double>> table() const { return timers_.table(); }

 private:
  support::Timers timers_;
};

}  // namespace littoral::fv
