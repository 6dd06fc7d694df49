#include "bodies/wall_sensors.hpp"

#include <algorithm>
#include <cmath>

#include "bodies/wall_view.hpp"
#include "littoral/error.hpp"
#include "physics/kernel.hpp"

namespace littoral::sph {
namespace {

constexpr double k_in_wall = 0.5;    // [spacings] a disc's centre may be off the wall it belongs to
constexpr double k_along = 0.9;      // least cosine between a disc's normal and the wall's
constexpr double k_in_front = 1e-3;  // [R] what belongs to the wall is looked for a hair in front of it
// Of the integrals over the wall and the water in front: cells in a kernel radius, and at most from a disc's
// middle.
constexpr int k_cells = 12, k_most_cells = 24;

/// Shape of the kernel; 0 beyond R. s: distance over R.
double shape(double s) {
  const double q = std::max(0.0, 1.0 - s);
  return q * q * q * q * (1.0 + 4.0 * s);
}

template <int D>
bool in_water_side(const Vector3& x, const std::vector<Body>& bodies, const DomainBox<D>& box) {
  for (std::size_t d = 0; d < D; ++d)
    if (x[scene_axis<D>(d)] < box.lower[d] || x[scene_axis<D>(d)] > box.upper[d]) return false;
  return std::all_of(bodies.begin(), bodies.end(),
                     [&](const Body& body) { return body.closest_wall(x).distance > 0.0; });
}

/// A place of the wall and its weight in integrals over it: t times its area.
struct WallCell {
  double s, t, weight;
};

/// The wall around a disc. t is the body's push on the water in front, at one pressure, over that of all
/// dummies behind the disc's plane: the lattice they stand on need not begin at the wall.
template <int D>
std::vector<WallCell> wall_around(const DiscFrame& frame, double radius, double R, std::size_t body,
                                  const std::vector<Body>& bodies, const Dummies<D>& dummies,
                                  const DomainBox<D>& box) {
  const double extent = radius + R;
  std::vector<std::size_t> near;
  for (std::size_t e = 0; e < dummies.size(); ++e)
    if (norm(in_scene<D>(dummies[e].x) - frame.centre) < extent + 2.0 * R) near.push_back(e);
  const Kernel<D> kernel(R);
  const auto share = [&](const Vector3& place) {
    double own = 0.0, all = 0.0;
    for (int k = 0; k < k_cells; ++k) {
      const Vector3 x = place - ((k + 0.5) / k_cells) * R * frame.normal;
      if (!in_water_side<D>(x, bodies, box)) continue;
      for (const std::size_t e : near) {
        const Vector3 to = in_scene<D>(dummies[e].x) - x;
        const double r = norm(to), along = dot(to, frame.normal);
        const bool behind = dot(to + x - frame.centre, frame.normal) > 0.0;
        if (r >= R || (dummies.on_sheet(e) && !behind)) continue;  // those in front are for the other side
        const double push = -kernel.slope_over_r(r) * along;
        if (static_cast<std::size_t>(dummies[e].body) == body) own += push;
        if (behind) all += push;
      }
    }
    return all > 0.0 ? own / all : 0.0;
  };
  const int n = std::min(static_cast<int>(std::ceil(extent / R * k_cells)), k_most_cells);
  const double cell = extent / n;
  std::vector<WallCell> cells;
  for (int j = D == 3 ? -n : 0; j < (D == 3 ? n : 1); ++j)
    for (int i = -n; i < n; ++i) {
      const double a = (i + 0.5) * cell, b = D == 3 ? (j + 0.5) * cell : 0.0;
      if (std::hypot(a, b) > extent) continue;
      const double t = share(frame.point(a, b) - k_in_front * R * frame.normal);
      if (t != 0.0) cells.push_back({a, b, t * (D == 3 ? cell * cell : cell)});
    }
  return cells;
}

std::size_t body_of(const WallDisc& disc, const DiscFrame& frame, const std::vector<Body>& bodies,
                    double spacing) {
  const Vector3 x = disc.centre - k_in_front * spacing * frame.normal;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const SurfacePoint wall = bodies[b].closest_wall(x);
    if (std::fabs(wall.distance) > k_in_wall * spacing || dot(wall.normal, frame.normal) < k_along) continue;
    if (!bodies[b].moves()) return b;
    throw ConfigError("gauge '" + disc.name + "': body '" + bodies[b].name() +
                      "' moves; a force_disc stays where it is. Take the body's force from scalars.csv.");
  }
  throw ConfigError(
      "gauge '" + disc.name +
      "': no body has its wall there with that normal (out of the water). Move the force_disc into a "
      "wall, or use a pressure_disc.");
}

}  // namespace

template <int D>
WallSensors<D>::WallSensors(const std::vector<WallDisc>& discs, const std::vector<Body>& bodies,
                            const Dummies<D>& dummies, const DomainBox<D>& box, double spacing,
                            double kernel_radius)
    : R_(kernel_radius), spacing_(spacing) {
  for (const WallDisc& spec : discs) {
    const DiscFrame frame(spec.centre, spec.normal);
    Disc disc{frame, 0.5 * spec.diameter, body_of(spec, frame, bodies, spacing), {}};
    disc.places = disc_places(D, disc.radius);
    const auto wall = wall_around<D>(frame, disc.radius, R_, disc.body, bodies, dummies, box);
    for (DiscPlace& place : disc.places) {
      double around = 0.0;
      for (const WallCell& cell : wall)
        around += cell.weight * shape(std::hypot(cell.s - place.s, cell.t - place.t) / R_);
      place.weight = around > 0.0 ? place.weight / around : 0.0;
    }
    discs_.push_back(std::move(disc));
  }
  mean_.assign(discs_.size(), std::numeric_limits<double>::quiet_NaN());  // no step has been made yet
}

template <int D>
void WallSensors<D>::add(const Particles<D>& particles, const WallList<D>& list, const RowForces<D>& forces,
                         std::size_t n_bodies, double weight) {
  for (std::size_t k = 0; k < discs_.size(); ++k) {
    const Disc& disc = discs_[k];
    for (std::size_t row = 0; row < list.n_rows(); ++row) {
      const Vector3 off = in_scene<D>(at<D>(particles.x, list.particle(row))) - disc.frame.centre;
      const double depth = dot(off, disc.frame.normal);
      if (depth < -R_ || depth > k_in_wall * spacing_) continue;  // at another wall of the body
      const double s = dot(off, disc.frame.s), t = D == 3 ? dot(off, disc.frame.t) : 0.0;
      if (std::hypot(s, t) > disc.radius + R_) continue;
      double share = 0.0;
      for (const DiscPlace& place : disc.places)
        share += place.weight * shape(std::hypot(s - place.s, t - place.t) / R_);
      mean_[k] += weight * share * dot(in_scene<D>(forces[row * n_bodies + disc.body]), disc.frame.normal);
    }
  }
}

template class WallSensors<2>;
template class WallSensors<3>;

}  // namespace littoral::sph
