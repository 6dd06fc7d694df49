#include <gtest/gtest.h>

#include <cmath>

#include "clouds.hpp"
#include "physics/dynamics.hpp"

namespace littoral::sph {
namespace {

using Side = support::Scene::Side;

/// Metres, seconds and kilograms of the drop or basin in those of the reference; powers of two, so that a
/// solver without hidden units gives the same digits.
struct Units {
  double length = 1.0, time = 1.0, mass = 1.0;
};

/// A viscous column falls into a tank of symmetry planes with open top, disordered a little.
template <int D>
Particles<D> collapse(const Units& units, int n_steps, double& end) {
  const double L = units.length, T = units.time;
  Numerics<D> numerics;
  numerics.spacing = L;
  numerics.kernel_radius = (D == 2 ? 4.0 : 2.7) * L;
  numerics.skin = 0.3 * L;
  numerics.eos = {units.mass / std::pow(L, D), 40.0 * L / T, 3.0 * units.mass / (std::pow(L, D - 2) * T * T)};
  numerics.viscosity = 0.05 * L * L / T;
  numerics.gravity[D - 1] = -1.0 * L / (T * T);
  numerics.free_surface = true;
  numerics.reference_velocity = 2.0 * L / T;
  DomainBox<D> box;
  box.upper.fill(24.0 * L);
  for (auto& sides : box.sides) sides = {Side::symmetry, Side::symmetry};
  box.sides[D - 1][1] = Side::open;
  std::array<int, D> n;
  n.fill(D == 2 ? 12 : 6);
  auto particles = test::cloud<D>(n, 1.0, 0.1);
  for (std::size_t i = 0; i < particles.n_owned; ++i) {
    for (auto& column : particles.x) column[i] *= L;
    particles.V[i] = std::pow(L, D);
    particles.m[i] = units.mass;
    particles.rho[i] = numerics.eos.rho0;
    particles.p[i] = numerics.eos.p0;
  }
  Dynamics<D> dynamics(numerics, box);
  double t = 0.0;
  for (int k = 0; k < n_steps; ++k) {
    const double dt = dynamics.stable_time_step();
    dynamics.step(particles, t, dt, nullptr);
    t += dt;
  }
  end = t;
  return particles;
}

template <int D>
void expect_same_flow(const Units& units, int n_steps) {
  double end = 0.0, scaled_end = 0.0;
  const auto metre = collapse<D>({}, n_steps, end), scaled = collapse<D>(units, n_steps, scaled_end);
  EXPECT_EQ(scaled_end, end * units.time);
  std::size_t different = 0;
  for (std::size_t i = 0; i < metre.n_owned; ++i)
    for (std::size_t d = 0; d < D; ++d)
      different += scaled.x[d][i] != metre.x[d][i] * units.length ||
                   scaled.u[d][i] != metre.u[d][i] * units.length / units.time ||
                   scaled.surface[i] != metre.surface[i];
  EXPECT_EQ(different, 0u);
}

TEST(UnitsTest, AMillimetreDropAndAKilometreBasinAreTheSameFlow) {
  constexpr Units k_drop{1.0 / 1024, 1.0 / 32, 1.0 / (1 << 30)}, k_basin{1024.0, 32.0, 1073741824.0};
  for (const Units& units : {k_drop, k_basin}) {
    expect_same_flow<2>(units, 60);
    expect_same_flow<3>(units, 20);
  }
}

TEST(UnitsTest, DensityIsOnlyAFactor) {
  for (const double mass : {1.0 / 1024, 1024.0 * 1024}) expect_same_flow<2>({1.0, 1.0, mass}, 60);
}

}  // namespace
}  // namespace littoral::sph
