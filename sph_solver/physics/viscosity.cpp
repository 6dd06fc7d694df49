#include "physics/kernel.hpp"
#include "physics/term.hpp"

namespace littoral::sph {
namespace {

constexpr double k_least_distance = 1e-9;  // of R; keeps 1/r^2 finite for coincident particles

std::array<double, 2> sum_pairs(const Particles<2>& particles, const Kernel<2>& kernel, std::size_t i,
                                const std::int32_t* __restrict list, std::size_t count) {
  const double* __restrict x = particles.x[0].data();
  const double* __restrict z = particles.x[1].data();
  const double* __restrict u = particles.u[0].data();
  const double* __restrict w = particles.u[1].data();
  const double* __restrict V = particles.V.data();
  const double xi = x[i], zi = z[i], ui = u[i], wi = w[i];
  const double inv_R = kernel.inv_R, slope = -kernel.slope;
  const double least = k_least_distance * k_least_distance * kernel.R * kernel.R;
  double fx = 0, fz = 0;
#pragma omp simd reduction(+ : fx, fz)
  for (std::size_t k = 0; k < count; ++k) {
    const std::int32_t j = list[k];
    const double dx = x[j] - xi, dz = z[j] - zi;
    const double rr = dx * dx + dz * dz;
    const double r2 = rr > least ? rr : least;
    const double s = 1.0 - std::sqrt(r2) * inv_R;
    const double q = s > 0.0 ? s : 0.0;
    const double approach = (u[j] - ui) * dx + (w[j] - wi) * dz;
    const double f = slope * V[j] * q * q * q * approach / r2;
    fx += f * dx;
    fz += f * dz;
  }
  return {fx, fz};
}

std::array<double, 3> sum_pairs(const Particles<3>& particles, const Kernel<3>& kernel, std::size_t i,
                                const std::int32_t* __restrict list, std::size_t count) {
  const double* __restrict x = particles.x[0].data();
  const double* __restrict y = particles.x[1].data();
  const double* __restrict z = particles.x[2].data();
  const double* __restrict u = particles.u[0].data();
  const double* __restrict v = particles.u[1].data();
  const double* __restrict w = particles.u[2].data();
  const double* __restrict V = particles.V.data();
  const double xi = x[i], yi = y[i], zi = z[i], ui = u[i], vi = v[i], wi = w[i];
  const double inv_R = kernel.inv_R, slope = -kernel.slope;
  const double least = k_least_distance * k_least_distance * kernel.R * kernel.R;
  double fx = 0, fy = 0, fz = 0;
#pragma omp simd reduction(+ : fx, fy, fz)
  for (std::size_t k = 0; k < count; ++k) {
    const std::int32_t j = list[k];
    const double dx = x[j] - xi, dy = y[j] - yi, dz = z[j] - zi;
    const double rr = dx * dx + dy * dy + dz * dz;
    const double r2 = rr > least ? rr : least;
    const double s = 1.0 - std::sqrt(r2) * inv_R;
    const double q = s > 0.0 ? s : 0.0;
    const double approach = (u[j] - ui) * dx + (v[j] - vi) * dy + (w[j] - wi) * dz;
    const double f = slope * V[j] * q * q * q * approach / r2;
    fx += f * dx;
    fy += f * dy;
    fz += f * dz;
  }
  return {fx, fy, fz};
}

}  // namespace

template <int D>
void Viscosity<D>::add(const Particles<D>& particles, const NeighborList<D>& neighbors, double,
                       Rate<D>& rate) const {
  const Kernel<D> kernel(neighbors.kernel_radius());
  const auto n = static_cast<std::ptrdiff_t>(particles.n_owned);
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t row = 0; row < n; ++row) {
    const auto i = static_cast<std::size_t>(row);
    const std::size_t begin = neighbors.start()[i];
    const auto sum =
        sum_pairs(particles, kernel, i, neighbors.list() + begin, neighbors.start()[i + 1] - begin);
    const double factor = 2.0 * (D + 2) * mu_ * particles.V[i] / particles.m[i];
    for (std::size_t d = 0; d < D; ++d) rate.acceleration[d][i] += factor * sum[d];
  }
}

template class Viscosity<2>;
template class Viscosity<3>;

}  // namespace littoral::sph
