#include "particles/particles.hpp"

#include <gtest/gtest.h>

#include "clouds.hpp"

namespace littoral::sph {
namespace {

TEST(ParticlesTest, AppendDropsCopiesAndGivesFreshIds) {
  auto particles = test::cloud<2>({2, 1}, 1.0);
  particles.resize_ghosts(3);
  EXPECT_EQ(particles.size(), 5u);
  NewParticle<2> born;
  born.x = {7.0, 8.0};
  born.V = 0.5;
  born.m = 1.0;
  particles.append(born);
  EXPECT_EQ(particles.n_ghost, 0u);
  EXPECT_EQ(particles.n_owned, 3u);
  EXPECT_EQ(particles.x[1].size(), 3u);
  EXPECT_EQ(particles.x[1][2], 8.0);
  EXPECT_EQ(particles.rho[2], 2.0);
  EXPECT_EQ(particles.id[2], 2);
}

TEST(ParticlesTest, RemoveKeepsTheOthersInOrderAndNeverReusesIds) {
  auto particles = test::cloud<3>({4, 1, 1}, 1.0);
  particles.remove({0, 1, 0, 1});
  ASSERT_EQ(particles.n_owned, 2u);
  EXPECT_EQ(particles.id, (std::vector<std::int64_t>{0, 2}));
  EXPECT_EQ(particles.x[0], (std::vector<double>{0.5, 2.5}));
  particles.append({});
  EXPECT_EQ(particles.id.back(), 4);
}

TEST(ParticlesTest, PermuteMovesEveryColumnAlike) {
  auto particles = test::cloud<2>({3, 1}, 1.0);
  for (std::size_t i = 0; i < 3; ++i) {
    particles.shift[1][i] = static_cast<double>(i);
    particles.zone[i] = static_cast<Zone>(i);
  }
  particles.permute({2, 0, 1});
  EXPECT_EQ(particles.id, (std::vector<std::int64_t>{2, 0, 1}));
  EXPECT_EQ(particles.x[0], (std::vector<double>{2.5, 0.5, 1.5}));
  EXPECT_EQ(particles.shift[1], (std::vector<double>{2.0, 0.0, 1.0}));
  EXPECT_EQ(particles.zone[0], Zone::driven);
}

}  // namespace
}  // namespace littoral::sph
