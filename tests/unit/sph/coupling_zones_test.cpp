#include <gtest/gtest.h>

#include <cmath>

#include "coupling/zones.hpp"
#include "coupling_support.hpp"
#include "littoral/error.hpp"

namespace littoral::sph {
namespace {

TEST(ZonesTest, WeightIsExactAtBothEndsAndLinearBetween) {  // C0
  const auto layers = test::unit_box<2>(test::all_open<2>(), 0.25, 0.5);
  const auto weight = [&](double x) { return layers.sph_weight(layers.excess({x, 0.5})); };
  EXPECT_EQ(weight(0.5), 1.0);
  EXPECT_EQ(weight(1.0), 1.0);
  EXPECT_EQ(weight(1.0625), 0.75);  // binary fractions: exact
  EXPECT_EQ(weight(1.125), 0.5);
  EXPECT_EQ(weight(1.25), 0.0);
  EXPECT_EQ(weight(1.6), 0.0);
  EXPECT_EQ(weight(-0.125), 0.5);
}

TEST(ZonesTest, FollowOneAnotherOutwards) {
  const auto layers = test::unit_box<3>(test::all_open<3>(), 0.25, 0.5);
  const auto zone = [&](double z) { return layers.zone(layers.excess({0.5, 0.5, z})); };
  EXPECT_EQ(zone(1.0), Zone::interior);
  EXPECT_EQ(zone(1.1), Zone::blending);
  EXPECT_EQ(zone(1.25), Zone::driven);
  EXPECT_EQ(zone(-0.3), Zone::driven);
  EXPECT_TRUE(layers.inside_outer({0.5, 0.5, 1.75}));
  EXPECT_FALSE(layers.inside_outer({0.5, 0.5, 1.76}));
}

TEST(ZonesTest, CornerTakesTheSmallestWeight) {
  const auto layers = test::unit_box<2>(test::all_open<2>(), 0.25, 0.5);
  EXPECT_EQ(layers.sph_weight(layers.excess({1.125, 1.0625})), 0.5);
  EXPECT_EQ(layers.sph_weight(layers.excess({1.125, -0.1875})), 0.25);
}

TEST(ZonesTest, ClosedFacesHaveNoLayers) {
  const auto layers = test::unit_box<2>({{{false, false}, {true, false}}}, 0.25, 0.5);
  EXPECT_EQ(layers.zone(layers.excess({-5.0, 0.5})), Zone::interior);
  EXPECT_EQ(layers.zone(layers.excess({0.5, 2.0})), Zone::interior);
  EXPECT_EQ(layers.boxes()[0].outer_lower[1], -0.75);
  EXPECT_EQ(layers.boxes()[0].outer_upper[1], 1.0);
  EXPECT_EQ(layers.boxes()[0].outer_lower[0], 0.0);
}

TEST(ZonesTest, OuterFaceBlocksItsNormalOnly) {
  const auto layers = test::unit_box<2>({{{false, false}, {true, false}}}, 0.25, 0.5);
  EXPECT_EQ(layers.blocked_normals({0.5, -0.7}, 0.2), (std::array<bool, 2>{false, true}));
  EXPECT_EQ(layers.blocked_normals({0.5, -0.5}, 0.2), (std::array<bool, 2>{false, false}));
}

}  // namespace
}  // namespace littoral::sph
