#include "particles/relaxation.hpp"

#include <gtest/gtest.h>

#include "boundary/ghosts.hpp"
#include "clouds.hpp"
#include "neighbors/neighbor_list.hpp"
#include "physics/kernel.hpp"

namespace littoral::sph {
namespace {

using Side = support::Scene::Side;

template <int D>
struct Relaxed {
  Particles<D> particles;
  double density_spread = 0.0;  // rms of sum_j V W - 1
  double closest = 1e30;        // [dx]
};

template <int D>
Relaxed<D> relaxed(int n, double radius, std::array<Side, 2> vertical) {
  DomainBox<D> box;
  Numerics<D> numerics;
  numerics.spacing = 1.0;
  numerics.kernel_radius = radius;
  numerics.skin = 0.3;
  std::array<int, D> cells;
  for (std::size_t d = 0; d < D; ++d) {
    cells[d] = n;
    box.upper[d] = n;
    box.sides[d] = {Side::periodic, Side::periodic};
  }
  box.sides[D - 1] = vertical;
  Relaxed<D> result{test::cloud<D>(cells, 1.0)};
  auto& particles = result.particles;
  relax(particles, numerics, box);
  EXPECT_EQ(particles.n_ghost, 0U);

  Ghosts<D> ghosts(box);
  ghosts.create(particles, radius);
  const Kernel<D> kernel(radius);
  for (std::size_t i = 0; i < particles.n_owned; ++i) {
    double sum = 0.0;
    for (std::size_t j = 0; j < particles.size(); ++j) {
      double r2 = 0.0;
      for (std::size_t d = 0; d < D; ++d) r2 += std::pow(particles.x[d][j] - particles.x[d][i], 2);
      sum += particles.V[j] * kernel.value(std::sqrt(r2));
      if (j != i) result.closest = std::min(result.closest, std::sqrt(r2));
    }
    result.density_spread += (sum - 1.0) * (sum - 1.0) / static_cast<double>(particles.n_owned);
  }
  result.density_spread = std::sqrt(result.density_spread);
  return result;
}

template <int D>
double displacement(const Particles<D>& particles, int n) {  // rms, apart from whole periods [dx]
  double sum = 0.0;
  for (std::size_t i = 0; i < particles.n_owned; ++i)
    for (std::size_t d = 0; d < D; ++d) {
      const double from_row = particles.x[d][i] - std::floor(particles.x[d][i]) - 0.5;
      sum += from_row * from_row / static_cast<double>(particles.n_owned * D);
    }
  EXPECT_EQ(particles.n_owned, static_cast<std::size_t>(std::pow(n, D)));
  return std::sqrt(sum);
}

// Points at random have a spread of sum V W near .1 and pairs next to each other. On the lattice the distance
// from the middle of the row is 0; places at random have 1/sqrt(12) = .289 rms, and spreading them brings
// some of the order back.
TEST(RelaxationTest, SpreadsEvenlyWithoutRows) {
  const auto result = relaxed<2>(12, 3.0, {Side::periodic, Side::periodic});
  EXPECT_LT(result.density_spread, 0.01);  // a lattice has .0051 at R = 3 dx
  EXPECT_GT(result.closest, 0.6);
  EXPECT_GT(displacement(result.particles, 12), 0.1);
}

TEST(RelaxationTest, StaysInsideSymmetryPlanes) {
  const auto result = relaxed<2>(12, 3.0, {Side::symmetry, Side::symmetry});
  EXPECT_LT(result.density_spread, 0.01);
  for (std::size_t i = 0; i < result.particles.n_owned; ++i) {
    EXPECT_GE(result.particles.x[1][i], 0.0);
    EXPECT_LE(result.particles.x[1][i], 12.0);
  }
}

TEST(RelaxationTest, SpreadsEvenlyInThreeDimensions) {
  const auto result = relaxed<3>(6, 2.7, {Side::periodic, Side::periodic});
  EXPECT_LT(result.density_spread, 0.02);
  EXPECT_GT(result.closest, 0.6);
}

}  // namespace
}  // namespace littoral::sph
