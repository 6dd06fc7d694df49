#include "littoral/support/scene_warnings.hpp"

#include <gtest/gtest.h>

namespace littoral::support {
namespace {

TEST(SceneWarningsTest, VeryManySubstepsAreToldOfUnlessTheWindowIsGiven) {
  Scene scene;
  scene.fluid.sound_speed = 10.0;
  scene.coupling.kind = Scene::CouplingKind::forced;
  scene.coupling.window.substeps = k_too_many_substeps;
  EXPECT_TRUE(scene_warnings(scene).empty());
  scene.coupling.window.substeps = 50;
  ASSERT_EQ(scene_warnings(scene).size(), 1u);
  EXPECT_EQ(scene_warnings(scene)[0], "coupling.substeps is 50; up to 10 were compared with M = 1");
  scene.coupling.window.dt = 0.1;
  EXPECT_TRUE(scene_warnings(scene).empty());
  scene.coupling.window.dt.reset();
  scene.coupling.kind = Scene::CouplingKind::none;
  EXPECT_TRUE(scene_warnings(scene).empty());
}

}  // namespace
}  // namespace littoral::support
