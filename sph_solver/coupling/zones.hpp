#pragma once

#include <array>
#include <vector>

#include "coupling/axes.hpp"
#include "littoral/coupler/types.hpp"
#include "littoral/support/scene.hpp"
#include "particles/particles.hpp"

namespace littoral::sph {

/// One box of the SPH region with its layers. A face is open if it lies inside the domain; a face on (or
/// beyond) a side of the domain is closed by that side's condition and has no layers. Outward from an open
/// nominal face follow the blending layer and the driven layer; the outer face ends them.
template <int D>
struct RegionBox {
  Point<D> lower{}, upper{};                  // [m] nominal faces, cut to the domain
  Point<D> outer_lower{}, outer_upper{};      // [m] the nominal faces, or the outer ones where open
  std::array<std::array<bool, 2>, D> open{};  // [direction][lower, upper]
  std::array<bool, D> periodic{};             // it repeats itself in this direction

  /// Outward distance beyond the nominal open faces [m]; negative or zero inside. At an edge or corner of
  /// several open faces the largest counts, so that the layers are nested boxes.
  double excess(const Point<D>& x) const;
  bool inside_outer(const Point<D>& x) const;
};

/// Layers of the SPH region: which zone a point lies in, and how much SPH weighs there.
template <int D>
class Layers {
 public:
  Layers() = default;
  /// pre: every box inside the domain, at least one direction wide; widths >= 0
  Layers(std::vector<RegionBox<D>> boxes, double blending_width, double driven_width);
  /// Cuts the scene's regions to its domain. Without regions, or without coupling, the region is the domain
  /// and nothing is open. throws ConfigError: region outside the domain, thinner than its layers, driven
  /// layer thinner than the kernel radius
  static Layers from_scene(const support::Scene& scene, double kernel_radius);

  const std::vector<RegionBox<D>>& boxes() const { return boxes_; }
  double blending_width() const { return blending_; }
  double driven_width() const { return driven_; }
  bool any_open() const;

  /// Distance beyond the nominal faces; of several boxes the one that holds x deepest.
  double excess(const Point<D>& x) const;
  Zone zone(double excess) const {
    return excess <= 0.0 ? Zone::interior : excess < blending_ ? Zone::blending : Zone::driven;
  }
  /// Weight of SPH in (17): d_e / (d_e + d_i), 1 at the nominal face and inside, 0 at the end of the blending
  /// layer and beyond. At corners the smallest of the faces' weights. FV weighs the rest.
  double sph_weight(double excess) const {
    if (excess <= 0.0) return 1.0;
    if (excess >= blending_) return 0.0;
    return (blending_ - excess) / blending_;
  }
  bool inside_outer(const Point<D>& x) const;

  /// True in a direction in which `reach` from x, up or down, leads through an open outer face and out of all
  /// boxes: the kernel is cut there and its normal component must not be used.
  std::array<bool, D> blocked_normals(const Point<D>& x, double reach) const;

  coupler::Box needs(double skin) const;  ///< where donors are needed: the layers, grown; empty if none
  coupler::Box covers() const;            ///< where samples can be given: nominal boxes and blending layers

 private:
  std::vector<RegionBox<D>> boxes_;
  double blending_ = 0.0;
  double driven_ = 0.0;
};

}  // namespace littoral::sph
