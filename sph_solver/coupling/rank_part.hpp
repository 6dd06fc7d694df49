#pragma once

#include <algorithm>
#include <cstddef>

#include "boundary/domain_box.hpp"
#include "coupling/axes.hpp"
#include "littoral/coupler/types.hpp"
#include "parallel/regions.hpp"

namespace littoral::sph {

/// The part of a box of space that concerns one rank: within `skin` [m] of its own part. Where that touches
/// one of two periodic sides the whole length counts, because what strays through the side is looked for at
/// the other. pure
template <int D>
coupler::Box rank_part(const coupler::Box& whole, const RankBox<D>& mine, const DomainBox<D>& domain,
                       double skin);

/// The box of the points `targets` wants values at, grown by `by` [m]; lower > upper: none.
template <int D, class Targets>
RankBox<D> box_of_targets(const Targets& targets, double by) {
  RankBox<D> box;
  box.lower.fill(1.0);
  box.upper.fill(-1.0);
  for (std::size_t t = 0; t < targets.size(); ++t) {
    const Point<D> x = from_vec3<D>({targets.x[t], targets.y[t], targets.z[t]});
    for (std::size_t d = 0; d < D; ++d) {
      box.lower[d] = t == 0 ? x[d] - by : std::min(box.lower[d], x[d] - by);
      box.upper[d] = t == 0 ? x[d] + by : std::max(box.upper[d], x[d] + by);
    }
  }
  return box;
}

}  // namespace littoral::sph
