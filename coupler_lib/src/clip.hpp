#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "littoral/coupler/fields.hpp"

namespace littoral::coupler {

/// Index range of one patch.
struct Clip {
  std::size_t patch = 0;
  std::array<int, 3> first{}, n{};
};

/// Everything the patches can serve: their dual cells, half a cell further on each side. A planar patch
/// without extent along an axis has no bounds there.
Box reach(const DonorGeometry& geometry);

/// Of each patch the smallest index range whose dual cells serve all of `needs`; patches it does not meet are
/// absent.
std::vector<Clip> clip(const DonorGeometry& geometry, const Box& needs);

/// The clipped patches themselves.
DonorGeometry clipped(const DonorGeometry& geometry, const std::vector<Clip>& clips);

/// Contiguous pieces of a value array that make up the clipped patches, in their order.
struct Run {
  std::size_t first = 0, n = 0;
};
std::vector<Run> runs(const DonorGeometry& geometry, const std::vector<Clip>& clips);

/// Box around the targets; empty if there are none.
Box around(const Targets& targets);
/// Which targets a box holds.
std::vector<std::size_t> held_by(const Box& box, const Targets& targets);

}  // namespace littoral::coupler
