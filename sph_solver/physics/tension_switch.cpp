#include "physics/kernel.hpp"
#include "physics/term.hpp"

namespace littoral::sph {
namespace {

/// sum_j V_j grad W_ij
template <int D>
std::array<double, D> unevenness(const Particles<D>& particles, const Kernel<D>& kernel, std::size_t i,
                                 const std::int32_t* list, std::size_t count) {
  std::array<double, D> sum{};
  for (std::size_t k = 0; k < count; ++k) {
    const auto j = static_cast<std::size_t>(list[k]);
    std::array<double, D> x;
    double r2 = 0.0;
    for (std::size_t d = 0; d < D; ++d) {
      x[d] = particles.x[d][j] - particles.x[d][i];
      r2 += x[d] * x[d];
    }
    const double f = -particles.V[j] * kernel.slope_over_r(std::sqrt(r2));
    for (std::size_t d = 0; d < D; ++d) sum[d] += f * x[d];
  }
  return sum;
}

}  // namespace

template <int D>
void TensionSwitch<D>::add(const Particles<D>& particles, const NeighborList<D>& neighbors, double,
                           Rate<D>& rate) const {
  const Kernel<D> kernel(neighbors.kernel_radius());
  const auto n = static_cast<std::ptrdiff_t>(particles.n_owned);
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t row = 0; row < n; ++row) {
    const auto i = static_cast<std::size_t>(row);
    const double tension = p0_ - particles.p[i];
    if (tension <= 0.0 || particles.surface[i] != SurfaceFlag::none) continue;
    const std::size_t begin = neighbors.start()[i];
    const auto sum =
        unevenness(particles, kernel, i, neighbors.list() + begin, neighbors.start()[i + 1] - begin);
    const double factor = -2.0 * particles.V[i] / particles.m[i] * tension;
    for (std::size_t d = 0; d < D; ++d) rate.acceleration[d][i] += factor * sum[d];
  }
}

template class TensionSwitch<2>;
template class TensionSwitch<3>;

}  // namespace littoral::sph
