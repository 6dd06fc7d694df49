#include "neighbors/neighbor_list.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <random>
#include <set>

#include "clouds.hpp"
#include "neighbors/outlook.hpp"

namespace littoral::sph {
namespace {

template <int D>
double distance(const Particles<D>& particles, std::size_t i, std::size_t j) {
  double r2 = 0.0;
  for (std::size_t d = 0; d < D; ++d)
    r2 += (particles.x[d][i] - particles.x[d][j]) * (particles.x[d][i] - particles.x[d][j]);
  return std::sqrt(r2);
}

template <int D>
void expect_lists_equal_brute_force(const Particles<D>& particles, double radius) {
  NeighborList<D> neighbors(radius, 0.1);
  neighbors.build(particles);
  ASSERT_EQ(neighbors.n_rows(), particles.n_owned);
  for (std::size_t i = 0; i < particles.n_owned; ++i) {
    std::multiset<std::int32_t> found(neighbors.list() + neighbors.start()[i],
                                      neighbors.list() + neighbors.start()[i + 1]);
    std::multiset<std::int32_t> expected;
    for (std::size_t j = 0; j < particles.size(); ++j)
      if (j != i && distance(particles, i, j) < radius + 0.1) expected.insert(static_cast<std::int32_t>(j));
    ASSERT_EQ(found, expected) << "particle " << i;
  }
}

TEST(NeighborListTest, EqualsBruteForceIn2D) {
  expect_lists_equal_brute_force<2>(test::cloud<2>({23, 17}, 1.0, 0.4), 4.0);
}

TEST(NeighborListTest, EqualsBruteForceIn3D) {
  expect_lists_equal_brute_force<3>(test::cloud<3>({9, 8, 7}, 1.0, 0.4), 2.7);
}

TEST(NeighborListTest, OneFarParticleCostsNoMemory) {
  auto particles = test::cloud<3>({4, 4, 4}, 1.0, 0.3);
  NewParticle<3> far;
  far.x = {1e7, -1e7, 1e7};
  far.V = far.m = 1.0;
  particles.append(far);
  expect_lists_equal_brute_force<3>(particles, 2.7);
}

TEST(NeighborListTest, IsTheSameForAnyNumberOfThreads) {
  const auto particles = test::cloud<2>({40, 40}, 1.0, 0.4);
  std::vector<std::int32_t> first;
  for (int threads : {1, 2, 3, 5}) {
    omp_set_num_threads(threads);
    NeighborList<2> neighbors(4.0, 0.3);
    neighbors.build(particles);
    const std::vector<std::int32_t> list(neighbors.list(), neighbors.list() + neighbors.n_pairs());
    if (first.empty()) first = list;
    EXPECT_EQ(list, first) << threads << " threads";
  }
  omp_set_num_threads(1);
}

TEST(NeighborListTest, OutdatedWhenSomebodyMovedHalfTheSkin) {
  auto particles = test::cloud<2>({10, 10}, 1.0);
  NeighborList<2> neighbors(4.0, 0.4);
  EXPECT_TRUE(neighbors.outdated(particles));
  neighbors.build(particles);
  EXPECT_FALSE(neighbors.outdated(particles));
  particles.x[1][42] += 0.19;
  EXPECT_FALSE(neighbors.outdated(particles));
  particles.x[1][42] += 0.02;
  EXPECT_TRUE(neighbors.outdated(particles));
}

TEST(NeighborListTest, PointQueryFindsAllWithinTheRadius) {
  auto particles = test::cloud<2>({12, 12}, 1.0, 0.3);
  NeighborList<2> neighbors(4.0, 0.4);
  neighbors.build(particles);
  for (const auto& x : {std::array<double, 2>{6.1, 5.2}, {0.0, 0.0}, {-3.0, 12.5}, {40.0, 3.0}}) {
    std::set<std::size_t> found;
    const auto near = [&](std::size_t j) {
      return std::hypot(particles.x[0][j] - x[0], particles.x[1][j] - x[1]) < 4.0;
    };
    neighbors.for_each_near(x, [&](std::size_t j) {
      if (near(j)) {
        EXPECT_TRUE(found.insert(j).second) << "found twice";
      }
    });
    for (std::size_t j = 0; j < particles.n_owned; ++j) EXPECT_EQ(found.count(j), near(j) ? 1u : 0u);
  }
}

TEST(OutlookTest, FitsSpeedShiftAndAcceleration) {
  const double R = 4.0, most = 0.5, dt = 1.0;
  for (const double speed : {0.0, 0.002, 0.01, 0.05, 0.2}) {
    const auto outlook = suitable_outlook<2>(R, dt, {speed, 0.0, 0.0}, most);
    EXPECT_GE(outlook.ahead, dt) << "lists live for a step";
    EXPECT_LE(outlook.way(), most);
    const auto shifted = suitable_outlook<2>(R, dt, {speed, 0.03, 0.0}, most),
               accelerated = suitable_outlook<2>(R, dt, {speed, 0.0, 0.1}, most);
    for (const auto& restless : {shifted, accelerated}) {
      EXPECT_LE(restless.ahead, outlook.ahead);
      EXPECT_GE(restless.stray, std::min(outlook.stray, 0.03 * restless.ahead));
    }
  }
  const auto too_fast = suitable_outlook<2>(R, dt, {1.0, 0.0, 0.0}, most);
  EXPECT_LT(too_fast.ahead, dt);
  EXPECT_NEAR(too_fast.way(), most, 1e-15);
}

/// Pairs within `radius` of each other that are not in the lists.
template <int D>
std::size_t missing_pairs(const Particles<D>& particles, const NeighborList<D>& neighbors, double radius) {
  std::size_t missing = 0;
  for (std::size_t i = 0; i < particles.n_owned; ++i) {
    const std::set<std::int32_t> row(neighbors.list() + neighbors.start()[i],
                                     neighbors.list() + neighbors.start()[i + 1]);
    for (std::size_t j = 0; j < particles.n_owned; ++j) {
      if (i != j && distance(particles, i, j) < radius)
        missing += row.count(static_cast<std::int32_t>(j)) == 0;
    }
  }
  return missing;
}

/// A cloud in which everybody goes somewhere else, the last one straight through all others.
template <int D>
void expect_lists_hold_along_paths(Particles<D> particles, double radius) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> component(-1.0, 1.0);
  for (std::size_t d = 0; d < D; ++d)
    for (std::size_t i = 0; i < particles.n_owned; ++i) particles.u[d][i] = component(random);
  particles.u[0][particles.n_owned - 1] = -6.0;
  const Outlook outlook{0.5, 6.5, 0.05};
  NeighborList<D> neighbors(radius, 0.0);
  neighbors.set_outlook(outlook);
  neighbors.build(particles, 2.0);
  const std::size_t n_pairs = neighbors.n_pairs();
  const auto start = particles;
  for (const double gone : {0.0, 0.1, 0.25, 0.4, 0.5}) {
    for (std::size_t d = 0; d < D; ++d)
      for (std::size_t i = 0; i < particles.n_owned; ++i)
        particles.x[d][i] = start.x[d][i] + gone * start.u[d][i] + 0.028 * component(random);
    EXPECT_FALSE(neighbors.outdated(particles, 2.0 + gone)) << gone;
    EXPECT_EQ(missing_pairs(particles, neighbors, radius), 0u) << gone;
  }
  for (std::size_t d = 0; d < D; ++d)
    for (std::size_t i = 0; i < particles.n_owned; ++i)
      particles.x[d][i] = start.x[d][i] + 0.5 * start.u[d][i];
  EXPECT_FALSE(neighbors.outdated(particles, 2.5));
  EXPECT_TRUE(neighbors.outdated(particles, 2.3)) << "ahead of the time";
  EXPECT_TRUE(neighbors.outdated(particles, 2.5, 0.1)) << "beyond the ends of the paths";
  NeighborList<D> plain(radius, 2.0 * outlook.way());
  plain.build(start);
  EXPECT_LT(n_pairs, plain.n_pairs() / 2) << "only those that meet";
}

TEST(NeighborListTest, HoldsWhileParticlesStayOnTheirPaths) {
  expect_lists_hold_along_paths<2>(test::cloud<2>({14, 11}, 1.0, 0.4), 4.0);
  expect_lists_hold_along_paths<3>(test::cloud<3>({8, 7, 6}, 1.0, 0.4), 2.7);
}

TEST(NeighborListTest, HoldsWhereSomebodyIsFasterThanForeseen) {
  auto particles = test::cloud<2>({14, 11}, 1.0, 0.3);
  for (double& u : particles.u[0]) u = 1.0;
  particles.u[0][3] = 5.0;
  NeighborList<2> neighbors(3.0, 0.0);
  neighbors.set_outlook({0.5, 1.0, 0.1});
  neighbors.build(particles);
  for (double gone = 0.0; !neighbors.outdated(particles, gone); gone += 0.01) {
    EXPECT_EQ(missing_pairs(particles, neighbors, 3.0), 0u) << gone;
    for (std::size_t i = 0; i < particles.n_owned; ++i) particles.x[0][i] += 0.01 * particles.u[0][i];
  }
}

TEST(NeighborListTest, ListsJustMadeAreNotMadeAnew) {
  auto particles = test::cloud<2>({8, 8}, 1.0, 0.3);
  NeighborList<2> neighbors(3.0, 0.2);
  neighbors.build(particles);
  particles.u[0][7] = 1.0;
  EXPECT_FALSE(neighbors.outdated(particles, 0.0, 5.0)) << "they would be the same";
  particles.x[0][3] += 0.01;
  EXPECT_TRUE(neighbors.outdated(particles, 0.0, 5.0));
}

}  // namespace
}  // namespace littoral::sph
