#include "neighbors/neighbor_list.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <set>

#include "clouds.hpp"
#include "neighbors/suitable_skin.hpp"

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

TEST(NeighborListTest, SkinFitsTheSpeed) {
  const double R = 4.0, most = 0.5;
  EXPECT_LT(suitable_skin<2>(R, 0.0, most), 0.1);
  EXPECT_EQ(suitable_skin<2>(R, 1.0, most), most);
  for (const double moved : {0.002, 0.01, 0.05, 0.2}) {
    const double skin = suitable_skin<2>(R, moved, most);
    EXPECT_GT(0.5 * skin, moved) << "lists live for a step";
    EXPECT_LE(suitable_skin<3>(R, moved, most), skin) << "in space a skin costs more pairs";
  }
}

TEST(NeighborListTest, ListsJustMadeAreNotMadeAnew) {
  auto particles = test::cloud<2>({8, 8}, 1.0, 0.3);
  NeighborList<2> neighbors(3.0, 0.2);
  neighbors.build(particles);
  particles.u[0][7] = 1.0;
  EXPECT_FALSE(neighbors.outdated(particles, 5.0)) << "they would be the same";
  particles.x[0][3] += 0.01;
  EXPECT_TRUE(neighbors.outdated(particles, 5.0));
}

}  // namespace
}  // namespace littoral::sph
