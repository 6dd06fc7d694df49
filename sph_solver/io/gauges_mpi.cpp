#include "io/gauges_mpi.hpp"

#include <algorithm>
#include <cmath>

#include "boundary/ghosts.hpp"
#include "parallel/gather_mpi.hpp"

namespace littoral::sph {
namespace {

using Side = support::Scene::Side;

/// Least distance along direction d from g to x or to one of its images.
template <int D>
double distance_along(const DomainBox<D>& box, std::size_t d, double x, double g) {
  double least = std::fabs(x - g);
  if (box.is_periodic(d))
    least = std::min({least, std::fabs(x + box.length(d) - g), std::fabs(x - box.length(d) - g)});
  if (box.sides[d][0] == Side::symmetry) least = std::min(least, std::fabs(2.0 * box.lower[d] - x - g));
  if (box.sides[d][1] == Side::symmetry) least = std::min(least, std::fabs(2.0 * box.upper[d] - x - g));
  return least;
}

}  // namespace

template <int D>
std::vector<std::int32_t> near_gauges(const std::vector<GaugeConfig>& gauges, const Particles<D>& particles,
                                      const DomainBox<D>& box, double reach) {
  std::vector<std::int32_t> chosen;
  for (std::size_t i = 0; i < particles.n_owned; ++i) {
    const auto is_near = [&](const GaugeConfig& gauge) {
      if (gauge.kind == GaugeConfig::Kind::force_disc) return false;  // reads the walls, not the particles
      const std::size_t n = gauge.kind == GaugeConfig::Kind::elevation ? D - 1 : D;  // a line, or a point
      double r2 = 0.0;
      for (std::size_t d = 0; d < n; ++d) {
        const double r = distance_along(box, d, particles.x[d][i], gauge.position[scene_axis<D>(d)]);
        r2 += r * r;
      }
      const double within = reach + 0.5 * gauge.diameter;
      return r2 < within * within;
    };
    if (std::any_of(gauges.begin(), gauges.end(), is_near)) chosen.push_back(static_cast<std::int32_t>(i));
  }
  return chosen;
}

template <int D>
std::vector<double> gauge_values_on_root(const std::vector<GaugeConfig>& gauges,
                                         const Particles<D>& particles, const DomainBox<D>& box,
                                         const NeighborList<D>& neighbors, double spacing, MPI_Comm comm,
                                         const Walls<D>* walls, const std::vector<double>& sensed) {
  const double reach = neighbors.reach();
  Particles<D> around = gather_on_root(particles, near_gauges(gauges, particles, box, reach), comm);
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  if (rank != 0) return {};
  Ghosts<D>(box).create(around, reach);
  NeighborList<D> lists(neighbors.kernel_radius(), reach - neighbors.kernel_radius());
  lists.build(around);
  return gauge_values(gauges, around, lists, spacing, walls, sensed);
}

template std::vector<std::int32_t> near_gauges<2>(const std::vector<GaugeConfig>&, const Particles<2>&,
                                                  const DomainBox<2>&, double);
template std::vector<std::int32_t> near_gauges<3>(const std::vector<GaugeConfig>&, const Particles<3>&,
                                                  const DomainBox<3>&, double);
template std::vector<double> gauge_values_on_root<2>(const std::vector<GaugeConfig>&, const Particles<2>&,
                                                     const DomainBox<2>&, const NeighborList<2>&, double,
                                                     MPI_Comm, const Walls<2>*, const std::vector<double>&);
template std::vector<double> gauge_values_on_root<3>(const std::vector<GaugeConfig>&, const Particles<3>&,
                                                     const DomainBox<3>&, const NeighborList<3>&, double,
                                                     MPI_Comm, const Walls<3>*, const std::vector<double>&);

}  // namespace littoral::sph
