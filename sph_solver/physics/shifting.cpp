#include "physics/shifting.hpp"

#include <cmath>

#include "pairs/pair_columns.hpp"
#include "physics/kernel.hpp"

namespace littoral::sph {
namespace {

constexpr double k_longest = 0.25;  // of U, (14)

template <int D>
std::array<double, D> sum_pairs(const Particles<D>& particles, const Kernel<D>& kernel, std::size_t i,
                                const std::int32_t* list, std::size_t count) {
  using Vector = Lanes<double>;
  Vector crowding[D] = {};
  for_each_group<double>(list, count, i, [&](const std::int32_t* j) {
    Vector x[D];
    const Vector r = distances(particles, i, j, x);
    const Vector q = largest(1.0 - r * kernel.inv_R, Vector{});
    const Vector f = gather(particles.V.data(), j) * (q * q * q);
    for (std::size_t d = 0; d < D; ++d) crowding[d] += f * x[d];
  });
  std::array<double, D> total;
  for (std::size_t d = 0; d < D; ++d) total[d] = -kernel.slope * sum(crowding[d]);
  return total;
}

}  // namespace

template <int D>
void Shifting<D>::compute(Particles<D>& particles, const NeighborList<D>& neighbors,
                          const SurfaceDetection<D>* surface, const WallSupport<D>* walls,
                          bool crowding_known) const {
  const Kernel<D> kernel(neighbors.kernel_radius());
  const auto n = static_cast<std::ptrdiff_t>(particles.n_owned);
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t row = 0; row < n; ++row) {
    const auto i = static_cast<std::size_t>(row);
    const std::size_t begin = neighbors.start()[i];
    std::array<double, D> crowding;
    for (std::size_t d = 0; d < D; ++d) crowding[d] = particles.shift[d][i];
    if (!crowding_known)
      crowding = sum_pairs(particles, kernel, i, neighbors.list() + begin, neighbors.start()[i + 1] - begin);
    double length = 0.0;
    const auto by_walls = walls ? walls->crowding(i) : std::array<double, D>{};
    for (std::size_t d = 0; d < D; ++d) {
      crowding[d] = kernel.R * (crowding[d] + by_walls[d]);
      length += crowding[d] * crowding[d];
    }
    length = std::sqrt(length);
    const double factor = -velocity_ * (length > k_longest ? k_longest / length : 1.0);
    for (std::size_t d = 0; d < D; ++d) particles.shift[d][i] = factor * crowding[d];
  }
  if (surface != nullptr) restrict_to_surface(particles, *surface);
  if (walls == nullptr) return;
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t row = 0; row < n; ++row) {
    const auto i = static_cast<std::size_t>(row);
    std::array<double, D> shift;
    for (std::size_t d = 0; d < D; ++d) shift[d] = particles.shift[d][i];
    walls->keep_off(i, shift);
    for (std::size_t d = 0; d < D; ++d) particles.shift[d][i] = shift[d];
  }
}

template <int D>
void Shifting<D>::restrict_to_surface(Particles<D>& particles, const SurfaceDetection<D>& surface) const {
  const auto n = static_cast<std::ptrdiff_t>(particles.n_owned);
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t row = 0; row < n; ++row) {
    const auto i = static_cast<std::size_t>(row);
    if (particles.surface[i] == SurfaceFlag::none) continue;
    double outward = 0.0;
    for (std::size_t d = 0; d < D; ++d) outward += particles.shift[d][i] * particles.normal[d][i];
    const double ramp = surface.distance()[i];
    for (std::size_t d = 0; d < D; ++d)
      particles.shift[d][i] = ramp * (particles.shift[d][i] - outward * particles.normal[d][i]);
  }
}

template class Shifting<2>;
template class Shifting<3>;

}  // namespace littoral::sph
