#include "coupling/surface_distance.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace littoral::sph {

template <int D>
SurfaceDistance<D>::SurfaceDistance(const Particles<D>& particles, const Ghosts<D>& ghosts,
                                    double kernel_radius, double spacing, double band)
    : kernel_(kernel_radius), spacing_(spacing), band_(band) {
  std::array<std::vector<double>, D> normal = particles.normal;
  for (auto& component : normal) component.resize(particles.size());
  ghosts.refresh_vector(normal, particles.n_owned);
  std::vector<double> on_surface(particles.size());
  for (std::size_t i = 0; i < particles.n_owned; ++i)
    on_surface[i] = particles.surface[i] == SurfaceFlag::surface ? 1.0 : 0.0;
  ghosts.refresh_scalar(on_surface, particles.n_owned);
  for (std::size_t j = 0; j < particles.size(); ++j) {
    if (on_surface[j] == 0.0) continue;
    for (std::size_t d = 0; d < D; ++d) {
      x_[d].push_back(particles.x[d][j]);
      normal_[d].push_back(normal[d][j]);
    }
    id_.push_back(particles.id[j]);
  }
  if (!x_[0].empty()) grid_.bin(x_, x_[0].size(), band);
}

template <int D>
std::optional<double> SurfaceDistance<D>::at(const Point<D>& place) const {
  double nearest2 = band_ * band_;
  std::size_t nearest = x_[0].size();
  visit(place, band_, [&](std::size_t s, double r2) {
    if (r2 < nearest2 || (r2 == nearest2 && nearest < id_.size() && id_[s] < id_[nearest])) {
      nearest2 = r2;
      nearest = s;
    }
  });
  if (nearest == x_[0].size()) return std::nullopt;
  Point<D> centre;
  for (std::size_t d = 0; d < D; ++d) centre[d] = x_[d][nearest];
  struct Seen {
    std::int64_t id;
    double weight, value;
    bool operator<(const Seen& other) const {  // images share an id
      return std::tie(id, weight, value) < std::tie(other.id, other.weight, other.value);
    }
  };
  std::vector<Seen> seen;
  visit(centre, kernel_.R, [&](std::size_t s, double r2) {
    double distance = 0.0;  // (20), with the normal out of the water
    for (std::size_t d = 0; d < D; ++d) distance += (place[d] - x_[d][s]) * normal_[d][s];
    const double weight = kernel_.value(std::sqrt(r2));
    seen.push_back({id_[s], weight, weight * (distance - 0.5 * spacing_)});
  });
  std::sort(seen.begin(), seen.end());
  double sum = 0.0, weights = 0.0;
  for (const Seen& one : seen) {
    sum += one.value;
    weights += one.weight;
  }
  return sum / weights;
}

template class SurfaceDistance<2>;
template class SurfaceDistance<3>;

}  // namespace littoral::sph
