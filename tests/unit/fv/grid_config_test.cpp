#include <gtest/gtest.h>

#include "dual_time/stepper.hpp"
#include "grids.hpp"
#include "littoral/error.hpp"
#include "setup.hpp"

// From fv.yaml to joined blocks.
namespace littoral::fv {
namespace {

support::Scene scene_of(const std::string& domain) {
  support::Binder binder(
      support::Document::from_text("fluid: {density: 1, sound_speed: .inf, viscosity: 0.01}\n"
                                   "reference_velocity: 1\n"
                                   "initial: {u: sin(6.283185307179586*z)}\n"
                                   "time: {end: 1}\n"
                                   "domain: " +
                                       domain,
                                   "scene"));
  support::Scene scene;
  scene.bind(binder);
  binder.finish();
  return scene;
}

FvConfig config_of(const std::string& text) {
  support::Binder binder(support::Document::from_text(text, "fv"));
  FvConfig config;
  config.bind(binder);
  binder.finish();
  return config;
}

const std::string k_periodic = "{lower: [0, 0, 0], upper: [2, 1, 1], x: periodic, z: periodic}";
const std::string k_open = "{lower: [0, 0, 0], upper: [2, 1, 1]}";
const std::string k_pair =
    "blocks:\n"
    "  - {name: a, lower: [0, 0, 0], upper: [0.5, 1, 1], cells: [4, 1, 8]}\n"
    "  - {name: b, lower: [0.5, 0, 0], upper: [2, 1, 1], cells: [8, 1, 8]}\n";

template <int D>
int joins_of(const std::vector<Block<D>>& blocks) {
  int count = 0;
  for (const auto& block : blocks)
    for (const auto& w : block.windows) count += w.condition == Condition::join ? 1 : 0;
  return count;
}

TEST(GridConfigTest, PartsOfAPeriodicDomainJoinAcrossIt) {
  const Grid<2> grid = build_grid<2>(config_of(k_pair), scene_of(k_periodic));
  EXPECT_EQ(joins_of(grid.blocks), 4);      // a to b directly, and across the domain
  EXPECT_TRUE(grid.blocks[0].periodic[1]);  // each spans the domain along z
  EXPECT_EQ(grid.notes[0], "a.x_lower joins b.x_upper, offset (-2, 0, 0) m");
  EXPECT_EQ(grid.notes[1], "a.x_upper joins b.x_lower");
}

std::string refusal(const std::string& config, const std::string& domain) {
  try {
    build_grid<2>(config_of(config), scene_of(domain));
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "nothing was refused";
}

TEST(GridConfigTest, ValuesThatAConditionDoesNotUseAreRefused) {
  const auto with = [](const std::string& face) {
    return refusal(
        "blocks:\n  - {name: a, lower: [0, 0, 0], upper: [2, 1, 1], cells: [4, 1, 4], faces: {x_lower: " +
            face +
            ", x_upper: {condition: outflow}, z_lower: {condition: slip}, z_upper: {condition: slip}}}\n",
        k_open);
  };
  EXPECT_EQ(with("{condition: inflow, u: 1}"), "nothing was refused");
  EXPECT_EQ(with("{condition: wall, w: 1}"), "nothing was refused");
  EXPECT_NE(with("{condition: inflow}").find("an inflow needs its velocity"), std::string::npos);
  EXPECT_NE(with("{condition: outflow, u: 3, wave_speed: 9}").find("outflow does not use u, wave_speed"),
            std::string::npos);
  EXPECT_NE(with("{condition: wall, p: 7}").find("face 'a.x_lower': condition wall does not use p"),
            std::string::npos);
  EXPECT_NE(with("{condition: symmetry, u: 1}").find("symmetry does not use u"), std::string::npos);
}

TEST(GridConfigTest, FacesThatMeetNobodyAreNamedAllAtOnce) {
  const std::string text = refusal(k_pair, k_open);
  for (const char* face : {"block 'a', face x_lower", "block 'a', face z_upper", "block 'b', face x_upper"})
    EXPECT_NE(text.find(face), std::string::npos) << text;
  EXPECT_EQ(text.find("face x_upper: 8 faces from cell (0) at (0.4"), std::string::npos) << text;
  EXPECT_NE(refusal("joins: listed\n" + k_pair, k_open).find("the face needs a condition"),
            std::string::npos);
}

TEST(GridConfigTest, AFaceNamesItsPartnerAndTheOffset) {
  const std::string walls = "z_lower: {condition: wall}, z_upper: {condition: wall}";
  const std::string channel =
      "joins: listed\n"
      "blocks:\n"
      "  - {name: a, lower: [0, 0, 0], upper: [1, 1, 1], cells: [4, 1, 8], faces: {" +
      walls +
      ", x_lower: {condition: join, join: {block: b, face: x_upper, offset: [-2, 0, 0]}}, x_upper: "
      "{condition: join}}}\n"
      "  - {name: b, lower: [1, 0, 0], upper: [2, 1, 1], cells: [4, 1, 8], faces: {" +
      walls + ", x_lower: {condition: join}, x_upper: {condition: join, join: {offset: [2, 0, 0]}}}}\n";
  const Grid<2> grid = build_grid<2>(config_of(channel), scene_of(k_open));
  EXPECT_EQ(joins_of(grid.blocks), 4);
  std::string wrong = channel;
  wrong.replace(wrong.find("face: x_upper"), 13, "face: x_lower");
  EXPECT_NE(refusal(wrong, k_open).find("meet no face of block 'b'"), std::string::npos);
}

TEST(GridConfigTest, JoinedBlocksGoOnFromAMemoryToTheBit) {
  const FvConfig config = config_of(k_pair);
  const support::Scene scene = scene_of(k_periodic);
  Stepper<2> through = make_stepper<2>(config, scene), second = make_stepper<2>(config, scene);
  for (int i = 0; i < 3; ++i) through.advance(0.02);
  second.recall(through.memory());
  for (int i = 0; i < 2; ++i) {
    through.advance(0.02);
    second.advance(0.02);
  }
  for (std::size_t b = 0; b < 2; ++b) {
    EXPECT_EQ(through.state()[b].p, second.state()[b].p);
    EXPECT_EQ(through.state()[b].u[0], second.state()[b].u[0]);
  }
}

}  // namespace
}  // namespace littoral::fv
