#include "bodies/wall_gradients.hpp"

#include "bodies/wall_view.hpp"
#include "physics/kernel.hpp"
#include "physics/symmetric_matrix.hpp"

namespace littoral::sph {
namespace {

constexpr double k_least_eigenvalue = 0.05;  // as in (S3): below it the inverse amplifies noise

template <int D>
void add_outer(SymmetricMatrix<D>& B, double f, const Vector<D>& x) {
  std::size_t k = 0;
  for (std::size_t a = 0; a < D; ++a)
    for (std::size_t b = a; b < D; ++b) B.a[k++] += f * x[a] * x[b];
}

}  // namespace

template <int D>
void correct_gradients(const Particles<D>& particles, const NeighborList<D>& neighbors,
                       const Dummies<D>& dummies, const WallList<D>& list,
                       const RowAccelerations<D>& mass_force, Gradients<D>& gradients) {
  const Kernel<D> kernel(neighbors.kernel_radius());
  const auto n = static_cast<std::ptrdiff_t>(list.n_rows());
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t k = 0; k < n; ++k) {
    const auto row = static_cast<std::size_t>(k);
    const std::size_t i = list.particle(row);
    const auto x = at<D>(particles.x, i);
    SymmetricMatrix<D> B;
    Vector<D> slope{};
    for (std::size_t pair = neighbors.start()[i]; pair < neighbors.start()[i + 1]; ++pair) {
      const auto j = static_cast<std::size_t>(neighbors.list()[pair]);
      Vector<D> dx = at<D>(particles.x, j);
      for (std::size_t d = 0; d < D; ++d) dx[d] -= x[d];
      const double f = -particles.V[j] * kernel.slope_over_r(std::sqrt(dot_of<D>(dx, dx)));
      add_outer<D>(B, f, dx);
      for (std::size_t d = 0; d < D; ++d) slope[d] += f * (particles.p[j] - particles.p[i]) * dx[d];
    }
    WallView<D> view(dummies, list, row, x);
    for (std::size_t pair = list.begin(row); pair < list.end(row); ++pair) {
      const std::size_t e = list.dummy(pair);
      Vector<D> dx = at<D>(dummies.x, e);
      for (std::size_t d = 0; d < D; ++d) dx[d] -= x[d];
      const double f = -dummies.volume() * kernel.slope_over_r(std::sqrt(dot_of<D>(dx, dx)));
      if (f == 0.0) continue;
      const auto wall = view.plane(e);
      const double along = dot_of<D>(dx, wall.n), weight = f * along * along;
      const double known =
          particles.rho[i] * (dot_of<D>(mass_force[row], wall.n) - dot_of<D>(wall.a, wall.n));
      add_outer<D>(B, weight, wall.n);
      for (std::size_t d = 0; d < D; ++d) slope[d] += weight * known * wall.n[d];
    }
    SymmetricMatrix<D> L;
    if (B.least_eigenvalue_at_least() > k_least_eigenvalue) L = B.inverse();
    const auto gradient = L * slope;
    for (std::size_t d = 0; d < D; ++d) gradients.p[d][i] = gradient[d];
  }
}

template void correct_gradients<2>(const Particles<2>&, const NeighborList<2>&, const Dummies<2>&,
                                   const WallList<2>&, const RowAccelerations<2>&, Gradients<2>&);
template void correct_gradients<3>(const Particles<3>&, const NeighborList<3>&, const Dummies<3>&,
                                   const WallList<3>&, const RowAccelerations<3>&, Gradients<3>&);

}  // namespace littoral::sph
