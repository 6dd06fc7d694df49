#include "io/pressure_disc.hpp"

#include "bodies/disc_places.hpp"
#include "io/gauges.hpp"

namespace littoral::sph {
namespace {

constexpr double k_in_front = 1e-6;  // of the diameter

}  // namespace

template <int D>
DiscPressure disc_pressure(const GaugeConfig& gauge, const Particles<D>& particles,
                           const NeighborList<D>& neighbors, const Walls<D>* walls) {
  DiscFrame disc(gauge.position, gauge.normal);
  // A disc in a plate hears the water it looks away from, a hair in front of it.
  disc.centre = gauge.position - k_in_front * gauge.diameter * disc.normal;
  DiscPressure mean;
  for (const DiscPlace& place : disc_places(D, 0.5 * gauge.diameter)) {
    const auto x = in_plane<D>(disc.point(place.s, place.t));
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
