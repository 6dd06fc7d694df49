#include "clip.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "littoral/coupler/donor_search.hpp"

namespace littoral::coupler {
namespace {

/// Stretched and skewed, so that boxes of the size of a cell lie inside single cells.
DonorGeometry skewed(bool planar) {
  DonorGeometry geometry;
  DonorPatch patch;
  patch.n = {14, planar ? 1 : 6, 17};
  for (int k = 0; k < patch.n[2]; ++k)
    for (int j = 0; j < patch.n[1]; ++j)
      for (int i = 0; i < patch.n[0]; ++i) {
        const double z = std::pow(1.4, k) - 1.0;
        patch.x.push_back(i + 0.01 * z);
        patch.y.push_back(planar ? 0.0 : j + 0.1 * i);
        patch.z.push_back(z + 0.2 * i);
      }
  patch.usable.assign(patch.x.size(), 1);
  geometry.patches.push_back(patch);
  return geometry;
}

class ClipTest : public ::testing::TestWithParam<bool> {};

// What a contact receives must serve its box as well as the whole patch would.
TEST_P(ClipTest, TheClippedPatchServesItsBoxAsTheWholeDoes) {
  const bool planar = GetParam();
  const auto whole = skewed(planar);
  const DonorSearch everywhere(whole, planar ? 2 : 3);
  std::mt19937 random(5);
  const auto uniform = [&](double a, double b) { return std::uniform_real_distribution(a, b)(random); };
  int served = 0, smaller = 0;
  for (int trial = 0; trial < 60; ++trial) {
    Box box;
    box.lower = {uniform(-2, 14), planar ? 0.0 : uniform(-1, 7), uniform(-1, 200)};
    for (std::size_t d = 0; d < 3; ++d)
      box.upper[d] = box.lower[d] + (planar && d == 1 ? 0.0 : uniform(0.1, 4));
    const auto clips = clip(whole, box);
    const auto part = clipped(whole, clips);
    smaller += part.size() > 0 && part.size() < whole.size();
    const DonorSearch here(part, planar ? 2 : 3);
    for (int point = 0; point < 40; ++point) {
      Vec3 x;
      for (std::size_t d = 0; d < 3; ++d) x[d] = uniform(box.lower[d], box.upper[d] + 1e-300);
      std::int64_t none = -1, also_none = -1;
      if (!everywhere.find(x, none).found) continue;
      ++served;
      ASSERT_TRUE(here.find(x, also_none).found) << x[0] << " " << x[1] << " " << x[2];
    }
  }
  EXPECT_GT(served, 300);  // the trial says something
  EXPECT_GT(smaller, 20);
}

TEST_P(ClipTest, ReachHoldsEverythingThatCanBeServed) {
  const auto whole = skewed(GetParam());
  const Box box = reach(whole);
  const DonorSearch search(whole, GetParam() ? 2 : 3);
  std::mt19937 random(6);
  const auto uniform = [&](double a, double b) { return std::uniform_real_distribution(a, b)(random); };
  for (int point = 0; point < 3000; ++point) {
    const Vec3 x{uniform(-3, 18), GetParam() ? 0.0 : uniform(-3, 10), uniform(-60, 300)};
    std::int64_t none = -1;
    if (search.find(x, none).found) {
      ASSERT_TRUE(box.contains(x));
      ASSERT_FALSE(clip(whole, {x, x}).empty());
    }
  }
}
INSTANTIATE_TEST_SUITE_P(PlanarAndSolid, ClipTest, ::testing::Bool());

TEST(ClipTest, RunsFollowTheClippedCells) {
  const auto whole = skewed(false);
  const std::vector<Clip> clips{{0, {3, 1, 2}, {5, 2, 4}}, {0, {0, 0, 0}, {14, 6, 3}}};
  const auto part = clipped(whole, clips);
  std::vector<double> x, expected;
  for (const auto& run : runs(whole, clips))
    for (std::size_t i = run.first; i < run.first + run.n; ++i) x.push_back(whole.patches[0].x[i]);
  for (const auto& patch : part.patches) expected.insert(expected.end(), patch.x.begin(), patch.x.end());
  EXPECT_EQ(x, expected);
  EXPECT_EQ(runs(whole, {{0, {0, 0, 0}, {14, 6, 17}}}).size(), 1u);  // a whole patch is one piece
}

TEST(ClipTest, NothingNeededNothingClipped) {
  const auto whole = skewed(false);
  EXPECT_TRUE(clip(whole, Box::nothing()).empty());
  EXPECT_TRUE(reach(DonorGeometry{}).empty());
  Targets none;
  EXPECT_TRUE(around(none).empty());
  EXPECT_TRUE(held_by(Box::nothing(), none).empty());
}

}  // namespace
}  // namespace littoral::coupler
