#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "boundary/ghosts.hpp"
#include "coupling/axes.hpp"
#include "neighbors/cell_grid.hpp"
#include "particles/particles.hpp"
#include "physics/kernel.hpp"

namespace littoral::sph {

/// Distance to the surface as its particles tell it: (20), averaged with the kernel over the surface
/// particles around the nearest one (a single particle's position is noise of .03 dx). Sums run in the order
/// of ids, and of two as near the lower id is taken, however particles are stored and shared among ranks.
template <int D>
class SurfaceDistance {
 public:
  /// in   particles.surface, .normal of the owned, and their copies' sources
  /// band how far from the surface it is asked for [m]
  SurfaceDistance(const Particles<D>& particles, const Ghosts<D>& ghosts, double kernel_radius,
                  double spacing, double band);
  /// phi [m], < 0 in water; none where no surface particle is within the band. thread-safe
  std::optional<double> at(const Point<D>& place) const;

 private:
  template <class F>
  void visit(const Point<D>& place, double radius, const F& f) const {
    if (x_[0].empty()) return;
    grid_.for_each_range(place, radius, [&](std::size_t begin, std::size_t end) {
      for (std::size_t q = begin; q < end; ++q) {
        const auto s = static_cast<std::size_t>(grid_.order()[q]);
        double r2 = 0.0;
        for (std::size_t d = 0; d < D; ++d) r2 += (x_[d][s] - place[d]) * (x_[d][s] - place[d]);
        if (r2 < radius * radius) f(s, r2);
      }
    });
  }

  Kernel<D> kernel_;
  double spacing_, band_;
  std::array<std::vector<double>, D> x_, normal_;  // of the surface particles and their copies
  std::vector<std::int64_t> id_;
  CellGrid<D> grid_;
};

}  // namespace littoral::sph
