#include "prediction.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "littoral/error.hpp"

namespace littoral::sph {
namespace {

/// A unit square of water, its lower half a region with layers of four spacings below.
RunConfig square() {
  RunConfig config;
  auto& scene = config.scene;
  scene.dimension = 2;
  scene.fluid.sound_speed = 10.0;
  scene.domain.upper = {1.0, 0.0, 1.0};
  for (auto& side : scene.domain.sides)
    side = {support::Scene::Side::symmetry, support::Scene::Side::symmetry};
  scene.regions.resize(1);
  scene.regions[0].lower = {0.0, 0.0, 0.5};
  scene.regions[0].upper = {1.0, 0.0, 1.0};
  scene.coupling.kind = support::Scene::CouplingKind::imposed;
  scene.coupling.blending_width = 0.1;
  scene.coupling.driven_width = 0.1;
  scene.time.end = 1.0;
  config.sph.spacing = 0.025;
  return config;
}

TEST(PredictionTest, CountsWhatTheRunWillPlaceAndStep) {
  const Prediction coupled = predict(square(), true), alone = predict(square(), false);
  EXPECT_EQ(coupled.particles, 40u * 28u);  // from z = .3, where the layers end
  EXPECT_EQ(alone.particles, 40u * 40u);
  EXPECT_DOUBLE_EQ(coupled.dt, 0.375 * 0.1 / 10.0);  // (16)
  EXPECT_EQ(coupled.steps, std::ceil(1.0 / coupled.dt));
  EXPECT_GT(coupled.memory, 500.0 * 40 * 28) << "49 columns and more than 50 neighbours each";
  EXPECT_NE(coupled.text().find("particles: 1120\n"), std::string::npos) << coupled.text();
}

TEST(PredictionTest, RefusesADrivenLayerThinnerThanTheKernel) {
  RunConfig config = square();
  config.scene.coupling.driven_width = 0.09;
  EXPECT_THROW(predict(config, true), ConfigError);
  EXPECT_NO_THROW(predict(config, false)) << "alone there are no layers";
}

TEST(PredictionTest, RefusesAnEmptyScene) {
  RunConfig config = square();
  config.scene.initial.surface = support::Formula("1 + z");
  EXPECT_THROW(predict(config, false), ConfigError);
}

TEST(PredictionTest, ARegionMayStartDryWhereThePartnersSurfaceGoesOnThroughIt) {
  RunConfig config = square();
  config.scene.gravity = {0.0, 0.0, -1.0};
  config.scene.initial.surface = support::Formula("z - 0.2");  // below the layers
  EXPECT_THROW(predict(config, true), ConfigError) << "the grid under a level face has no surface";
  config.scene.coupling.kind = support::Scene::CouplingKind::forced;
  EXPECT_EQ(predict(config, true).particles, 0u);
  config.scene.initial.surface = support::Formula("1 + z");
  EXPECT_THROW(predict(config, false), ConfigError) << "alone nobody brings water";
}

TEST(PlaceParticlesTest, WhereLayersOfTwoBoxesOverlapTheLatticeStandsOnce) {
  RunConfig config = square();
  config.scene.domain.lower = {-1.0, 0.0, -1.0};
  config.scene.domain.upper = {3.0, 0.0, 2.0};
  config.scene.regions.resize(2);
  config.scene.regions[0].lower = {0.0, 0.0, 0.0};
  config.scene.regions[0].upper = {1.0, 0.0, 1.0};
  config.scene.regions[1].lower = {1.0, 0.0, 0.0};
  config.scene.regions[1].upper = {2.0, 0.0, 0.4};
  Particles<2> particles;
  place_particles<2>(config, region_of<2>(config, true), nullptr, particles);
  // outer boxes 1.4 x 1.4, and .8 more of one 1.4 x .8
  EXPECT_EQ(particles.n_owned,
            static_cast<std::size_t>(std::lround((1.4 * 1.4 + 1.0 * 0.8) / (0.025 * 0.025))));
}

}  // namespace
}  // namespace littoral::sph
