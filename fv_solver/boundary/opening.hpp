#pragma once

#include "boundary/window.hpp"

namespace littoral::fv {

/// Whether water may pass a window of this condition into or out of the grid. pure
inline bool is_opening(Condition condition) {
  switch (condition) {
    case Condition::inflow:
    case Condition::outflow:
    case Condition::far_field:
    case Condition::convective:
    case Condition::state:
      return true;
    default:
      return false;
  }
}

}  // namespace littoral::fv
