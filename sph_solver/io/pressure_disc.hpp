#pragma once

#include "config.hpp"
#include "neighbors/neighbor_list.hpp"
#include "particles/particles.hpp"

namespace littoral::sph {

struct DiscPressure {
  double p = 0.0;    // [Pa] mean over the disc; the reference pressure where it is dry
  double wet = 0.0;  // share of its area
};

/// Mean pressure over a disc, as a sensor in a wall shows it. In 2-D over its section, each place weighted
/// with the disc's width there. A place is wet if the water covers half of what bodies leave free around it.
template <int D>
DiscPressure disc_pressure(const GaugeConfig& gauge, const Particles<D>& particles,
                           const NeighborList<D>& neighbors, const Walls<D>* walls);

}  // namespace littoral::sph
