#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "littoral/error.hpp"
#include "split_grids.hpp"

// Which faces meet, and what becomes of those that do not.
namespace littoral::fv {
namespace {

/// A box that may be joined on every face.
Block<2> open_box(const std::string& name, std::array<double, 2> lower, std::array<double, 2> upper,
                  std::array<int, 2> cells) {
  auto block = make_block<2>(name, cells, {}, [=](const std::array<int, 2>& i) {
    std::array<double, 2> x;
    for (std::size_t d = 0; d < 2; ++d) x[d] = lower[d] + (upper[d] - lower[d]) * i[d] / cells[d];
    return x;
  });
  close_with<2>(block, Condition::wall);
  for (auto& w : block.windows) w.request.kind = JoinRequest<2>::Kind::if_met;
  return block;
}

TEST(FindJoinsTest, APartOfAFaceIsJoinedAndTheRestKeepsItsCondition) {
  std::vector<Block<2>> blocks = {open_box("low", {0, 0}, {4, 1}, {8, 2}),
                                  open_box("tower", {1, 1}, {2, 3}, {2, 4})};
  const auto lines = find_joins(blocks);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0], "low.j_upper[2..4] joins tower.j_lower");
  check_windows(blocks[0]);
  check_windows(blocks[1]);
  int walls = 0, joins = 0;
  for (const auto& w : blocks[0].windows) {
    if (w.direction != 1 || w.side != 1) continue;
    (w.condition == Condition::wall ? walls : joins) += w.upper[0] - w.lower[0];
  }
  EXPECT_EQ(walls, 6);
  EXPECT_EQ(joins, 2);
}

TEST(FindJoinsTest, ARingClosesOnItself) {
  auto ring = make_block<2>("ring", {12, 3}, {}, [](const std::array<int, 2>& i) {
    const double a = -2.0 * M_PI * i[0] / 12, r = 1.0 + 0.5 * i[1];
    return std::array<double, 2>{r * std::cos(a), r * std::sin(a)};
  });
  close_with<2>(ring, Condition::wall);
  for (auto& w : ring.windows) w.request.kind = JoinRequest<2>::Kind::if_met;
  std::vector<Block<2>> blocks{ring};
  EXPECT_EQ(find_joins(blocks).size(), 1u);
  EXPECT_TRUE(blocks[0].periodic[0]);
  EXPECT_EQ(blocks[0].windows[0].condition, Condition::periodic);
  const auto at = [&](int i, int j) { return static_cast<std::size_t>(blocks[0].extent.at({i, j})); };
  for (std::size_t k = 0; k < 2; ++k)
    EXPECT_NEAR(blocks[0].centre[k][at(-2, 1)], blocks[0].centre[k][at(10, 1)], 1e-15);
}

/// The two halves of one face lie on each other: the cut of a C-grid.
TEST(FindJoinsTest, AFaceIsJoinedWithItself) {
  auto c = make_block<2>("c", {12, 3}, {}, [](const std::array<int, 2>& i) {
    // the wake from behind, around a diamond, and back along the wake
    const double x[] = {0, -0.5, -1, -0.5, 0}, z[] = {0, -0.2, 0, 0.2, 0};
    const double away_x[] = {0, -0.3, -1, -0.3, 0}, away_z[] = {-1, -1, 0, 1, 1};
    const auto k = static_cast<std::size_t>(std::clamp(i[0] - 4, 0, 4));
    const double wake = std::max({0, 4 - i[0], i[0] - 8}), h = 0.25 * i[1];
    return std::array<double, 2>{x[k] + wake + h * away_x[k], z[k] + h * away_z[k]};
  });
  close_with<2>(c, Condition::wall);
  for (auto& w : c.windows) w.request.kind = JoinRequest<2>::Kind::if_met;
  std::vector<Block<2>> blocks{c};
  const auto lines = find_joins(blocks);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0], "c.j_lower[0..4] joins c.j_lower[8..12], direction i along -i");
  const auto at = [&](int i, int j) { return static_cast<std::size_t>(blocks[0].extent.at({i, j})); };
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(blocks[0].centre[k][at(1, -1)], blocks[0].centre[k][at(10, 0)]);
    EXPECT_EQ(blocks[0].centre[k][at(1, -2)], blocks[0].centre[k][at(10, 1)]);
    EXPECT_EQ(blocks[0].centre[k][at(12, -1)], blocks[0].centre[k][at(-1, 0)]);
  }
}

TEST(FindJoinsTest, AFaceThatMeetsNobodyIsNamed) {
  std::vector<Block<2>> blocks = {open_box("left", {0, 0}, {1, 1}, {4, 4}),
                                  open_box("right", {1, 0}, {2, 1}, {4, 5})};
  blocks[0].windows[1].condition = Condition::join;
  blocks[0].windows[1].request.kind = JoinRequest<2>::Kind::required;
  try {
    find_joins(blocks);
    FAIL() << "faces that do not match were joined";
  } catch (const ConfigError& e) {
    const std::string text = e.what();
    EXPECT_NE(text.find("block 'left', face i_upper: 4 faces from cell (0)"), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace littoral::fv
