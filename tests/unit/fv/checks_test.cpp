#include "checks.hpp"

#include <gtest/gtest.h>

#include "coupling_models.hpp"
#include "littoral/error.hpp"

// What a run would refuse, or worse not refuse, is found before it starts.
namespace littoral::fv {
namespace {

template <class F>
std::string refusal(F&& f) {
  try {
    f();
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "nothing was refused";
}

/// z - level, as a scene's file would give it.
support::Formula surface_at(const std::string& formula) { return support::Formula(formula, {}); }

TEST(ChecksTest, ASceneWhoseLevelSetCrossesIsRefused) {
  auto scene = test::top_scene(9.81);
  scene.initial.surface = surface_at("z-1");
  EXPECT_NO_THROW(check_scene(scene));  // a wave: the particles have the surface whole
  auto forced = scene;
  forced.coupling.kind = support::Scene::CouplingKind::forced;
  EXPECT_NE(refusal([&] { check_scene(forced); }).find("level set would have to cross"), std::string::npos);
  auto pool = scene;
  pool.regions[0].lower[0] = 0.25;  // an upright face, through which the surface passes
  EXPECT_NE(refusal([&] { check_scene(pool); }).find("level set would have to cross"), std::string::npos);
}

}  // namespace
}  // namespace littoral::fv
