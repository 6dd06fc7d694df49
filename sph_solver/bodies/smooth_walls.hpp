#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "bodies/wall_view.hpp"
#include "physics/kernel.hpp"

namespace littoral::sph {

/// A particle that slides along a curved wall moves out of the plane of the dummies ahead of it into that of
/// those behind it (a convex wall; a concave one the other way round). Were each answered by itself, with
/// rho c e, they would pull it forward at the rate of c U / radius, whatever the resolution: energy from
/// nothing, which the carrying of velocities to the wall's points takes away only as far as the gradients
/// are exact. So all dummies of one smooth patch of a wall answer with the mean
///   e = sum f (dx . n) e_k / sum f (dx . n),   V grad W = f dx,
/// of their own e_k, over those in front of which the particle stands and whose normals are within a right
/// angle of the closest one's (a pipe narrower than the kernel has two sides): what is odd along the wall
/// drops out, and what is left works along the normal of the particle's own place, where u . n is small and
/// of the sign of e.
template <int D>
class SmoothWalls {
 public:
  /// Means of one row, each from the same e_k as a single dummy's: excess(plane).
  template <class Excess>
  void gather(const Dummies<D>& dummies, const WallList<D>& list, std::size_t row, const Vector<D>& x,
              WallView<D>& view, const Kernel<D>& kernel, const Excess& excess) {
    patches_.clear();
    if (!dummies.any_smooth()) return;
    const auto closest = view.closest();
    for (std::size_t pair = list.begin(row); pair < list.end(row); ++pair) {
      const std::size_t e = list.dummy(pair);
      if (dummies[e].patch < 0 || !view.in_front(e) || dot_of<D>(dummies[e].normal, closest.n) <= 0.0)
        continue;
      Vector<D> dx = dummies[e].x;
      for (std::size_t d = 0; d < D; ++d) dx[d] -= x[d];
      const double r = std::sqrt(dot_of<D>(dx, dx));
      const double weight = -kernel.slope_over_r(r) * std::max(0.0, dot_of<D>(dx, dummies[e].normal));
      if (!(weight > 0.0)) continue;
      const auto wall = view.plane(e);
      Patch& patch = of(wall);
      patch.weight += weight;
      patch.sum += weight * excess(wall);
    }
  }
  /// The mean for a plane of a patch that has one, else the plane's own.
  template <class Excess>
  double answer(const WallPlane<D>& wall, const Excess& excess) const {
    for (const Patch& patch : patches_)
      if (patch.patch == wall.patch && patch.body == wall.body) return patch.sum / patch.weight;
    return excess(wall);
  }

 private:
  struct Patch {
    std::int32_t body, patch;
    double weight = 0.0, sum = 0.0;
  };
  Patch& of(const WallPlane<D>& wall) {
    for (Patch& patch : patches_)
      if (patch.patch == wall.patch && patch.body == wall.body) return patch;
    return patches_.emplace_back(Patch{wall.body, wall.patch});
  }
  std::vector<Patch> patches_;
};

}  // namespace littoral::sph
