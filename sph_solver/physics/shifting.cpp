#include "physics/shifting.hpp"

#include <cmath>

#include "physics/kernel.hpp"

namespace littoral::sph {
namespace {

constexpr double k_longest = 0.25;  // of U, (14)

std::array<double, 2> sum_pairs(const Particles<2>& particles, const Kernel<2>& kernel, std::size_t i,
                                const std::int32_t* __restrict list, std::size_t count) {
  const double* __restrict x = particles.x[0].data();
  const double* __restrict z = particles.x[1].data();
  const double xi = x[i], zi = z[i], inv_R = kernel.inv_R;
  double sx = 0, sz = 0;
#pragma omp simd reduction(+ : sx, sz)
  for (std::size_t k = 0; k < count; ++k) {
    const std::int32_t j = list[k];
    const double dx = x[j] - xi, dz = z[j] - zi;
    const double s = 1.0 - std::sqrt(dx * dx + dz * dz) * inv_R;
    const double q = s > 0.0 ? s : 0.0;
    sx += q * q * q * dx;
    sz += q * q * q * dz;
  }
  return {-kernel.slope * sx, -kernel.slope * sz};
}

std::array<double, 3> sum_pairs(const Particles<3>& particles, const Kernel<3>& kernel, std::size_t i,
                                const std::int32_t* __restrict list, std::size_t count) {
  const double* __restrict x = particles.x[0].data();
  const double* __restrict y = particles.x[1].data();
  const double* __restrict z = particles.x[2].data();
  const double xi = x[i], yi = y[i], zi = z[i], inv_R = kernel.inv_R;
  double sx = 0, sy = 0, sz = 0;
#pragma omp simd reduction(+ : sx, sy, sz)
  for (std::size_t k = 0; k < count; ++k) {
    const std::int32_t j = list[k];
    const double dx = x[j] - xi, dy = y[j] - yi, dz = z[j] - zi;
    const double s = 1.0 - std::sqrt(dx * dx + dy * dy + dz * dz) * inv_R;
    const double q = s > 0.0 ? s : 0.0;
    sx += q * q * q * dx;
    sy += q * q * q * dy;
    sz += q * q * q * dz;
  }
  return {-kernel.slope * sx, -kernel.slope * sy, -kernel.slope * sz};
}

}  // namespace

template <int D>
Shifting<D>::Shifting(double reference_velocity, double spacing)
    : velocity_(reference_velocity), nominal_volume_(std::pow(spacing, D)) {}

template <int D>
void Shifting<D>::compute(Particles<D>& particles, const NeighborList<D>& neighbors,
                          const SurfaceDetection<D>* surface) const {
  const Kernel<D> kernel(neighbors.kernel_radius());
  const auto n = static_cast<std::ptrdiff_t>(particles.n_owned);
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t row = 0; row < n; ++row) {
    const auto i = static_cast<std::size_t>(row);
    const std::size_t begin = neighbors.start()[i];
    auto crowding =
        sum_pairs(particles, kernel, i, neighbors.list() + begin, neighbors.start()[i + 1] - begin);
    double length = 0.0;
    for (double& component : crowding) {
      component *= kernel.R * nominal_volume_;
      length += component * component;
    }
    length = std::sqrt(length);
    const double factor = -velocity_ * (length > k_longest ? k_longest / length : 1.0);
    for (std::size_t d = 0; d < D; ++d) particles.shift[d][i] = factor * crowding[d];
  }
  if (surface == nullptr) return;
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t row = 0; row < n; ++row) {
    const auto i = static_cast<std::size_t>(row);
    if (particles.surface[i] == SurfaceFlag::none) continue;
    double outward = 0.0;
    for (std::size_t d = 0; d < D; ++d) outward += particles.shift[d][i] * particles.normal[d][i];
    const double ramp = surface->distance()[i];
    for (std::size_t d = 0; d < D; ++d)
      particles.shift[d][i] = ramp * (particles.shift[d][i] - outward * particles.normal[d][i]);
  }
}

template class Shifting<2>;
template class Shifting<3>;

}  // namespace littoral::sph
