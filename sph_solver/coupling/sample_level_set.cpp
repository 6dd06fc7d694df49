#include <array>
#include <cmath>
#include <vector>

#include "coupling/samples.hpp"
#include "neighbors/cell_grid.hpp"
#include "physics/kernel.hpp"

namespace littoral::sph {

template <int D>
void sample_level_set(const Particles<D>& particles, const Ghosts<D>& ghosts, const SampleRules& rules,
                      double spacing, double band, const coupler::Targets& targets,
                      coupler::Samples& samples) {
  const Kernel<D> kernel(rules.kernel_radius);
  std::array<std::vector<double>, D> x;
  std::vector<std::size_t> source;
  std::array<std::vector<double>, D> normal = particles.normal;
  for (auto& component : normal) component.resize(particles.size());
  ghosts.refresh_vector(normal, particles.n_owned);
  std::vector<double> on_surface(particles.size());
  for (std::size_t i = 0; i < particles.n_owned; ++i)
    on_surface[i] = particles.surface[i] == SurfaceFlag::surface ? 1.0 : 0.0;
  ghosts.refresh_scalar(on_surface, particles.n_owned);
  for (std::size_t j = 0; j < particles.size(); ++j) {
    if (on_surface[j] == 0.0) continue;
    for (std::size_t d = 0; d < D; ++d) x[d].push_back(particles.x[d][j]);
    source.push_back(j);
  }
  CellGrid<D> grid;
  if (!source.empty()) grid.bin(x, source.size(), band);
  const auto visit = [&](const Point<D>& place, double radius, const auto& f) {
    if (source.empty()) return;
    grid.for_each_range(place, radius, [&](std::size_t begin, std::size_t end) {
      for (std::size_t q = begin; q < end; ++q) {
        const auto s = static_cast<std::size_t>(grid.order()[q]);
        double r2 = 0.0;
        for (std::size_t d = 0; d < D; ++d) r2 += (x[d][s] - place[d]) * (x[d][s] - place[d]);
        if (r2 < radius * radius) f(s, r2);
      }
    });
  };

  const auto n = static_cast<std::ptrdiff_t>(targets.size());
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t k = 0; k < n; ++k) {
    const auto t = static_cast<std::size_t>(k);
    if ((targets.wants[t] & coupler::wants_phi) == 0) continue;
    const Point<D> target = from_vec3<D>({targets.x[t], targets.y[t], targets.z[t]});
    double nearest2 = band * band;
    std::size_t nearest = source.size();
    visit(target, band, [&](std::size_t s, double r2) {
      if (r2 < nearest2) {
        nearest2 = r2;
        nearest = s;
      }
    });
    if (nearest == source.size()) {
      samples.phi[t] = samples.coverage[t] > 0.5 ? -band : band;
      continue;
    }
    double sum = 0.0, weights = 0.0;
    visit(at<D>(x, nearest), kernel.R, [&](std::size_t s, double r2) {
      double distance = 0.0;  // (20), with the normal out of the water
      for (std::size_t d = 0; d < D; ++d) distance += (target[d] - x[d][s]) * normal[d][source[s]];
      const double weight = kernel.value(std::sqrt(r2));
      sum += weight * (distance - 0.5 * spacing);
      weights += weight;
    });
    samples.phi[t] = sum / weights;
  }
}

template void sample_level_set<2>(const Particles<2>&, const Ghosts<2>&, const SampleRules&, double, double,
                                  const coupler::Targets&, coupler::Samples&);
template void sample_level_set<3>(const Particles<3>&, const Ghosts<3>&, const SampleRules&, double, double,
                                  const coupler::Targets&, coupler::Samples&);

}  // namespace littoral::sph
