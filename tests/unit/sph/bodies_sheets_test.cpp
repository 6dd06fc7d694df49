#include <gtest/gtest.h>

#include "bodies_models.hpp"
#include "littoral/error.hpp"

namespace littoral::sph {
namespace {

using test::k_g;

/// An upright plate across a tank [0, n]^D at x = 1/2 n, from below the floor up to `top`.
template <int D>
Spec upright_plate(double n, double top) {
  Spec s;
  s.name = "plate";
  s.shape = Spec::Shape::plate;
  const double bottom = -6.0;
  s.size = {top - bottom, n + 12.0, 0.0};
  s.rotation = {0, 90, 0};
  s.position = {0.5 * n, D == 3 ? 0.5 * n : 0.0, 0.5 * (top + bottom)};
  return s;
}

/// Still water at two levels, `n` on the left and `right` on the right of x = n/2.
template <int D>
Particles<D> two_levels(int n, int right) {
  auto particles = test::still_water<D>(n);
  std::vector<char> dry(particles.n_owned, 0);
  for (std::size_t i = 0; i < particles.n_owned; ++i) {
    if (particles.x[0][i] < 0.5 * n) continue;
    dry[i] = particles.x[D - 1][i] > right;
    particles.p[i] = k_g * (right - particles.x[D - 1][i]);
  }
  particles.remove(dry);
  return particles;
}

template <int D>
void expect_each_side_at_rest(int n, int right) {
  const auto numerics = test::numerics_of_unit_lattice<D>();
  auto particles = two_levels<D>(n, right);
  const std::vector<Spec> specs = {test::tank(D, n), upright_plate<D>(n, 2.0 * n)};
  auto walls = test::walls_of<D>(specs, numerics, test::open_box<D>(n));
  Walls<D>* seen = walls.get();
  Dynamics<D> dynamics(numerics, test::open_box<D>(n), nullptr, std::move(walls));
  dynamics.prepare(particles, 0.0, nullptr);
  dynamics.right_hand_side(particles, 0.0);
  const double R = numerics.kernel_radius;
  double least = 1e9, most = -1e9, across = 0.0, swelling = 0.0;
  for (std::size_t i = 0; i < particles.n_owned; ++i) {
    const double level = particles.x[0][i] < 0.5 * n ? n : right;
    if (particles.x[D - 1][i] > level - R) continue;  // the surface truncates the kernel
    least = std::min(least, dynamics.rate().acceleration[D - 1][i]);
    most = std::max(most, dynamics.rate().acceleration[D - 1][i]);
    across = std::max(across, std::fabs(dynamics.rate().acceleration[0][i]));
    swelling = std::max(swelling, std::fabs(dynamics.rate().volume[i]));
  }
  EXPECT_LT(most - least, 1e-12);  // at the plate, in the corners and in the bulk
  EXPECT_LT(across, 1e-12);
  EXPECT_LT(swelling, 1e-12);
  seen->begin_step(1.0);
  seen->add_stage_loads(particles, 1.0);
  const double width = D == 3 ? n : 1.0;
  const double thrust = 0.5 * k_g * (n * n - right * right) * width;  // of the higher water
  // the rows within a kernel radius of a surface push less than their share
  EXPECT_NEAR(seen->loads()[1].pressure[0], thrust, (D == 2 ? 0.05 : 0.1) * thrust);
}
TEST(BodiesSheetsTest, WaterAtTwoLevelsRestsOnBothSidesOfAPlateIn2D) { expect_each_side_at_rest<2>(16, 10); }
TEST(BodiesSheetsTest, WaterAtTwoLevelsRestsOnBothSidesOfAPlateIn3D) { expect_each_side_at_rest<3>(10, 6); }

TEST(BodiesSheetsTest, EachPlaceOfAKernelIsInSightOrHeldByOneDummy) {
  // an inclined plate in the middle of the water and one that crosses its shadow
  const auto numerics = test::numerics_of_unit_lattice<2>();
  auto particles = test::cloud<2>({24, 24}, 1.0);
  Spec one;
  one.name = "one";
  one.shape = Spec::Shape::plate;
  one.size = {9, 0, 0};
  one.rotation = {0, 30, 0};
  one.position = {12, 0, 12.2};
  Spec two = one;
  two.name = "two";
  two.rotation = {0, -50, 0};
  two.position = {12.3, 0, 15.1};
  auto walls = test::walls_of<2>({one, two}, numerics, test::open_box<2>(24));
  NeighborList<2> neighbors(numerics.kernel_radius, numerics.skin);
  neighbors.build(particles);
  const std::vector<std::size_t> whole(neighbors.start(), neighbors.start() + neighbors.n_rows() + 1);
  walls->part(particles, neighbors);
  walls->build(particles, 0.5 * numerics.skin);
  std::size_t hidden = 0;
  for (std::size_t i = 0; i < particles.n_owned; ++i) {
    const auto in_reach = [&](double dx, double dz) {
      return std::hypot(dx, dz) < numerics.kernel_radius - 1e-9;
    };
    std::size_t places = 0, seen = 0;
    for (std::size_t j = 0; j < particles.n_owned; ++j)
      places +=
          j != i && in_reach(particles.x[0][j] - particles.x[0][i], particles.x[1][j] - particles.x[1][i]);
    for (std::size_t k = neighbors.start()[i]; k < neighbors.start()[i + 1]; ++k) {
      const auto j = static_cast<std::size_t>(neighbors.list()[k]);
      seen += in_reach(particles.x[0][j] - particles.x[0][i], particles.x[1][j] - particles.x[1][i]);
    }
    hidden += places - seen;
    if (const auto row = walls->list().row_of(i); row >= 0)
      for (std::size_t k = walls->list().begin(static_cast<std::size_t>(row));
           k < walls->list().end(static_cast<std::size_t>(row)); ++k) {
        const std::size_t e = walls->list().dummy(k);
        seen += in_reach(walls->dummies()[e].x[0] - particles.x[0][i],
                         walls->dummies()[e].x[1] - particles.x[1][i]);
      }
    EXPECT_EQ(seen, places) << particles.x[0][i] << ", " << particles.x[1][i];
  }
  EXPECT_GT(hidden, 500u);
}

TEST(BodiesSheetsTest, AParticleThatWentThroughIsPutBackFromEitherSideAndOneThatWentAroundIsNot) {
  const auto numerics = test::numerics_of_unit_lattice<2>();
  for (const double side : {-1.0, 1.0}) {
    auto particles = test::still_water<2>(10);
    auto walls = test::walls_of<2>({upright_plate<2>(10, 5.0)}, numerics, test::open_box<2>(10));
    particles.x[0][0] = 5.0 - 0.1 * side;
    particles.x[1][0] = 3.0;
    particles.x[0][1] = 5.0 - 0.1 * side;
    particles.x[1][1] = 5.1;
    walls->build(particles, 0.5 * numerics.skin);
    walls->begin_step(1.0);
    const auto start = particles.x;
    for (const std::size_t i : {0u, 1u}) {
      particles.x[0][i] = 5.0 + 0.2 * side;
      particles.u[0][i] = 2.0 * side;
    }
    EXPECT_EQ(walls->keep_out(particles, start, 0.5, 0.0), 1u);
    EXPECT_NEAR(particles.x[0][0], 5.0 - 0.2 * side, 1e-12);
    EXPECT_NEAR(particles.u[0][0], -2.0 * side, 1e-12);
    EXPECT_NEAR(particles.x[0][1], 5.0 + 0.2 * side, 1e-12);
    particles.x[0][0] = 5.0 + 0.7 * side;
    EXPECT_THROW(walls->keep_out(particles, start, 0.5, 0.0), StabilityError);
  }
}

}  // namespace
}  // namespace littoral::sph
