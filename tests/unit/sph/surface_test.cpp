#include "physics/surface.hpp"

#include <gtest/gtest.h>

#include "clouds.hpp"
#include "physics/kernel.hpp"
#include "physics/symmetric_matrix.hpp"

namespace littoral::sph {
namespace {

using Side = support::Scene::Side;

template <int D>
struct Detected {
  Particles<D> particles;
  SurfaceDetection<D> surface;
};

template <int D>
Detected<D> detect(Particles<D> particles, double radius, const DomainBox<D>& box) {
  Detected<D> result;
  NeighborList<D> neighbors(radius, 0.1);
  Ghosts<D> ghosts(box);
  ghosts.create(particles, neighbors.reach());
  neighbors.build(particles);
  result.surface.detect(particles, neighbors, ghosts);
  result.surface.mark_near(particles, neighbors, ghosts);
  result.particles = std::move(particles);
  return result;
}

template <int D>
DomainBox<D> open_box(double length) {
  DomainBox<D> b;
  b.upper.fill(length);
  for (auto& sides : b.sides) sides = {Side::open, Side::open};
  return b;
}

TEST(SymmetricMatrixTest, SmallestEigenvalueAndInverse) {
  const SymmetricMatrix<2> a{{2.0, 1.0, 2.0}};
  EXPECT_NEAR(a.smallest_eigenvalue(), 1.0, 1e-14);
  const SymmetricMatrix<3> b{{2.0, -1.0, 0.0, 2.0, -1.0, 2.0}};  // eigenvalues 2 - sqrt 2, 2, 2 + sqrt 2
  EXPECT_NEAR(b.smallest_eigenvalue(), 2.0 - std::sqrt(2.0), 1e-13);
  EXPECT_LE(b.least_eigenvalue_at_least(), b.smallest_eigenvalue());
  const auto x = b.inverse() * (b * std::array<double, 3>{1.0, -2.0, 3.0});
  EXPECT_NEAR(x[1], -2.0, 1e-13);
  EXPECT_EQ((SymmetricMatrix<3>{{3.0, 0.0, 0.0, 3.0, 0.0, 3.0}}).smallest_eigenvalue(), 3.0);
}

struct TableRow {
  int dimension;
  double radius, interior, surface_row, second_row, corner;
};

// Smallest eigenvalues on a lattice, computed independently to three decimals. At a corner (in 3-D: an edge)
// the tabulated value is the diagonal of B; its smallest eigenvalue is lower by the off-diagonal sum over the
// quarter.
template <int D>
double quarter_off_diagonal(double radius) {
  const Kernel<D> kernel(radius);
  double sum = 0.0;
  for (int i = 1; i < 5; ++i)
    for (int k = 1; k < 5; ++k)
      for (int j = D == 3 ? -4 : 0; j <= (D == 3 ? 4 : 0); ++j)
        sum -= i * k * kernel.slope_over_r(std::sqrt(i * i + j * j + k * k));
  return sum;
}

template <int D>
void expect_table(const TableRow& row) {
  std::array<int, D> n;
  n.fill(12);
  const auto found = detect<D>(test::cloud<D>(n, 1.0), row.radius, open_box<D>(12.0));
  const auto at = [&](const std::array<int, D>& place) {
    int index = 0;
    for (int k : place) index = index * 12 + k;
    return found.surface.eigenvalue()[static_cast<std::size_t>(index)];
  };
  std::array<int, D> place;
  place.fill(6);
  EXPECT_NEAR(at(place), row.interior, 6e-4);
  place[D - 1] = 11;
  EXPECT_NEAR(at(place), row.surface_row, 6e-4);
  place[D - 1] = 10;
  EXPECT_NEAR(at(place), row.second_row, 6e-4);
  place[D - 1] = 11;
  place[0] = 11;
  EXPECT_NEAR(at(place), row.corner - quarter_off_diagonal<D>(row.radius), 6e-4);
}

TEST(SurfaceTest, EigenvaluesOnALatticeAgreeWithTable) {
  expect_table<2>({2, 3.0, .997, .499, .842, .372});
  expect_table<2>({2, 4.0, .999, .500, .700, .342});
  expect_table<3>({3, 2.7, .984, .492, .908, .383});
  expect_table<3>({3, 3.0, 1.001, .500, .859, .375});
}

/// A block of water: exactly the particles of the outer row, corners included.
template <int D>
void expect_outer_row(double radius) {
  std::array<int, D> n;
  n.fill(D == 2 ? 16 : 10);
  const double length = n[0];
  const auto found = detect<D>(test::cloud<D>(n, 1.0), radius, open_box<D>(length));
  for (std::size_t i = 0; i < found.particles.n_owned; ++i) {
    bool outer = false;
    for (std::size_t d = 0; d < D; ++d)
      outer = outer || found.particles.x[d][i] < 1.0 || found.particles.x[d][i] > length - 1.0;
    EXPECT_EQ(found.particles.surface[i] == SurfaceFlag::surface, outer) << "particle " << i;
  }
}

TEST(SurfaceTest, BlockHasItsOuterRow) {
  expect_outer_row<2>(3.0);
  expect_outer_row<2>(4.0);
  expect_outer_row<3>(2.7);
  expect_outer_row<3>(3.0);
}

/// A tank: symmetry planes below and at the sides are no surface; the top row is, with normals upwards.
template <int D>
void expect_tank_surface(double radius) {
  std::array<int, D> n;
  n.fill(D == 2 ? 14 : 9);
  DomainBox<D> box = open_box<D>(n[0]);
  for (auto& sides : box.sides) sides = {Side::symmetry, Side::symmetry};
  box.sides[D - 1][1] = Side::open;
  const auto found = detect<D>(test::cloud<D>(n, 1.0), radius, box);
  for (std::size_t i = 0; i < found.particles.n_owned; ++i) {
    const double depth = n[0] - found.particles.x[D - 1][i];
    EXPECT_EQ(found.particles.surface[i] == SurfaceFlag::surface, depth < 1.0);
    // near: rows whose distance to the top row is less than the radius
    EXPECT_EQ(found.particles.surface[i] == SurfaceFlag::near, depth > 1.0 && depth - 0.5 < radius);
    if (found.particles.surface[i] != SurfaceFlag::none) {
      EXPECT_NEAR(found.particles.normal[D - 1][i], 1.0, 1e-12);
    }
  }
}

TEST(SurfaceTest, TankHasItsTopRow) {
  expect_tank_surface<2>(4.0);
  expect_tank_surface<2>(3.0);
  expect_tank_surface<3>(2.7);
}

/// Disc and sphere cut out of a lattice. A particle that misses a neighbour along an axis is on the surface,
/// one that has all 3^D - 1 neighbours around it is not; between the two (a diagonal neighbour missing)
/// either is right.
template <int D>
void expect_ball(double radius, double ball) {
  std::array<int, D> n;
  n.fill(2 * static_cast<int>(ball) + 3);
  const double centre = 0.5 * n[0];
  const auto inside = [&](const std::array<double, D>& x) {
    double r2 = 0.0;
    for (std::size_t d = 0; d < D; ++d) r2 += (x[d] - centre) * (x[d] - centre);
    return r2 < ball * ball;
  };
  const auto found = detect<D>(test::cloud<D>(n, 1.0, 0.0, inside), radius, open_box<D>(n[0]));
  for (std::size_t i = 0; i < found.particles.n_owned; ++i) {
    std::array<double, D> x;
    for (std::size_t d = 0; d < D; ++d) x[d] = found.particles.x[d][i];
    bool all_along_axes = true, all_around = true;
    for (int code = 0; code < (D == 2 ? 9 : 27); ++code) {
      auto y = x;
      int rest = code, moved = 0;
      for (std::size_t d = 0; d < D; ++d, rest /= 3) {
        y[d] += rest % 3 - 1;
        moved += rest % 3 != 1;
      }
      all_around = all_around && inside(y);
      if (moved == 1) all_along_axes = all_along_axes && inside(y);
    }
    const bool flagged = found.particles.surface[i] == SurfaceFlag::surface;
    if (!all_along_axes) {
      EXPECT_TRUE(flagged) << "outer particle missed, " << i;
      double cosine = 0.0, r = 0.0;
      for (std::size_t d = 0; d < D; ++d) {
        cosine += found.particles.normal[d][i] * (x[d] - centre);
        r += (x[d] - centre) * (x[d] - centre);
      }
      EXPECT_GT(cosine / std::sqrt(r), 0.9);
    }
    if (all_around) {
      EXPECT_FALSE(flagged) << "inner particle flagged, " << i;
    }
  }
}

TEST(SurfaceTest, DiscAndSphereHaveTheirOuterRow) {
  expect_ball<2>(4.0, 12.3);
  expect_ball<2>(3.0, 12.3);
  expect_ball<3>(2.7, 6.4);
}

TEST(SurfaceTest, SheetsOfOneAndTwoRowsAreAllSurface) {
  for (int rows : {1, 2}) {
    for (double radius : {3.0, 4.0}) {
      const auto found = detect<2>(test::cloud<2>({20, rows}, 1.0), radius, open_box<2>(20.0));
      for (auto flag : found.particles.surface) EXPECT_EQ(flag, SurfaceFlag::surface);
    }
    const auto found = detect<3>(test::cloud<3>({9, 9, rows}, 1.0), 2.7, open_box<3>(9.0));
    for (auto flag : found.particles.surface) EXPECT_EQ(flag, SurfaceFlag::surface);
  }
}

/// A drop a few spacings above the water: what has left is surface whatever its size, and knows which way the
/// water is not.
TEST(SurfaceTest, SplashesAboveWaterAreSurface) {
  for (int rows : {1, 2}) {
    auto cloud = test::cloud<2>({21, 20}, 1.0, 0.0, [&](const std::array<double, 2>& x) {
      const bool splash = std::fabs(x[0] - 10.5) < rows && x[1] > 16.0 && x[1] < 16.0 + rows;
      return x[1] < 12.0 || splash;
    });
    const auto found = detect<2>(std::move(cloud), 4.0, open_box<2>(21.0));
    for (std::size_t i = 0; i < found.particles.n_owned; ++i) {
      if (found.particles.x[1][i] < 12.0) continue;
      EXPECT_EQ(found.particles.surface[i], SurfaceFlag::surface);
      EXPECT_EQ(found.surface.distance()[i], 0.0);
    }
  }
}

TEST(SurfaceTest, ALoneParticleIsSurface) {
  const auto found = detect<3>(test::cloud<3>({1, 1, 1}, 1.0), 2.7, open_box<3>(1.0));
  EXPECT_EQ(found.particles.surface[0], SurfaceFlag::surface);
}

}  // namespace
}  // namespace littoral::sph
