#include <algorithm>
#include <cmath>

#include "coupling/samples.hpp"

namespace littoral::sph {

template <int D>
void constrain_pressure(const Particles<D>& particles, const Layers<D>& layers,
                        const SurfaceDistance<D>& surface, double spacing, double p0,
                        const coupler::Targets& targets, coupler::Samples& samples) {
  const Kernel<D> kernel(k_surface_kernel * spacing);
  std::array<std::vector<double>, D> x;
  std::vector<std::size_t> source;
  std::vector<std::int64_t> id;
  std::vector<double> depth;  // phi of these particles
  for (std::size_t j = 0; j < particles.size(); ++j) {
    const Point<D> place = at<D>(particles.x, j);
    if (layers.zone(layers.excess(place)) == Zone::driven) continue;
    const auto phi = surface.at(place);
    if (!phi) continue;
    for (std::size_t d = 0; d < D; ++d) x[d].push_back(place[d]);
    source.push_back(j);
    id.push_back(particles.id[j]);
    depth.push_back(*phi);
  }
  if (source.empty()) return;
  CellGrid<D> grid;
  grid.bin(x, source.size(), kernel.R);
  grid.sort_cells(x, id);
  const auto n = static_cast<std::ptrdiff_t>(targets.size());
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t k = 0; k < n; ++k) {
    const auto t = static_cast<std::size_t>(k);
    if ((targets.wants[t] & coupler::wants_phi) == 0 || samples.status[t] != coupler::SampleStatus::ok)
      continue;
    const Point<D> target = from_vec3<D>({targets.x[t], targets.y[t], targets.z[t]});
    const auto phi = surface.at(target);  // the sample's own is cut off at the band asked for
    const double share = phi ? std::clamp(k_surface_depth + 1.0 + *phi / spacing, 0.0, 1.0) : 0.0;
    if (share == 0.0) continue;
    double product = 0.0, square = 0.0;
    grid.for_each_range(target, kernel.R, [&](std::size_t begin, std::size_t end) {
      for (std::size_t q = begin; q < end; ++q) {
        const auto s = static_cast<std::size_t>(grid.order()[q]);
        double r2 = 0.0;
        for (std::size_t d = 0; d < D; ++d) r2 += (x[d][s] - target[d]) * (x[d][s] - target[d]);
        if (r2 >= kernel.R * kernel.R) continue;
        const double weight = particles.V[source[s]] * kernel.value(std::sqrt(r2));
        product += weight * depth[s] * (particles.p[source[s]] - p0);
        square += weight * depth[s] * depth[s];
      }
    });
    if (!(square > 0.0)) continue;
    const double constrained = p0 + *phi * product / square;
    samples.p[t] = share * constrained + (1.0 - share) * samples.p[t];
  }
}

template void constrain_pressure<2>(const Particles<2>&, const Layers<2>&, const SurfaceDistance<2>&, double,
                                    double, const coupler::Targets&, coupler::Samples&);
template void constrain_pressure<3>(const Particles<3>&, const Layers<3>&, const SurfaceDistance<3>&, double,
                                    double, const coupler::Targets&, coupler::Samples&);

}  // namespace littoral::sph
