#include "bodies/shape.hpp"

#include <algorithm>
#include <limits>

#include "bodies/triangle_surface.hpp"

namespace littoral::sph {
namespace {

constexpr double k_endless = std::numeric_limits<double>::infinity();

/// A plane section drawn out along y, over [-half, half].
template <class ClosestOnSection>
class Extrusion : public Shape {
 public:
  Extrusion(ClosestOnSection closest_on_section, double half, std::array<Point2, 2> bounds)
      : section_(std::move(closest_on_section)), half_(half), bounds_(bounds) {}

  SurfacePoint closest(const Vector3& x) const override {
    const EdgePoint edge = section_(Point2{x[0], x[2]});
    const SurfacePoint side{{edge.point[0], x[1], edge.point[1]},
                            {edge.normal[0], 0.0, edge.normal[1]},
                            edge.distance,
                            edge.curved ? 0 : -1};
    if (half_ == k_endless) return side;
    const double end = x[1] < 0.0 ? -half_ : half_;
    const double beyond = std::fabs(x[1]) - half_;
    if (edge.distance > 0.0 && beyond > 0.0) {
      const Vector3 p = {edge.point[0], end, edge.point[1]}, away = x - p;
      const double r = norm(away);
      return {p, (1.0 / r) * away, r, -1};
    }
    if (edge.distance >= beyond) return side;
    return {{x[0], end, x[2]}, {0.0, end < 0.0 ? -1.0 : 1.0, 0.0}, beyond, -1};
  }
  std::array<Vector3, 2> bounds() const override {
    return {{{bounds_[0][0], -half_, bounds_[0][1]}, {bounds_[1][0], half_, bounds_[1][1]}}};
  }

 private:
  ClosestOnSection section_;
  double half_;
  std::array<Point2, 2> bounds_;
};

template <class F>
std::unique_ptr<Shape> extrude(F section, double half, std::array<Point2, 2> bounds) {
  return std::make_unique<Extrusion<F>>(std::move(section), half, bounds);
}

std::unique_ptr<Shape> polygon(const std::vector<Point2>& corners, double half) {
  std::array<Point2, 2> bounds = {corners[0], corners[0]};
  for (const Point2& c : corners)
    for (std::size_t d = 0; d < 2; ++d) {
      bounds[0][d] = std::min(bounds[0][d], c[d]);
      bounds[1][d] = std::max(bounds[1][d], c[d]);
    }
  return extrude([corners](const Point2& x) { return closest_on_polygon(corners, x); }, half, bounds);
}

class Sphere : public Shape {
 public:
  explicit Sphere(double radius) : radius_(radius) {}
  SurfacePoint closest(const Vector3& x) const override {
    const double r = norm(x);
    const Vector3 n = r > 0.0 ? (1.0 / r) * x : Vector3{0.0, 0.0, 1.0};
    return {radius_ * n, n, r - radius_, 0};
  }
  std::array<Vector3, 2> bounds() const override {
    return {{{-radius_, -radius_, -radius_}, {radius_, radius_, radius_}}};
  }

 private:
  double radius_;
};

/// A rectangle in the plane z = 0, without thickness.
class Plate : public Shape {
 public:
  explicit Plate(const Point2& half) : half_(half) {}
  SurfacePoint closest(const Vector3& x) const override {
    const Vector3 on = {std::clamp(x[0], -half_[0], half_[0]), std::clamp(x[1], -half_[1], half_[1]), 0.0};
    const double r = norm(x - on);
    return {on, r > 0.0 ? (1.0 / r) * (x - on) : Vector3{0.0, 0.0, 1.0}, r, -1};
  }
  std::array<Vector3, 2> bounds() const override {
    return {{{-half_[0], -half_[1], 0.0}, {half_[0], half_[1], 0.0}}};
  }
  std::optional<Point2> sheet() const override { return half_; }

 private:
  Point2 half_;
};

class Triangulated : public Shape {
 public:
  explicit Triangulated(std::shared_ptr<const TriangleSurface> surface) : surface_(std::move(surface)) {}
  SurfacePoint closest(const Vector3& x) const override { return surface_->closest(x); }
  std::array<Vector3, 2> bounds() const override { return surface_->bounds(); }

 private:
  std::shared_ptr<const TriangleSurface> surface_;
};

}  // namespace

std::unique_ptr<Shape> make_shape(const support::BodySpec& spec, bool planar,
                                  std::shared_ptr<const TriangleSurface> surface) {
  using Kind = support::BodySpec::Shape;
  const double half_width = planar ? k_endless : 0.5 * spec.size[1];
  const double a = 0.5 * spec.size[0], c = 0.5 * spec.size[2];
  switch (spec.shape) {
    case Kind::box:
      return polygon({{-a, -c}, {a, -c}, {a, c}, {-a, c}}, half_width);
    case Kind::wedge:
      return polygon({{-a, 0.0}, {a, 0.0}, {spec.apex, spec.size[2]}}, half_width);
    case Kind::cylinder: {
      const double r = spec.radius;
      return extrude([r](const Point2& x) { return closest_on_disc(r, x); },
                     planar ? k_endless : 0.5 * spec.length, {{{-r, -r}, {r, r}}});
    }
    case Kind::sphere:
      return std::make_unique<Sphere>(spec.radius);
    case Kind::stl:
      return std::make_unique<Triangulated>(std::move(surface));
    case Kind::plate:
      return std::make_unique<Plate>(Point2{a, half_width});
  }
  return nullptr;  // every kind has returned
}

}  // namespace littoral::sph
