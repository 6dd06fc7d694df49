#include "boundary/ghosts.hpp"

#include <gtest/gtest.h>

#include <set>

#include "clouds.hpp"
#include "littoral/error.hpp"

namespace littoral::sph {
namespace {

using Side = support::Scene::Side;

template <int D>
DomainBox<D> box(double length, Side side) {
  DomainBox<D> b;
  b.upper.fill(length);
  for (auto& sides : b.sides) sides = {side, side};
  return b;
}

/// A periodic or mirrored lattice seen with its copies is a larger lattice: every interior and copied place
/// within reach is occupied exactly once, corners included.
template <int D>
void expect_larger_lattice(Side side) {
  std::array<int, D> n;
  n.fill(6);
  auto particles = test::cloud<D>(n, 1.0);
  Ghosts<D> ghosts(box<D>(6.0, side));
  ghosts.create(particles, 3.1);  // copies within 3.1 outside: rows at .5, 1.5, 2.5
  std::set<std::array<int, D>> places;
  for (std::size_t k = 0; k < particles.size(); ++k) {
    std::array<int, D> place;
    for (std::size_t d = 0; d < D; ++d) place[d] = static_cast<int>(std::lround(particles.x[d][k] - 0.5));
    EXPECT_TRUE(places.insert(place).second);
  }
  EXPECT_EQ(places.size(), static_cast<std::size_t>(std::pow(12, D)));
}

TEST(GhostsTest, CopiesExtendTheLattice) {
  expect_larger_lattice<2>(Side::periodic);
  expect_larger_lattice<2>(Side::symmetry);
  expect_larger_lattice<3>(Side::periodic);
  expect_larger_lattice<3>(Side::symmetry);
}

TEST(GhostsTest, MirrorImagesTurnNormalComponentsOfVectorsAndGradients) {
  Particles<2> particles = test::cloud<2>({1, 1}, 1.0);
  particles.u[0][0] = 2.0;
  particles.u[1][0] = 3.0;
  DomainBox<2> b = box<2>(10.0, Side::symmetry);
  b.sides[1] = {Side::open, Side::open};
  Ghosts<2> ghosts(b);
  ghosts.create(particles, 1.0);
  ASSERT_EQ(particles.n_ghost, 1u);
  EXPECT_EQ(particles.x[0][1], -0.5);
  EXPECT_EQ(particles.u[0][1], -2.0);
  EXPECT_EQ(particles.u[1][1], 3.0);
  using Rows = PairRows<2, double>;
  Rows rows;
  rows.pack_states(particles, Kernel<2>(1.0), 0.0);
  rows.set_gradients(0, {5.0, 4.0}, {{{6.0, 7.0}, {8.0, 9.0}}});
  ghosts.refresh(rows);
  const double* image = rows.face(1).q;
  EXPECT_EQ(image[Rows::k_grad_p], -5.0);
  EXPECT_EQ(image[Rows::k_grad_p + 1], 4.0);
  EXPECT_EQ(image[Rows::k_strain], 6.0);
  EXPECT_EQ(image[Rows::k_strain + 1], -15.0);
  EXPECT_EQ(image[Rows::k_strain + 2], 9.0);
}

TEST(GhostsTest, BringBackWrapsMirrorsAndNamesTheLost) {
  DomainBox<2> b = box<2>(10.0, Side::periodic);
  b.sides[1] = {Side::symmetry, Side::open};
  const Ghosts<2> ghosts(b);
  Particles<2> particles = test::cloud<2>({1, 1}, 1.0);
  particles.x = {{{-0.25}, {-0.1}}};
  particles.u[1][0] = -1.0;
  EXPECT_EQ(ghosts.bring_back(particles, 0.5, 0.0), 1u);
  EXPECT_EQ(particles.x[0][0], 9.75);
  EXPECT_EQ(particles.x[1][0], 0.1);
  EXPECT_EQ(particles.u[1][0], 1.0);
  particles.x[1][0] = -0.6;
  EXPECT_THROW(ghosts.bring_back(particles, 0.5, 0.0), StabilityError);
  particles.x[1][0] = 15.0;  // a drop above the open face is still ours
  EXPECT_EQ(ghosts.bring_back(particles, 0.5, 0.0), 0u);
  particles.x[1][0] = 25.0;
  EXPECT_THROW(ghosts.bring_back(particles, 0.5, 0.0), StabilityError);
}

}  // namespace
}  // namespace littoral::sph
