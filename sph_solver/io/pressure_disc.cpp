#include "io/pressure_disc.hpp"

#include <cmath>

#include "io/gauges.hpp"

namespace littoral::sph {
namespace {

constexpr double k_in_front = 1e-6;  // of the diameter

/// A place of the disc in its own plane, and its share of the area.
struct Place {
  double s, t, weight;
};

std::vector<Place> strips(double radius) {
  constexpr int n = 16;
  std::vector<Place> places;
  double sum = 0.0;
  for (int k = 0; k < n; ++k) {
    const double s = (2.0 * k + 1.0) / n - 1.0;
    places.push_back({radius * s, 0.0, std::sqrt(1.0 - s * s)});
    sum += places.back().weight;
  }
  for (auto& place : places) place.weight /= sum;
  return places;
}

/// Evenly spread (Vogel's spiral).
std::vector<Place> spiral(double radius) {
  constexpr int n = 48;
  const double golden = 3.14159265358979323846 * (3.0 - std::sqrt(5.0));
  std::vector<Place> places;
  for (int k = 0; k < n; ++k) {
    const double r = radius * std::sqrt((k + 0.5) / n);
    places.push_back({r * std::cos(golden * k), r * std::sin(golden * k), 1.0 / n});
  }
  return places;
}

}  // namespace

template <int D>
DiscPressure disc_pressure(const GaugeConfig& gauge, const Particles<D>& particles,
                           const NeighborList<D>& neighbors, const Walls<D>* walls) {
  const Vector3 n = (1.0 / norm(gauge.normal)) * gauge.normal;
  const Vector3 other = std::fabs(n[1]) < 0.9 ? Vector3{0, 1, 0} : Vector3{1, 0, 0};
  Vector3 s = cross(other, n);
  s = (1.0 / norm(s)) * s;
  const Vector3 t = cross(n, s);
  // A disc in a plate hears the water it looks away from, a hair in front of it.
  const Vector3 centre = gauge.position - k_in_front * gauge.diameter * n;
  DiscPressure mean;
  for (const Place& place : D == 2 ? strips(0.5 * gauge.diameter) : spiral(0.5 * gauge.diameter)) {
    const auto x = in_plane<D>(centre + place.s * s + place.t * t);
    const double free = walls ? 1.0 - walls->coverage(x) : 1.0;
    const bool wet = coverage_at<D>(particles, neighbors, x, walls) >= 0.5 * free;
    const auto value = wet ? value_at<D>(particles, neighbors, x, walls) : std::nullopt;
    mean.p += place.weight * (value ? value->p : gauge.dry_pressure);
    if (value) mean.wet += place.weight;
  }
  return mean;
}

template DiscPressure disc_pressure<2>(const GaugeConfig&, const Particles<2>&, const NeighborList<2>&,
                                       const Walls<2>*);
template DiscPressure disc_pressure<3>(const GaugeConfig&, const Particles<3>&, const NeighborList<3>&,
                                       const Walls<3>*);

}  // namespace littoral::sph
