#include "bodies/wall_viscosity.hpp"

#include <algorithm>

#include "bodies/wall_view.hpp"
#include "physics/kernel.hpp"

namespace littoral::sph {

template <int D>
void add_wall_friction(const Particles<D>& particles, const Gradients<D>& gradients,
                       const std::vector<Body>& bodies, const Dummies<D>& dummies, const WallList<D>& list,
                       const Numerics<D>& numerics, const std::vector<char>& sticks, Rate<D>& rate,
                       RowForces<D>& forces) {
  const Kernel<D> kernel(numerics.kernel_radius);
  const double least = k_least_distance * k_least_distance * kernel.R * kernel.R;
  const double mu = numerics.eos.rho0 * numerics.viscosity;
  const bool linear = numerics.reconstruction != Reconstruction::first_order;
  forces.assign(list.n_rows() * sticks.size(), {});
  const auto n = static_cast<std::ptrdiff_t>(list.n_rows());
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t k = 0; k < n; ++k) {
    const auto row = static_cast<std::size_t>(k);
    const std::size_t i = list.particle(row);
    const auto x = at<D>(particles.x, i), u = at<D>(particles.u, i);
    WallView<D> view(bodies, dummies, list, row, x);
    for (std::size_t pair = list.begin(row); pair < list.end(row); ++pair) {
      const std::size_t e = list.dummy(pair);
      const auto body = static_cast<std::size_t>(dummies[e].body);
      if (!sticks[body]) continue;
      Vector<D> dx = dummies[e].x;
      for (std::size_t d = 0; d < D; ++d) dx[d] -= x[d];
      const double r2 = std::max(least, dot_of<D>(dx, dx));
      const double f = -dummies.volume() * kernel.slope_over_r(std::sqrt(r2));
      if (f == 0.0) continue;
      const auto wall = view.plane(e);
      double approach = 0.0;  // (u_w - u_i) . dx
      for (std::size_t d = 0; d < D; ++d) {
        double across = 0.0, to_wall = 0.0;
        if (linear) {
          const auto slope = at<D>(gradients.u[d], row);
          across = dot_of<D>(slope, dx);
          to_wall = wall.distance * dot_of<D>(slope, wall.n);
        }
        approach += dx[d] * (across + 2.0 * (wall.u[d] - u[d] - to_wall));
      }
      const double strength = 2.0 * (D + 2) * mu * particles.V[i] * f * approach / r2;
      auto& force = forces[row * sticks.size() + body];
      for (std::size_t d = 0; d < D; ++d) {
        force[d] -= strength * dx[d];
        rate.acceleration[d][i] += strength * dx[d] / particles.m[i];
      }
    }
  }
}

template void add_wall_friction<2>(const Particles<2>&, const Gradients<2>&, const std::vector<Body>&,
                                   const Dummies<2>&, const WallList<2>&, const Numerics<2>&,
                                   const std::vector<char>&, Rate<2>&, RowForces<2>&);
template void add_wall_friction<3>(const Particles<3>&, const Gradients<3>&, const std::vector<Body>&,
                                   const Dummies<3>&, const WallList<3>&, const Numerics<3>&,
                                   const std::vector<char>&, Rate<3>&, RowForces<3>&);

}  // namespace littoral::sph
