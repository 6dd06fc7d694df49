#include "grid/box.hpp"

#include <gtest/gtest.h>

#include "boundary/ghosts.hpp"
#include "littoral/error.hpp"

namespace littoral::fv {
namespace {

support::Scene scene_of(const std::string& more = "") {
  support::Binder binder(
      support::Document::from_text("fluid: {sound_speed: 10}\ndomain: {lower: [0, 0, 0], upper: [2, 1, 1], "
                                   "x: periodic, z: [symmetry, open]}\n"
                                   "time: {end: 1}\n" +
                                       more,
                                   "scene"));
  support::Scene scene;
  scene.bind(binder);
  binder.finish();
  return scene;
}

BlockConfig block_of(const std::string& text) {
  support::Binder binder(support::Document::from_text(text, "block"));
  BlockConfig block;
  block.bind(binder);
  binder.finish();
  return block;
}

const std::string k_box = "{lower: [0, 0, 0], upper: [2, 0, 1], cells: [8, 1, 6], ";

std::string problem_of(const std::string& block, const std::string& scene = "") {
  try {
    build_block<2>(block_of(block), scene_of(scene));
  } catch (const ConfigError& e) {
    return e.what();
  }
  return "none";
}

TEST(BoxTest, FacesFollowTheSceneUnlessTold) {
  const Block<2> block =
      build_block<2>(block_of(k_box + "faces: {z_upper: {condition: wall, u: 2*x, name: lid}}}"), scene_of());
  check_windows(block);
  ASSERT_EQ(block.windows.size(), 4u);
  EXPECT_EQ(block.windows[0].condition, Condition::periodic);
  EXPECT_EQ(block.windows[2].condition, Condition::symmetry);
  EXPECT_EQ(block.windows[3].condition, Condition::wall);
  EXPECT_EQ(block.windows[3].name, "lid");
  EXPECT_DOUBLE_EQ(block.windows[3].velocity[0]({0.3, 0.0, 1.0}, 0.0), 0.6);
  EXPECT_FALSE(block.windows[3].velocity[1]);
}

TEST(BoxTest, PatchesDivideAFaceAndTheLastOneWins) {
  const Block<2> block = build_block<2>(
      block_of(k_box + "faces: {z_upper: {condition: slip}}, patches: ["
                       "{face: z_upper, from: [1, 0, 0], to: [6, 0, 0], condition: wall},"
                       "{face: z_upper, from: [3, 0, 0], to: [4, 0, 0], condition: outflow}]}"),
      scene_of());
  check_windows(block);
  std::array<Condition, 8> found{};
  for (const auto& w : block.windows)
    if (w.direction == 1 && w.side == 1)
      for (int i = w.lower[0]; i < w.upper[0]; ++i) found[static_cast<std::size_t>(i)] = w.condition;
  const auto s = Condition::slip, w = Condition::wall, o = Condition::outflow;
  EXPECT_EQ(found, (std::array<Condition, 8>{s, w, w, o, w, w, s, s}));
}

TEST(BoxTest, ProblemsAreNamed) {
  EXPECT_NE(problem_of(k_box + "}").find("faces.z_upper"), std::string::npos)
      << "an open side has no condition";
  EXPECT_NE(
      problem_of(k_box + "faces: {z_upper: {condition: slip}}, patches: [{face: z_upper, from: [1, 0, 0], "
                         "to: [9, 0, 0], condition: wall}]}")
          .find("1 to 9"),
      std::string::npos);
  EXPECT_NE(problem_of(k_box + "faces: {z_upper: {condition: slip}, x_lower: {condition: wall}}}")
                .find("one side only"),
            std::string::npos);
  EXPECT_NE(
      problem_of(k_box + "faces: {z_upper: {condition: slip}}}", "gravity: [1, 0, -9.81]\n").find("source.u"),
      std::string::npos)
      << "gravity along a periodic direction";
  EXPECT_NE(
      problem_of(k_box + "faces: {z_upper: {condition: slip}}, mapping: {z: z - 1.2*z*z}}").find("folded"),
      std::string::npos);
}

TEST(BoxTest, StretchingKeepsEndsAndRatio) {
  Stretching geometric;
  geometric.kind = Stretching::Kind::geometric;
  geometric.ratio = 8.0;
  for (const auto toward : {Stretching::Toward::lower, Stretching::Toward::upper, Stretching::Toward::both}) {
    geometric.toward = toward;
    EXPECT_EQ(stretched(geometric, 0, 12), 0.0);
    EXPECT_NEAR(stretched(geometric, 12, 12), 1.0, 1e-15);
    double narrow = 1.0, wide = 0.0;
    for (int i = 0; i < 12; ++i) {
      const double h = stretched(geometric, i + 1, 12) - stretched(geometric, i, 12);
      narrow = std::min(narrow, h);
      wide = std::max(wide, h);
    }
    EXPECT_NEAR(wide / narrow, 8.0, 1e-10);
  }
  Stretching tanh;
  tanh.kind = Stretching::Kind::tanh;
  EXPECT_LT(stretched(tanh, 1, 10), 0.1);
  tanh.toward = Stretching::Toward::both;
  EXPECT_NEAR(stretched(tanh, 3, 10) + stretched(tanh, 7, 10), 1.0, 1e-15);
}

}  // namespace
}  // namespace littoral::fv
