#include <gtest/gtest.h>

#include <cmath>

#include "clouds.hpp"
#include "coupling/samples.hpp"
#include "physics/surface.hpp"

namespace littoral::sph {
namespace {

constexpr double k_pi = 3.14159265358979323846;

/// Water of spacing 1 in rings (2-D) or shells (3-D) about the origin, each half a spacing inside the next
/// whole radius.
template <int D>
Particles<D> ball(int rows) {
  Particles<D> particles;
  const auto add = [&](const std::array<double, D>& x, double V) {
    NewParticle<D> born;
    born.x = x;
    born.V = born.m = V;
    particles.append(born);
  };
  for (int row = 0; row < rows; ++row) {
    const double r = row + 0.5;
    if constexpr (D == 2) {
      const int n = static_cast<int>(std::round(2.0 * k_pi * r));
      for (int k = 0; k < n; ++k) {
        const double angle = 2.0 * k_pi * (k + 0.3 * row) / n;
        add({r * std::cos(angle), r * std::sin(angle)}, 2.0 * k_pi * r / n);
      }
    } else {
      const int n = static_cast<int>(std::round(4.0 * k_pi * (r * r + 1.0 / 12.0)));
      for (int k = 0; k < n; ++k) {  // evenly spread on a sphere: heights equal, turned by the golden angle
        const double z = 1.0 - (2.0 * k + 1.0) / n, s = std::sqrt(1.0 - z * z);
        const double angle = k_pi * (3.0 - std::sqrt(5.0)) * k + row;
        add({r * s * std::cos(angle), r * s * std::sin(angle), r * z}, 4.0 * k_pi * (r * r + 1.0 / 12.0) / n);
      }
    }
  }
  return particles;
}

/// Finds the surface of the particles, then phi at the targets. band: 3 spacings
template <int D>
coupler::Samples level_set(Particles<D>& particles, const DomainBox<D>& box, double radius,
                           const coupler::Targets& targets) {
  NeighborList<D> neighbors(radius, 0.1);
  Ghosts<D> ghosts(box);
  ghosts.create(particles, neighbors.reach());
  neighbors.build(particles);
  SurfaceDetection<D> surface;
  surface.detect(particles, neighbors, ghosts);
  surface.mark_near(particles, neighbors, ghosts);
  coupler::Samples samples;
  samples.resize(targets.size(), true);
  samples.coverage.assign(targets.size(), 0.0);
  sample_level_set(SurfaceDistance<D>(particles, ghosts, radius, 1.0, 3.0), 3.0, targets, samples);
  return samples;
}

template <int D>
DomainBox<D> everywhere() {
  DomainBox<D> box;
  box.lower.fill(-50.0);
  box.upper.fill(50.0);
  return box;
}

void add_target(coupler::Targets& targets, double x, double y, double z) {
  targets.x.push_back(x);
  targets.y.push_back(y);
  targets.z.push_back(z);
  targets.wants.push_back(coupler::wants_phi);
}

TEST(LevelSetTest, DoesNotDependOnTheOrderInMemory) {
  coupler::Targets targets;
  for (int k = 0; k < 40; ++k) add_target(targets, 12.3 * std::cos(0.16 * k), 0.0, 12.3 * std::sin(0.16 * k));
  auto particles = ball<2>(12), turned = particles;
  std::vector<std::int32_t> order(particles.n_owned);
  for (std::size_t k = 0; k < order.size(); ++k)
    order[k] = static_cast<std::int32_t>((7 * k + 3) % order.size());
  turned.permute(order);
  const auto expected = level_set<2>(particles, everywhere<2>(), 4.0, targets),
             found = level_set<2>(turned, everywhere<2>(), 4.0, targets);
  for (std::size_t k = 0; k < targets.size(); ++k) EXPECT_EQ(expected.phi[k], found.phi[k]) << k;
}

/// Points of the band around a ball, two spacings to either side.
template <int D>
void expect_distance_to_ball(int rows, double radius) {
  auto particles = ball<D>(rows);
  coupler::Targets targets;
  for (int k = 0; k < 60; ++k) {
    const double r = rows + 2.0 * std::sin(7.0 * k), angle = 0.37 * k, tilt = D == 3 ? 1.1 * k : 0.0;
    add_target(targets, r * std::cos(angle) * std::cos(tilt), r * std::cos(angle) * std::sin(tilt),
               r * std::sin(angle));
  }
  const auto samples = level_set<D>(particles, everywhere<D>(), radius, targets);
  for (std::size_t t = 0; t < targets.size(); ++t)
    EXPECT_NEAR(
        samples.phi[t],
        std::sqrt(targets.x[t] * targets.x[t] + targets.y[t] * targets.y[t] + targets.z[t] * targets.z[t]) -
            rows,
        0.25);
}

TEST(LevelSetTest, IsTheDistanceToACircleAndASphere) {  // (20), gate a quarter of the spacing
  expect_distance_to_ball<2>(14, 4.0);
  expect_distance_to_ball<2>(14, 3.0);
  expect_distance_to_ball<3>(9, 2.7);
}

TEST(LevelSetTest, IsTheDistanceToThePlaneOfATank) {
  using Side = support::Scene::Side;
  auto particles = test::cloud<3>({8, 8, 8}, 1.0, 0.05);
  DomainBox<3> box;
  box.upper = {8.0, 8.0, 20.0};
  for (auto& sides : box.sides) sides = {Side::symmetry, Side::symmetry};
  box.sides[2][1] = Side::open;
  coupler::Targets targets;
  for (int k = 0; k < 30; ++k)
    add_target(targets, 0.27 * k, 4.0 + 3.9 * std::sin(k), 8.0 + 2.0 * std::cos(k));
  const auto samples = level_set<3>(particles, box, 2.7, targets);
  for (std::size_t t = 0; t < targets.size(); ++t) EXPECT_NEAR(samples.phi[t], targets.z[t] - 8.0, 0.25);
}

}  // namespace
}  // namespace littoral::sph
