#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "bodies/wall_list.hpp"

namespace littoral::sph {

template <int D>
using Vector = std::array<double, D>;

template <int D>
double dot_of(const Vector<D>& a, const Vector<D>& b) {
  double sum = 0.0;
  for (std::size_t d = 0; d < D; ++d) sum += a[d] * b[d];
  return sum;
}

template <int D>
Vector<D> at(const std::array<std::vector<double>, D>& columns, std::size_t k) {
  Vector<D> out;
  for (std::size_t d = 0; d < D; ++d) out[d] = columns[d][k];
  return out;
}

/// The wall that a particle sees at one dummy: a point of the surface and the plane that touches it there.
template <int D>
struct WallPlane {
  Vector<D> n;               // out of the fluid
  Vector<D> u;               // of the point [m/s]
  Vector<D> a;               // of the point [m/s^2]
  Vector<D> way;             // from the particle to the point [m]
  double distance;           // of the particle from the plane, way . n [m]
  std::int32_t body, patch;  // as Dummies have them
};

/// The wall planes of one row. A dummy shows the plane of the surface next to it. Where the particle stands
/// behind that plane (the far face at a convex edge) it sees the plane of the closest dummy in front of which
/// it stands; if there is none (it has just entered the body), the plane it is least behind. Of a sheet it
/// sees the plane at the point closest to itself, square to the way there: the edge of a sheet is round.
template <int D>
class WallView {
 public:
  WallView(const Dummies<D>& dummies, const WallList<D>& list, std::size_t row, const Vector<D>& x)
      : dummies_(dummies), list_(list), row_(row), x_(x) {}

  WallPlane<D> plane(std::size_t e) {
    const double d = distance(e);
    if (d > 0.0 && dummies_.on_sheet(e)) return of_sheet(e);
    if (d >= 0.0) return plane(e, d);
    if (!found_) find_closest();
    return plane(closest_, distance_);
  }
  /// The particle stands in front of the dummy's own plane.
  bool in_front(std::size_t e) const { return distance(e) >= 0.0; }
  /// Of the closest dummy in front of which the particle stands.
  WallPlane<D> closest() {
    if (!found_) find_closest();
    return plane(closest_, distance_);
  }

 private:
  WallPlane<D> of_sheet(std::size_t e) const {
    Vector<D> way = dummies_.closest_on_sheet(e, x_);
    for (std::size_t k = 0; k < D; ++k) way[k] -= x_[k];
    const double d = std::sqrt(dot_of<D>(way, way));
    Vector<D> n = way;
    for (double& component : n) component /= d;
    return {n, dummies_[e].u, dummies_[e].a, way, d, dummies_[e].body, -1};
  }
  double distance(std::size_t e) const {
    double d = 0.0;
    for (std::size_t k = 0; k < D; ++k) d += (dummies_[e].wall[k] - x_[k]) * dummies_[e].normal[k];
    return d;
  }
  WallPlane<D> plane(std::size_t e, double d) const {
    Vector<D> way = dummies_[e].wall;
    for (std::size_t k = 0; k < D; ++k) way[k] -= x_[k];
    return {dummies_[e].normal, dummies_[e].u, dummies_[e].a, way, d, dummies_[e].body, dummies_[e].patch};
  }
  void find_closest() {
    found_ = true;
    bool in_front = false;
    double least = std::numeric_limits<double>::infinity();
    distance_ = -least;
    for (std::size_t k = list_.begin(row_); k < list_.end(row_); ++k) {
      const std::size_t e = list_.dummy(k);
      const double d = distance(e);
      if (d < 0.0) {
        if (!in_front && d > distance_) distance_ = d, closest_ = e;
        continue;
      }
      double r2 = 0.0;
      for (std::size_t c = 0; c < D; ++c) r2 += (dummies_[e].x[c] - x_[c]) * (dummies_[e].x[c] - x_[c]);
      if (r2 >= least) continue;
      in_front = true;
      least = r2, closest_ = e, distance_ = d;
    }
  }

  const Dummies<D>& dummies_;
  const WallList<D>& list_;
  std::size_t row_;
  Vector<D> x_;
  bool found_ = false;
  std::size_t closest_ = 0;
  double distance_ = 0.0;
};

}  // namespace littoral::sph
