#include "bodies/wall_gradients.hpp"

#include "bodies/wall_view.hpp"
#include "physics/kernel.hpp"

namespace littoral::sph {
namespace {

template <int D>
void add_outer(SymmetricMatrix<D>& B, double f, const Vector<D>& x) {
  std::size_t k = 0;
  for (std::size_t a = 0; a < D; ++a)
    for (std::size_t b = a; b < D; ++b) B.a[k++] += f * x[a] * x[b];
}

}  // namespace

template <int D>
void find_known_slopes(const Particles<D>& particles, const std::vector<Body>& bodies,
                       const Dummies<D>& dummies, const WallList<D>& list,
                       const RowAccelerations<D>& mass_force, double kernel_radius, KnownSlopes<D>& known) {
  const Kernel<D> kernel(kernel_radius);
  const double R2 = kernel.R * kernel.R;
  known.row_of = list.rows_of().data();
  known.B.assign(list.n_rows(), {});
  known.slope.assign(list.n_rows(), {});
  const auto n = static_cast<std::ptrdiff_t>(list.n_rows());
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t k = 0; k < n; ++k) {
    const auto row = static_cast<std::size_t>(k);
    const std::size_t i = list.particle(row);
    const auto x = at<D>(particles.x, i);
    WallView<D> view(bodies, dummies, list, row, x);
    for (std::size_t pair = list.begin(row); pair < list.end(row); ++pair) {
      const std::size_t e = list.dummy(pair);
      Vector<D> dx = dummies[e].x;
      for (std::size_t d = 0; d < D; ++d) dx[d] -= x[d];
      const double r2 = dot_of<D>(dx, dx);
      if (r2 >= R2) continue;                                                   // most pairs of the skin
      const double f = -dummies.volume() * kernel.slope_over_r(std::sqrt(r2));  // V grad W = f dx
      const auto wall = view.plane(e);
      const double along = dot_of<D>(dx, wall.n), weight = f * along * along;
      const double slope =
          particles.rho[i] * (dot_of<D>(mass_force[row], wall.n) - dot_of<D>(wall.a, wall.n));
      add_outer<D>(known.B[row], weight, wall.n);
      for (std::size_t d = 0; d < D; ++d) known.slope[row][d] += weight * slope * wall.n[d];
    }
  }
}

template void find_known_slopes<2>(const Particles<2>&, const std::vector<Body>&, const Dummies<2>&,
                                   const WallList<2>&, const RowAccelerations<2>&, double, KnownSlopes<2>&);
template void find_known_slopes<3>(const Particles<3>&, const std::vector<Body>&, const Dummies<3>&,
                                   const WallList<3>&, const RowAccelerations<3>&, double, KnownSlopes<3>&);

}  // namespace littoral::sph
