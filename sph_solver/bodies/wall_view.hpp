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

/// The wall that a particle sees at one dummy: a plane.
template <int D>
struct WallPlane {
  Vector<D> n;      // out of the fluid
  Vector<D> u;      // [m/s]
  Vector<D> a;      // [m/s^2]
  double distance;  // of the particle from the plane [m]
};

/// The wall planes of one row. A dummy shows the plane of the surface next to it. Where the particle stands
/// behind that plane (the far face at a convex edge) it sees the plane of the closest dummy in front of which
/// it stands; if there is none (it has just entered the body), the plane it is least behind. Of a sheet and
/// of a curved patch it sees the plane at the point closest to itself, square to the way there (the edge of a
/// sheet is round), but for a patch's dummies that face the other way (a pipe has two sides). Planes of a
/// patch's dummies will not do: a particle that slides along a convex wall leaves those ahead and enters
/// those behind, and their answers rho c e would pull it forward at the rate c U / radius, whatever the
/// spacing; carrying u to each dummy's point instead leaves as much of that as the gradients are wrong.
template <int D>
class WallView {
 public:
  WallView(const std::vector<Body>& bodies, const Dummies<D>& dummies, const WallList<D>& list,
           std::size_t row, const Vector<D>& x)
      : bodies_(bodies), dummies_(dummies), list_(list), row_(row), x_(x) {}

  WallPlane<D> plane(std::size_t e) {
    if (dummies_[e].patch >= 0) {
      const Own& own = of_patch(e);
      if (own.given && dot_of<D>(own.plane.n, dummies_[e].normal) > 0.0) return own.plane;
    }
    return plane_of_dummy(e);
  }
  /// The plane next to the dummy, whatever the particle's place on a patch.
  WallPlane<D> plane_of_dummy(std::size_t e) {
    const double d = distance(e);
    if (d > 0.0 && dummies_.on_sheet(e)) return of_sheet(e);
    if (d >= 0.0) return plane(e, d);
    if (!found_) find_closest();
    return plane(closest_, distance_);
  }
  /// Of the closest dummy in front of which the particle stands.
  WallPlane<D> closest() {
    if (!found_) find_closest();
    return plane(closest_, distance_);
  }

 private:
  /// What the particle sees of one patch; given: its closest point of the body belongs to the patch.
  struct Own {
    std::size_t dummy;  // one of the patch
    bool given;
    WallPlane<D> plane;
  };
  const Own& of_patch(std::size_t e) {
    for (std::size_t k = 0; k < n_own_; ++k) {
      const std::size_t known = own_[k].dummy;
      if (dummies_[known].body == dummies_[e].body && dummies_[known].patch == dummies_[e].patch &&
          dummies_.same_image(known, e))
        return own_[k];
    }
    Own& own = own_[n_own_ < own_.size() ? n_own_++ : n_own_ - 1];  // seldom more: then found anew
    own.dummy = e;
    const Body& body = bodies_[static_cast<std::size_t>(dummies_[e].body)];
    const SurfacePoint wall = body.closest_wall(in_scene<D>(dummies_.in_source(e, x_)));
    own.given = wall.patch == dummies_[e].patch;
    own.plane = {dummies_.turned(e, wall.normal), dummies_.turned(e, body.state().velocity_at(wall.point)),
                 dummies_.turned(e, body.state().acceleration_at(wall.point)), wall.distance};
    return own;
  }
  WallPlane<D> of_sheet(std::size_t e) const {
    Vector<D> n = dummies_.closest_on_sheet(e, x_);
    for (std::size_t k = 0; k < D; ++k) n[k] -= x_[k];
    const double d = std::sqrt(dot_of<D>(n, n));
    for (double& component : n) component /= d;
    return {n, dummies_[e].u, dummies_[e].a, d};
  }
  double distance(std::size_t e) const {
    double d = 0.0;
    for (std::size_t k = 0; k < D; ++k) d += (dummies_[e].wall[k] - x_[k]) * dummies_[e].normal[k];
    return d;
  }
  WallPlane<D> plane(std::size_t e, double d) const {
    return {dummies_[e].normal, dummies_[e].u, dummies_[e].a, d};
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

  const std::vector<Body>& bodies_;
  const Dummies<D>& dummies_;
  const WallList<D>& list_;
  std::size_t row_;
  Vector<D> x_;
  bool found_ = false;
  std::size_t closest_ = 0;
  double distance_ = 0.0;
  std::array<Own, 4> own_;
  std::size_t n_own_ = 0;
};

}  // namespace littoral::sph
