#include "io/gauges.hpp"

#include <gtest/gtest.h>

#include "clouds.hpp"
#include "littoral/error.hpp"
#include "particles/lattice.hpp"

namespace littoral::sph {
namespace {

TEST(GaugesTest, PointValuesAreExactForLinearFieldsAlsoBesideTheEdge) {
  auto particles = test::cloud<2>({14, 14}, 1.0, 0.3);
  for (std::size_t i = 0; i < particles.n_owned; ++i) {
    particles.p[i] = 1.0 + 2.0 * particles.x[0][i] - 3.0 * particles.x[1][i];
    particles.u[1][i] = particles.x[0][i];
  }
  NeighborList<2> neighbors(4.0, 0.1);
  neighbors.build(particles);
  for (const auto& x : {std::array<double, 2>{7.2, 6.9}, {3.3, 13.9}, {0.2, 0.1}}) {
    const auto value = value_at<2>(particles, neighbors, x);
    ASSERT_TRUE(value);
    EXPECT_NEAR(value->p, 1.0 + 2.0 * x[0] - 3.0 * x[1], 1e-10);
    EXPECT_NEAR(value->u[1], x[0], 1e-10);
  }
  EXPECT_FALSE((value_at<2>(particles, neighbors, {50.0, 7.0})));
}

TEST(GaugesTest, ElevationFindsAPlaneSurface) {
  auto particles = test::cloud<2>({20, 12}, 1.0);
  NeighborList<2> neighbors(4.0, 0.1);
  neighbors.build(particles);
  const auto level = elevation_at<2>(particles, neighbors, {10.0, 0.0}, 1.0);
  ASSERT_TRUE(level);
  EXPECT_NEAR(*level, 12.0, 0.02);  // a lattice is no continuum: .02 dx
  EXPECT_FALSE((elevation_at<2>(particles, neighbors, {50.0, 0.0}, 1.0)));
}

TEST(LatticeTest, FillsTheWetCellsWithStatesAndMass) {
  support::Scene scene;
  scene.initial.surface = support::Formula("z - 0.5");
  scene.initial.p = support::Formula("-1000*z");
  scene.initial.u = support::Formula("x");
  const LinearEos eos{1000.0, 10.0, 0.0};
  Particles<2> particles;
  fill_lattice<2>({0.0, -1.0}, {1.0, 1.0}, 0.25, scene, eos, particles);
  ASSERT_EQ(particles.n_owned, 4u * 6u);  // rows from -.875 to .375
  for (std::size_t i = 0; i < particles.n_owned; ++i) {
    EXPECT_LT(particles.x[1][i], 0.5);
    EXPECT_DOUBLE_EQ(particles.u[0][i], particles.x[0][i]);
    EXPECT_DOUBLE_EQ(particles.m[i], (1000.0 - 10.0 * particles.x[1][i]) * 0.0625);
  }
}

TEST(ConfigTest, ASpacingThatDoesNotFitAPeriodicDomainIsNamed) {
  RunConfig config;
  config.scene.fluid.sound_speed = 10.0;
  config.scene.domain.upper = {1.0, 0.0, 1.0};
  config.scene.domain.sides[0] = {support::Scene::Side::periodic, support::Scene::Side::periodic};
  config.sph.spacing = 0.03;
  try {
    (void)domain_of<2>(config);
    FAIL() << "no error";
  } catch (const ConfigError& error) {
    EXPECT_NE(std::string(error.what()).find("along x"), std::string::npos);
  }
  config.sph.spacing = 0.5;  // fits, but the kernel is wider than the domain
  EXPECT_THROW((void)domain_of<2>(config), ConfigError);
  config.sph.spacing = 0.02;
  EXPECT_NO_THROW((void)domain_of<2>(config));
}

}  // namespace
}  // namespace littoral::sph
