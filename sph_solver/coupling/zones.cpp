#include "coupling/zones.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "littoral/error.hpp"

namespace littoral::sph {

template <int D>
double RegionBox<D>::excess(const Point<D>& x) const {
  double e = -std::numeric_limits<double>::infinity();
  for (std::size_t d = 0; d < D; ++d) {
    if (open[d][0]) e = std::max(e, lower[d] - x[d]);
    if (open[d][1]) e = std::max(e, x[d] - upper[d]);
  }
  return e;
}

template <int D>
bool RegionBox<D>::inside_outer(const Point<D>& x) const {
  for (std::size_t d = 0; d < D; ++d) {
    if (open[d][0] && x[d] < outer_lower[d]) return false;
    if (open[d][1] && x[d] > outer_upper[d]) return false;
  }
  return true;
}

template <int D>
Layers<D>::Layers(std::vector<RegionBox<D>> boxes, double blending_width, double driven_width)
    : boxes_(std::move(boxes)), blending_(blending_width), driven_(driven_width) {
  const double both = blending_ + driven_;
  for (auto& box : boxes_) {
    box.outer_lower = box.lower;
    box.outer_upper = box.upper;
    for (std::size_t d = 0; d < D; ++d) {
      if (box.open[d][0]) box.outer_lower[d] -= both;
      if (box.open[d][1]) box.outer_upper[d] += both;
    }
  }
}

template <int D>
Layers<D> Layers<D>::from_scene(const support::Scene& scene, double kernel_radius) {
  const auto domain_lower = from_vec3<D>(scene.domain.lower);
  const auto domain_upper = from_vec3<D>(scene.domain.upper);
  const bool coupled = scene.coupling.kind != support::Scene::CouplingKind::none && !scene.regions.empty();
  if (!coupled) {
    RegionBox<D> all;
    all.lower = domain_lower;
    all.upper = domain_upper;
    return Layers({all}, 0.0, 0.0);
  }
  const double blending = scene.coupling.blending_width;
  const double driven = scene.coupling.driven_width;
  std::string problems;
  std::vector<RegionBox<D>> boxes;
  for (std::size_t k = 0; k < scene.regions.size(); ++k) {
    RegionBox<D> box;
    box.lower = from_vec3<D>(scene.regions[k].lower);
    box.upper = from_vec3<D>(scene.regions[k].upper);
    const std::string place = "regions[" + std::to_string(k) + "]";
    for (std::size_t d = 0; d < D; ++d) {
      // faces typed from the same numbers as the domain's coincide; this allows for a conversion
      const double tolerance = 1e-9 * (domain_upper[d] - domain_lower[d]);
      const char axis = "xyz"[space_axis<D>(d)];
      box.open[d][0] = box.lower[d] > domain_lower[d] + tolerance;
      box.open[d][1] = box.upper[d] < domain_upper[d] - tolerance;
      box.periodic[d] = !box.open[d][0] && !box.open[d][1] &&
                        scene.domain.sides[space_axis<D>(d)][0] == support::Scene::Side::periodic;
      box.lower[d] = std::max(box.lower[d], domain_lower[d]);
      box.upper[d] = std::min(box.upper[d], domain_upper[d]);
      if (box.upper[d] - box.lower[d] <= tolerance)
        problems += place + ": empty inside the domain in direction " + axis + ".\n";
      for (std::size_t s = 0; s < 2; ++s) {
        if (!box.open[d][s]) continue;
        const double room = s == 0 ? box.lower[d] - domain_lower[d] : domain_upper[d] - box.upper[d];
        if (room < blending + driven)
          problems += place + ": its " + (s == 0 ? "lower" : "upper") + " face in direction " + axis +
                      " lies " + std::to_string(room) + " m from the domain's side, but its layers need " +
                      std::to_string(blending + driven) +
                      " m (coupling.blending_width + driven_width). Move the face, or put it on the side.\n";
      }
    }
    boxes.push_back(box);
  }
  if (driven < kernel_radius * (1.0 - 1e-9))
    problems += "coupling.driven_width: " + std::to_string(driven) +
                " m, but the driven layer must hold a kernel radius, " + std::to_string(kernel_radius) +
                " m.\n";
  if (blending <= 0.0)
    problems += "coupling.blending_width: must be positive; 2 to 8 particle spacings serve alike.\n";
  if (!problems.empty()) throw ConfigError(problems);
  return Layers(std::move(boxes), blending, driven);
}

template <int D>
bool Layers<D>::any_open() const {
  for (const auto& box : boxes_)
    for (const auto& direction : box.open)
      if (direction[0] || direction[1]) return true;
  return false;
}

template <int D>
double Layers<D>::excess(const Point<D>& x) const {
  double e = std::numeric_limits<double>::infinity();
  for (const auto& box : boxes_) e = std::min(e, box.excess(x));
  return e;
}

template <int D>
bool Layers<D>::inside_outer(const Point<D>& x) const {
  for (const auto& box : boxes_)
    if (box.inside_outer(x)) return true;
  return false;
}

template <int D>
std::array<bool, D> Layers<D>::blocked_normals(const Point<D>& x, double reach) const {
  std::array<bool, D> blocked{};
  for (const auto& box : boxes_)
    for (std::size_t d = 0; d < D; ++d) {
      Point<D> lower = x, upper = x;
      lower[d] -= reach;
      upper[d] += reach;
      if (box.open[d][0] && lower[d] < box.outer_lower[d] && !inside_outer(lower)) blocked[d] = true;
      if (box.open[d][1] && upper[d] > box.outer_upper[d] && !inside_outer(upper)) blocked[d] = true;
    }
  return blocked;
}

namespace {

template <int D>
void unite(coupler::Box& sum, const Point<D>& lower, const Point<D>& upper) {
  coupler::Box box{to_vec3<D>(lower), to_vec3<D>(upper)};
  if (sum.empty()) {
    sum = box;
    return;
  }
  for (std::size_t d = 0; d < 3; ++d) {
    sum.lower[d] = std::min(sum.lower[d], box.lower[d]);
    sum.upper[d] = std::max(sum.upper[d], box.upper[d]);
  }
}

}  // namespace

template <int D>
coupler::Box Layers<D>::needs(double skin) const {
  coupler::Box sum = coupler::Box::nothing();
  for (const auto& box : boxes_)
    for (std::size_t d = 0; d < D; ++d)
      for (std::size_t s = 0; s < 2; ++s) {
        if (!box.open[d][s]) continue;
        Point<D> lower = box.outer_lower, upper = box.outer_upper;
        (s == 0 ? upper[d] : lower[d]) = s == 0 ? box.lower[d] : box.upper[d];
        unite<D>(sum, lower, upper);
      }
  if (sum.empty()) return sum;
  for (std::size_t d = 0; d < D; ++d) {
    sum.lower[space_axis<D>(d)] -= skin;
    sum.upper[space_axis<D>(d)] += skin;
  }
  return sum;
}

template <int D>
coupler::Box Layers<D>::covers() const {
  coupler::Box sum = coupler::Box::nothing();
  for (const auto& box : boxes_) {
    Point<D> lower = box.lower, upper = box.upper;
    for (std::size_t d = 0; d < D; ++d) {
      if (box.open[d][0]) lower[d] -= blending_;
      if (box.open[d][1]) upper[d] += blending_;
    }
    unite<D>(sum, lower, upper);
  }
  return sum;
}

template struct RegionBox<2>;
template struct RegionBox<3>;
template class Layers<2>;
template class Layers<3>;

}  // namespace littoral::sph
