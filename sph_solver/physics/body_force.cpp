#include "physics/term.hpp"

namespace littoral::sph {

template <int D>
void BodyForce<D>::add(const Particles<D>& particles, const NeighborList<D>&, double t, Rate<D>& rate) const {
  const auto n = static_cast<std::ptrdiff_t>(particles.n_owned);
#pragma omp parallel
  {
    const Field mine = field_;  // a formula remembers its arguments: each thread needs its own
#pragma omp for schedule(static)
    for (std::ptrdiff_t row = 0; row < n; ++row) {
      const auto i = static_cast<std::size_t>(row);
      const double x = particles.x[0][i], z = particles.x[D - 1][i];
      const double y = D == 3 ? particles.x[1][i] : 0.0;
      for (std::size_t d = 0; d < D; ++d) rate.acceleration[d][i] += mine[d](x, y, z, t);
    }
  }
}

template class BodyForce<2>;
template class BodyForce<3>;

}  // namespace littoral::sph
