#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "coupling/exterior.hpp"
#include "coupling/face_elements.hpp"
#include "neighbors/cell_grid.hpp"

namespace littoral::sph {

/// Positions near the outer faces of a region box: those of the particles, then those of the ones just born,
/// and the images of both beyond periodic sides.
template <int D>
class PresentParticles {
 public:
  PresentParticles(const RegionBox<D>& box, double reach) : box_(box), reach_(reach) {}
  void add(const Point<D>& x);
  /// Closes the first group; what is added later is searched one by one.
  void sort();
  /// Distance from x to the nearest, or to the image that a particle at x would have beyond a closed side;
  /// `reach` if none is nearer.
  double room(const Point<D>& x) const;
  bool inside(const Point<D>& x) const;  ///< of the outer faces and the closed sides

 private:
  RegionBox<D> box_;
  double reach_;
  std::array<std::vector<double>, D> x_;
  CellGrid<D> grid_;
  std::size_t n_sorted_ = 0;
};

/// A place for a new particle and the distance to the nearest one there; room < 0: no place in the water.
template <int D>
struct InjectionPlace {
  Point<D> x{};
  double room = -1.0;  // [m]
};

/// Where the particle of an element appears: in front of the element's centre, `depth` inside (at most a
/// spacing): where the water is by now that it stands for; so a steady inflow makes rows of even spacing
/// although particles appear only at the ends of steps. If a particle is there already, the emptiest of a few
/// places around. More and further ones if `far`. Places above FV's surface
/// are none, nor such less than `least_depth` [m] inside.
template <int D>
InjectionPlace<D> injection_place(const FaceElement<D>& element, double depth, double least_depth,
                                  double spacing, bool far, const PresentParticles<D>& present,
                                  const Exterior& fv, double time, std::int64_t& hint);

}  // namespace littoral::sph
