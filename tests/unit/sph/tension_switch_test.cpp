#include <gtest/gtest.h>

#include "clouds.hpp"
#include "neighbors/neighbor_list.hpp"
#include "physics/riemann_fluxes.hpp"
#include "physics/term.hpp"

namespace littoral::sph {
namespace {

constexpr double k_p0 = 3.0;

/// Accelerations of a disordered periodic-like block under the uniform pressure p, far from its edge.
template <int D>
double largest_acceleration(double p, bool switched, SurfaceFlag flag = SurfaceFlag::none) {
  std::array<int, D> n;
  n.fill(D == 2 ? 16 : 10);
  const double radius = D == 2 ? 4.0 : 2.7;
  auto particles = test::cloud<D>(n, 1.0, 0.2);
  std::fill(particles.p.begin(), particles.p.end(), p);
  std::fill(particles.surface.begin(), particles.surface.end(), flag);
  NeighborList<D> neighbors(radius, 0.1);
  neighbors.build(particles);
  Rate<D> rate;
  riemann_fluxes(particles, neighbors, Gradients<D>{}, LinearEos{1.0, 10.0, k_p0},
                 Reconstruction::first_order, RiemannSolver::linearised, rate);
  if (switched) TensionSwitch<D>(k_p0).add(particles, neighbors, 0.0, rate);
  double most = 0.0;
  for (std::size_t i = 0; i < particles.n_owned; ++i)
    for (std::size_t d = 0; d < D; ++d) most = std::max(most, std::fabs(rate.acceleration[d][i]));
  return most;
}

/// (11) draws neighbours under a uniform tension together; with p_j - p_i there is no force.
template <int D>
void expect_no_force_from_uniform_tension() {
  EXPECT_GT(largest_acceleration<D>(k_p0 - 2.0, false), 0.1);
  EXPECT_LT(largest_acceleration<D>(k_p0 - 2.0, true), 1e-12);
}

TEST(TensionSwitchTest, UniformTensionDoesNotMoveParticles) {
  expect_no_force_from_uniform_tension<2>();
  expect_no_force_from_uniform_tension<3>();
}

TEST(TensionSwitchTest, LeavesPressureAndTheSurfaceAlone) {
  EXPECT_EQ(largest_acceleration<2>(k_p0 + 2.0, true), largest_acceleration<2>(k_p0 + 2.0, false));
  for (const auto flag : {SurfaceFlag::near, SurfaceFlag::surface})
    EXPECT_EQ(largest_acceleration<2>(k_p0 - 2.0, true, flag), largest_acceleration<2>(k_p0 - 2.0, false));
}

}  // namespace
}  // namespace littoral::sph
