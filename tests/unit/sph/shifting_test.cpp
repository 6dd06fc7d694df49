#include "physics/shifting.hpp"

#include <gtest/gtest.h>

#include "clouds.hpp"

namespace littoral::sph {
namespace {

using Side = support::Scene::Side;

struct Shifted {
  Particles<2> particles;
  std::vector<double> distance;
};

Shifted shift(Particles<2> particles, const DomainBox<2>& box, double velocity, bool free_surface) {
  NeighborList<2> neighbors(4.0, 0.1);
  Ghosts<2> ghosts(box);
  ghosts.create(particles, neighbors.reach());
  neighbors.build(particles);
  SurfaceDetection<2> surface;
  if (free_surface) {
    surface.detect(particles, neighbors, ghosts);
    surface.mark_near(particles, neighbors, ghosts);
  }
  Shifting<2>(velocity).compute(particles, neighbors, free_surface ? &surface : nullptr);
  return {std::move(particles), surface.distance()};
}

DomainBox<2> periodic() {
  DomainBox<2> box;
  box.upper = {16.0, 16.0};
  box.sides = {{{Side::periodic, Side::periodic}, {Side::periodic, Side::periodic}}};
  return box;
}

double length(const Particles<2>& particles, std::size_t i) {
  return std::hypot(particles.shift[0][i], particles.shift[1][i]);
}

TEST(ShiftingTest, ALatticeIsNotShifted) {
  const auto result = shift(test::cloud<2>({16, 16}, 1.0), periodic(), 1.0, false);
  for (std::size_t i = 0; i < result.particles.n_owned; ++i)
    EXPECT_NEAR(length(result.particles, i), 0.0, 1e-13);
}

TEST(ShiftingTest, PointsIntoAVoid) {
  auto particles = test::cloud<2>({16, 16}, 1.0);
  std::vector<char> doomed(particles.n_owned, 0);
  doomed[8 * 16 + 8] = 1;
  particles.remove(doomed);
  const auto result = shift(particles, periodic(), 1.0, false);
  for (std::size_t i = 0; i < result.particles.n_owned; ++i) {
    const double x = 8.5 - result.particles.x[0][i], z = 8.5 - result.particles.x[1][i];
    if (std::hypot(x, z) < 4.0) {
      EXPECT_GT(result.particles.shift[0][i] * x + result.particles.shift[1][i] * z, 0.0);
    } else {
      EXPECT_NEAR(length(result.particles, i), 0.0, 1e-13);
    }
  }
}

TEST(ShiftingTest, IsProportionalToTheReferenceVelocityAndCappedAtAQuarter) {
  const auto cloud = test::cloud<2>({16, 16}, 1.0, 0.45);
  const auto slow = shift(cloud, periodic(), 1.0, false), fast = shift(cloud, periodic(), 8.0, false);
  bool capped = false;
  for (std::size_t i = 0; i < cloud.n_owned; ++i) {
    EXPECT_LE(length(slow.particles, i), 0.25 + 1e-12);
    EXPECT_NEAR(length(fast.particles, i), 8.0 * length(slow.particles, i), 1e-12);
    capped = capped || length(slow.particles, i) > 0.2499;
  }
  EXPECT_TRUE(capped) << "the cloud is disordered enough for the cap to act somewhere";
}

/// Splashes: nothing to be spread evenly, so whatever is left alone flies on.
TEST(ShiftingTest, LoneParticlesAndThinSheetsAreNotShifted) {
  DomainBox<2> box;
  box.upper = {40.0, 40.0};
  const std::vector<std::array<int, 2>> shapes = {{1, 1}, {2, 1}, {2, 2}, {20, 1}, {20, 2}};
  for (const auto& shape : shapes) {
    const auto result = shift(test::cloud<2>(shape, 1.0, 0.2), box, 1.0, true);
    for (std::size_t i = 0; i < result.particles.n_owned; ++i)
      EXPECT_EQ(length(result.particles, i), 0.0) << shape[0] << " by " << shape[1];
  }
}

/// The shift along the surface grows with the distance from it and is whole a kernel radius below.
TEST(ShiftingTest, FadesTowardsTheSurface) {
  DomainBox<2> box = periodic();
  box.sides[1] = {Side::symmetry, Side::open};
  const auto cloud = test::cloud<2>({16, 16}, 1.0, 0.05);
  const auto with = shift(cloud, box, 1.0, true), without = shift(cloud, box, 1.0, false);
  for (std::size_t i = 0; i < with.particles.n_owned; ++i) {
    const double depth = 16.0 - with.particles.x[1][i];
    if (depth > 5.0) {
      EXPECT_EQ(length(with.particles, i), length(without.particles, i));
    }
    EXPECT_LE(length(with.particles, i), with.distance[i] * length(without.particles, i) + 1e-12);
  }
}

TEST(ShiftingTest, NearASurfaceOnlyAlongItAndNotOnIt) {
  DomainBox<2> box = periodic();
  box.sides[1] = {Side::symmetry, Side::open};
  const auto result = shift(test::cloud<2>({16, 16}, 1.0, 0.15), box, 1.0, true);
  int n_near = 0;
  for (std::size_t i = 0; i < result.particles.n_owned; ++i) {
    if (result.particles.surface[i] == SurfaceFlag::surface) {
      EXPECT_EQ(length(result.particles, i), 0.0);
    }
    if (result.particles.surface[i] != SurfaceFlag::near) continue;
    ++n_near;
    EXPECT_LT(result.distance[i], 1.0);
    EXPECT_NEAR(result.particles.shift[0][i] * result.particles.normal[0][i] +
                    result.particles.shift[1][i] * result.particles.normal[1][i],
                0.0, 1e-12);
  }
  EXPECT_GT(n_near, 16);
}

}  // namespace
}  // namespace littoral::sph
