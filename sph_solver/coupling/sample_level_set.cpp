#include <cmath>

#include "coupling/samples.hpp"
#include "coupling/surface_distance.hpp"

namespace littoral::sph {

template <int D>
void sample_level_set(const SurfaceDistance<D>& surface, double band, const coupler::Targets& targets,
                      coupler::Samples& samples) {
  const auto n = static_cast<std::ptrdiff_t>(targets.size());
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t k = 0; k < n; ++k) {
    const auto t = static_cast<std::size_t>(k);
    if ((targets.wants[t] & coupler::wants_phi) == 0) continue;
    const auto phi = surface.at(from_vec3<D>({targets.x[t], targets.y[t], targets.z[t]}));
    samples.phi[t] = phi && std::fabs(*phi) < band ? *phi : samples.coverage[t] > 0.5 ? -band : band;
  }
}

template void sample_level_set<2>(const SurfaceDistance<2>&, double, const coupler::Targets&,
                                  coupler::Samples&);
template void sample_level_set<3>(const SurfaceDistance<3>&, double, const coupler::Targets&,
                                  coupler::Samples&);

}  // namespace littoral::sph
