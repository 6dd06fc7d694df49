#include "pairs/pair_columns.hpp"
#include "physics/kernel.hpp"
#include "physics/term.hpp"

namespace littoral::sph {
namespace {

template <int D>
std::array<double, D> sum_pairs(const Particles<D>& particles, const Kernel<D>& kernel, std::size_t i,
                                const std::int32_t* list, std::size_t count) {
  using Vector = Lanes<double>;
  const Vector least = broadcast(k_least_distance * kernel.R);
  Vector force[D] = {};
  for_each_group<double>(list, count, i, [&](const std::int32_t* j) {
    Vector x[D], approach = {};
    const Vector r = largest(distances(particles, i, j, x), least);
    for (std::size_t d = 0; d < D; ++d)
      approach += (gather(particles.u[d].data(), j) - particles.u[d][i]) * x[d];
    const Vector q = largest(1.0 - r * kernel.inv_R, Vector{});
    const Vector f = gather(particles.V.data(), j) * (q * q * q) * approach / (r * r);
    for (std::size_t d = 0; d < D; ++d) force[d] += f * x[d];
  });
  std::array<double, D> total;
  for (std::size_t d = 0; d < D; ++d) total[d] = -kernel.slope * sum(force[d]);
  return total;
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
