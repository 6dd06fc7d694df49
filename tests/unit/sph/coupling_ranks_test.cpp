#include <gtest/gtest.h>

#include "coupling/injection_rounds.hpp"
#include "coupling/rank_part.hpp"
#include "coupling/zones.hpp"

namespace littoral::sph {
namespace {

/// A strip of ten elements along x, of side 1, at the lower outer face z = -2; periodic in x.
Layers<2> strip(bool periodic) {
  RegionBox<2> box;
  box.lower = {0.0, 0.0};
  box.upper = {10.0, 5.0};
  box.open[1][0] = true;
  box.periodic[0] = periodic;
  return Layers<2>({box}, 1.0, 1.0);
}

TEST(InjectionRoundsTest, OneRankNeedsOneRound) {
  const FaceElements<2> elements(strip(false), 1.0, FaceRows::fixed);
  ASSERT_EQ(elements.size(), 10u);
  const std::vector<std::size_t> due = {0, 1, 2, 9};
  EXPECT_EQ(injection_rounds(elements, due, {0, 0, 0, 0}, 3.0), (std::vector<std::size_t>{0, 0, 0, 0}));
}

TEST(InjectionRoundsTest, AnElementWaitsForNearOnesBeforeItOfAnotherRank) {
  const FaceElements<2> elements(strip(false), 1.0, FaceRows::fixed);
  const std::vector<std::size_t> due = {3, 4, 5, 9};
  // 4 of rank 1 after 3 of rank 0; 5 of rank 1 as 4, its own; 9 is far away
  EXPECT_EQ(injection_rounds(elements, due, {0, 1, 1, 0}, 3.0), (std::vector<std::size_t>{0, 1, 1, 0}));
  // rank 0 has 5 again: after 4
  EXPECT_EQ(injection_rounds(elements, due, {0, 1, 0, 0}, 3.0), (std::vector<std::size_t>{0, 1, 2, 0}));
}

TEST(InjectionRoundsTest, NearIsMeantAcrossAPeriodicSide) {
  const std::vector<std::size_t> due = {0, 9};
  EXPECT_EQ(injection_rounds(FaceElements<2>(strip(true), 1.0, FaceRows::fixed), due, {0, 1}, 3.0),
            (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(injection_rounds(FaceElements<2>(strip(false), 1.0, FaceRows::fixed), due, {0, 1}, 3.0),
            (std::vector<std::size_t>{0, 0}));
}

DomainBox<2> domain(support::Scene::Side side) {
  DomainBox<2> box;
  box.upper = {10.0, 5.0};
  box.sides[0] = {side, side};
  box.sides[1] = {support::Scene::Side::open, support::Scene::Side::open};
  return box;
}

TEST(RankPartTest, IsWhatLiesWithinTheSkinOfTheRanksSpace) {
  const coupler::Box whole{{0.0, 0.0, -2.0}, {10.0, 0.0, 5.0}};
  const RankBox<2> mine{{4.0, -1e300}, {6.0, 1.0}};
  const auto part = rank_part(whole, mine, domain(support::Scene::Side::periodic), 0.5);
  EXPECT_EQ(part.lower, (coupler::Vec3{3.5, 0.0, -2.0}));
  EXPECT_EQ(part.upper, (coupler::Vec3{6.5, 0.0, 1.5}));
}

TEST(RankPartTest, WhatStraysThroughAPeriodicSideIsLookedForAtTheOther) {
  const coupler::Box whole{{0.0, 0.0, -2.0}, {10.0, 0.0, 5.0}};
  const RankBox<2> left{{-1e300, -1e300}, {5.0, 1e300}};
  const auto part = rank_part(whole, left, domain(support::Scene::Side::periodic), 0.5);
  EXPECT_EQ(part.lower[0], 0.0);
  EXPECT_EQ(part.upper[0], 10.0);
  EXPECT_EQ(rank_part(whole, left, domain(support::Scene::Side::symmetry), 0.5).upper[0], 5.5);
  EXPECT_EQ(rank_part(whole, left, domain(support::Scene::Side::periodic), 0.0).upper[0], 5.0)
      << "targets stay inside";
}

TEST(RankPartTest, ARankAwayFromTheBoxHasNoPart) {
  const coupler::Box whole{{0.0, 0.0, -2.0}, {10.0, 0.0, -1.0}};
  const RankBox<2> above{{-1e300, 1.0}, {1e300, 1e300}};
  EXPECT_TRUE(rank_part(whole, above, domain(support::Scene::Side::periodic), 0.5).empty());
}

}  // namespace
}  // namespace littoral::sph
