#include <gtest/gtest.h>

#include <cmath>

#include "clouds.hpp"
#include "physics/dynamics.hpp"

namespace littoral::sph {
namespace {

template <int D>
Numerics<D> free_numerics() {
  Numerics<D> numerics;
  numerics.eos = {1.0, 10.0, 0.0};
  numerics.spacing = 1.0;
  numerics.kernel_radius = D == 2 ? 4.0 : 2.7;
  numerics.skin = 0.3;
  numerics.viscosity = 0.01;
  numerics.free_surface = true;
  numerics.reference_velocity = 1.0;
  return numerics;
}

template <int D>
DomainBox<D> open_box(double length) {
  DomainBox<D> box;
  box.lower.fill(-length);
  box.upper.fill(length);
  return box;
}

template <int D>
void expect_parabola() {
  auto numerics = free_numerics<D>();
  numerics.gravity[D - 1] = -2.0;
  std::array<int, D> one;
  one.fill(1);
  auto particles = test::cloud<D>(one, 1.0);
  particles.u[0][0] = 3.0;
  Dynamics<D> dynamics(numerics, open_box<D>(100.0));
  for (int k = 0; k < 100; ++k) dynamics.step(particles, 0.02 * k, 0.02, nullptr);
  EXPECT_NEAR(particles.x[0][0], 0.5 + 6.0, 1e-12);
  EXPECT_NEAR(particles.x[D - 1][0], 0.5 - 4.0, 1e-12);
  EXPECT_EQ(particles.V[0], 1.0);
}

TEST(FewParticlesTest, OneFliesOnAParabola) {
  expect_parabola<2>();
  expect_parabola<3>();
}

/// One row, drawn out along itself to twice its length and pushed together again: its ends fly as they should
/// within what a row of particles can resist.
TEST(FewParticlesTest, OneRowStaysOneRow) {
  auto particles = test::cloud<2>({40, 1}, 1.0);
  for (std::size_t i = 0; i < particles.n_owned; ++i) particles.u[0][i] = 0.02 * (particles.x[0][i] - 20.0);
  Dynamics<2> dynamics(free_numerics<2>(), open_box<2>(200.0));
  for (int k = 0; k < 1000; ++k) dynamics.step(particles, 0.05 * k, 0.05, nullptr);
  double momentum = 0.0;
  for (std::size_t i = 0; i < particles.n_owned; ++i) {
    EXPECT_NEAR(particles.x[1][i], 0.5, 1e-9);
    EXPECT_TRUE(std::isfinite(particles.x[0][i]) && particles.V[i] > 0.0);
    momentum += particles.m[i] * particles.u[0][i];
  }
  EXPECT_NEAR(momentum, 0.0, 1e-12);
}

/// Two particles a millionth of the spacing apart, and two at the same place: pushed apart or left together,
/// but finite.
TEST(FewParticlesTest, CoincidentParticlesStayFinite) {
  for (const double apart : {1e-6, 0.0}) {
    auto particles = test::cloud<2>({6, 6}, 1.0);
    particles.x[0][14] = particles.x[0][15] + apart;
    particles.x[1][14] = particles.x[1][15];
    Dynamics<2> dynamics(free_numerics<2>(), open_box<2>(100.0));
    for (int k = 0; k < 200; ++k) dynamics.step(particles, 0.05 * k, 0.05, nullptr);
    for (std::size_t i = 0; i < particles.n_owned; ++i)
      EXPECT_TRUE(std::isfinite(particles.x[0][i]) && std::fabs(particles.u[0][i]) < 10.0) << apart;
  }
}

/// A body of water and a splash a million spacings away along every axis: both as if alone, and as fast.
TEST(FewParticlesTest, ASplashAMillionSpacingsAwayChangesNothing) {
  const auto run = [](bool with_splash) {
    auto particles = test::cloud<2>({10, 10}, 1.0, 0.1);
    if (with_splash) {
      NewParticle<2> far;
      far.x = {1e6, -1e6};
      far.V = far.m = 1.0;
      particles.append(far);
    }
    Dynamics<2> dynamics(free_numerics<2>(), open_box<2>(2e6));
    for (int k = 0; k < 50; ++k) dynamics.step(particles, 0.05 * k, 0.05, nullptr);
    std::vector<double> x(particles.n_owned);
    for (std::size_t i = 0; i < particles.n_owned; ++i)
      x[static_cast<std::size_t>(particles.id[i])] = particles.x[0][i];
    return x;
  };
  const auto alone = run(false), with = run(true);
  for (std::size_t i = 0; i < alone.size(); ++i) EXPECT_NEAR(with[i], alone[i], 1e-12);
  EXPECT_EQ(with.back(), 1e6);
}

}  // namespace
}  // namespace littoral::sph
