#include <gtest/gtest.h>

#include "coupling/zones.hpp"
#include "littoral/error.hpp"

namespace littoral::sph {
namespace {

support::Scene scene_with(double lower, double upper) {
  support::Scene scene;
  scene.dimension = 2;
  scene.domain.lower = {0.0, 0.0, -1.0};
  scene.domain.upper = {2.0, 0.0, 0.5};
  scene.coupling.kind = support::Scene::CouplingKind::imposed;
  scene.coupling.blending_width = 0.1;
  scene.coupling.driven_width = 0.2;
  scene.regions.resize(1);
  scene.regions[0].lower = {0.0, 0.0, lower};
  scene.regions[0].upper = {2.0, 0.0, upper};
  return scene;
}

TEST(RegionTest, FaceIsOpenOnlyInsideTheDomain) {
  const auto layers = Layers<2>::from_scene(scene_with(-0.5, 0.9), 0.2);
  const auto& box = layers.boxes()[0];
  EXPECT_TRUE(box.open[1][0]);
  EXPECT_FALSE(box.open[1][1]) << "a face beyond the domain's side is cut to it";
  EXPECT_FALSE(box.open[0][0] || box.open[0][1]);
  EXPECT_EQ(box.upper[1], 0.5);
  const auto needs = layers.needs(0.05);
  EXPECT_NEAR(needs.lower[2], -0.85, 1e-15);
  EXPECT_NEAR(needs.upper[2], -0.45, 1e-15);
}

TEST(RegionTest, RefusesLayersThatDoNotFit) {
  EXPECT_THROW(Layers<2>::from_scene(scene_with(-0.8, 0.5), 0.2), ConfigError) << "no room for the layers";
  EXPECT_THROW(Layers<2>::from_scene(scene_with(-0.5, 0.5), 0.3), ConfigError) << "driven layer below R";
  EXPECT_THROW(Layers<2>::from_scene(scene_with(0.6, 0.9), 0.2), ConfigError) << "outside the domain";
}

}  // namespace
}  // namespace littoral::sph
