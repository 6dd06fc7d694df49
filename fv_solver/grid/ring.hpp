#pragma once

#include "config.hpp"
#include "grid/block.hpp"
#include "grid/face_windows.hpp"

namespace littoral::fv {

/// The O-grid of a configuration: direction 0 around (closed on itself), 1 outward, 2 along the span.
/// throws ConfigError: spacing that does not fit, faces without condition, a span without extent
template <int D>
Block<D> build_ring(const RingConfig& config, const support::Scene& scene, const Neighbourhood& others);

}  // namespace littoral::fv
