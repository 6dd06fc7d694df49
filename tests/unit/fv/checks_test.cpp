#include "checks.hpp"

#include <gtest/gtest.h>

#include "boundary/prescribed.hpp"
#include "coupling/carve.hpp"
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

TEST(ChecksTest, AFringeFaceBesideSolvedCellsIsRefused) {
  const auto scene = test::top_scene(0.0);  // the particles have everything above z = .5
  std::vector<Block<2>> blocks{test::water_box<2>(16, true)};
  auto& windows = blocks[0].windows;
  windows.back().condition = Condition::fringe;  // the top, inside the region
  carve(blocks, scene);
  EXPECT_NO_THROW(check_blocks<2>(blocks, scene));
  windows[windows.size() - 2].condition = Condition::fringe;  // the bottom: nobody is there
  EXPECT_NE(refusal([&] { check_blocks<2>(blocks, scene); }).find("Give the face a condition (wall, slip"),
            std::string::npos);
}

TEST(ChecksTest, AFreeSurfaceInSolvedCellsIsRefused) {
  auto scene = test::top_scene(9.81);
  std::vector<Block<2>> blocks{test::water_box<2>(16, true)};
  scene.coupling.kind = support::Scene::CouplingKind::none;  // the grid alone
  scene.initial.surface = surface_at("z-1");                 // its upper edge
  EXPECT_NO_THROW(check_blocks<2>(blocks, scene));
  for (const char* surface : {"z-0.99", "z-0.5", "z-1+0.01*cos(6*x)"}) {
    scene.initial.surface = surface_at(surface);
    EXPECT_NE(refusal([&] { check_blocks<2>(blocks, scene); }).find("computes water only"), std::string::npos)
        << surface;
  }
  scene.coupling.kind = support::Scene::CouplingKind::imposed;  // it moves where the particles are
  carve(blocks, scene);
  EXPECT_NO_THROW(check_blocks<2>(blocks, scene));
}

TEST(ChecksTest, BlocksThatMeetAreRefused) {
  auto scene = test::top_scene(0.0);
  scene.coupling.kind = support::Scene::CouplingKind::none;
  const std::vector<Block<2>> twice(2, test::water_box<2>(8, true));
  EXPECT_NE(refusal([&] { check_apart<2>(twice); }).find("meet or overlap"), std::string::npos);
}

TEST(ChecksTest, AGridThatEndsShortOfTheDomainIsRefusedBesideParticles) {
  auto scene = test::top_scene(9.81);  // the particles have everything above z = .5, the grid ends at z = 1
  const std::vector<Block<2>> blocks{test::water_box<2>(8, true)};
  EXPECT_TRUE(check_covered<2>(blocks, scene).empty());
  scene.domain.lower[2] = -0.1;
  EXPECT_NE(
      refusal([&] { check_covered<2>(blocks, scene); }).find("the domain begins at z = -0.1 m, the grid"),
      std::string::npos);
  scene.coupling.kind = support::Scene::CouplingKind::none;  // the grid alone is told so, of both ends
  EXPECT_EQ(check_covered<2>(blocks, scene).size(), 2U);
  scene.initial.surface = surface_at("z-1");  // above it is air
  EXPECT_EQ(check_covered<2>(blocks, scene).size(), 1U);
  scene.domain.lower[2] = 0.0;
  EXPECT_TRUE(check_covered<2>(blocks, scene).empty());
}

TEST(PrescribedTest, AFormulaWithoutAValueIsNamedWithPlaceAndTime) {
  const Prescribed u = prescribed(support::Formula("sqrt(0.05-t)"), "face 'box.z_lower', u");
  EXPECT_EQ(u({0, 0, 0}, 0.05), 0.0);
  std::string message;
  try {
    u({0.5, 0, 0}, 0.06);
  } catch (const StabilityError& error) {
    message = error.what();
  }
  EXPECT_EQ(message.find("face 'box.z_lower', u: the formula 'sqrt(0.05-t)' is"), 0U) << message;
  EXPECT_NE(message.find("at (0.5, 0, 0) m, t = 0.06 s"), std::string::npos) << message;
}

TEST(AloneTest, AContinuedRunCountsItsWindowsOn) {
  Alone<2> alone(0.5, 1.0, 2, 7);
  coupler::Proposal mine;
  mine.dt_stable = 0.1;
  const auto next = alone.agree(mine);
  ASSERT_TRUE(next.has_value());
  EXPECT_EQ(next->window.index, 7);
}

}  // namespace
}  // namespace littoral::fv
