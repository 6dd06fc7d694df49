#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "bodies/walls.hpp"
#include "config.hpp"
#include "neighbors/neighbor_list.hpp"
#include "particles/particles.hpp"

namespace littoral::sph {

template <int D>
struct PointValue {
  double p = 0.0;             // [Pa]
  std::array<double, D> u{};  // [m/s]
};

/// Fields at a point, exact for linear fields: moving least squares with a linear basis and weights V W;
/// Shepard's average where too few particles are near. Absent where there is none. walls, here and below:
/// null without bodies; water behind a sheet does not count.
template <int D>
std::optional<PointValue<D>> value_at(const Particles<D>& particles, const NeighborList<D>& neighbors,
                                      const std::array<double, D>& x, const Walls<D>* walls = nullptr);

/// sum V W at a point: 1 in the water, 1/2 on a plane surface.
template <int D>
double coverage_at(const Particles<D>& particles, const NeighborList<D>& neighbors,
                   const std::array<double, D>& x, const Walls<D>* walls = nullptr);

/// Height of the surface on the vertical line through x: the highest level where sum V W = 1/2, as on a plane
/// surface. It changes smoothly in time, since no particle is singled out. Absent where the line meets no
/// water. Next to bodies half of what they leave free counts. walls: null without bodies
template <int D>
std::optional<double> elevation_at(const Particles<D>& particles, const NeighborList<D>& neighbors,
                                   const std::array<double, D>& x, double spacing,
                                   const Walls<D>* walls = nullptr);

/// Column names of gauges.csv after `time`, and one row of values; NaN where there is no water. sensed: what
/// the force discs measure, in their order [Pa].
std::vector<std::string> gauge_columns(const std::vector<GaugeConfig>& gauges, int dimension);
template <int D>
std::vector<double> gauge_values(const std::vector<GaugeConfig>& gauges, const Particles<D>& particles,
                                 const NeighborList<D>& neighbors, double spacing,
                                 const Walls<D>* walls = nullptr, const std::vector<double>& sensed = {});

}  // namespace littoral::sph
