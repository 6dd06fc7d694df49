#include <gtest/gtest.h>

#include <random>

#include "bodies/wall_view.hpp"
#include "bodies/walls.hpp"
#include "clouds.hpp"
#include "littoral/error.hpp"
#include "physics/dynamics.hpp"
#include "physics/riemann_fluxes.hpp"
#include "physics/surface.hpp"

namespace littoral::sph {
namespace {

using Spec = support::BodySpec;
using Side = support::Scene::Side;

constexpr double k_g = 0.3, k_c = 20.0;

template <int D>
Numerics<D> numerics_of_unit_lattice() {
  Numerics<D> numerics;
  numerics.eos = {1.0, k_c, 0.0};
  numerics.gravity[D - 1] = -k_g;
  numerics.spacing = 1.0;
  numerics.kernel_radius = D == 2 ? 4.0 : 2.7;
  numerics.skin = 0.3;
  return numerics;
}

template <int D>
DomainBox<D> open_box(double upper) {
  DomainBox<D> box;
  for (std::size_t d = 0; d < D; ++d) {
    box.lower[d] = -6.0;
    box.upper[d] = upper + 6.0;
  }
  return box;
}

/// A tank [0, n]^D open at the top, its walls reaching far above.
Spec tank(int dimension, double n) {
  Spec s;
  s.name = "tank";
  s.shape = Spec::Shape::box;
  s.size = {n, dimension == 3 ? n : 0.0, 4 * n};
  s.position = {0.5 * n, dimension == 3 ? 0.5 * n : 0.0, 2 * n};
  s.fluid = Spec::Fluid::inside;
  return s;
}

template <int D>
std::unique_ptr<Walls<D>> walls_of(const std::vector<Spec>& specs, const Numerics<D>& numerics,
                                   const DomainBox<D>& box) {
  std::vector<Body> bodies;
  for (const auto& spec : specs) bodies.emplace_back(spec, D == 2, 0.1);
  return std::make_unique<Walls<D>>(std::move(bodies), numerics, box, Lattice<D>{{}, numerics.spacing});
}

template <int D>
Particles<D> still_water(int n) {
  std::array<int, D> cells;
  cells.fill(n);
  auto particles = test::cloud<D>(cells, 1.0);
  for (std::size_t i = 0; i < particles.n_owned; ++i) particles.p[i] = k_g * (n - particles.x[D - 1][i]);
  return particles;
}

/// Next to flat walls and in their corners the pairs must give what a complete lattice of water gives.
template <int D>
void expect_rest_as_in_the_bulk(int n) {
  const auto numerics = numerics_of_unit_lattice<D>();
  auto particles = still_water<D>(n);
  Dynamics<D> dynamics(numerics, open_box<D>(n), nullptr,
                       walls_of<D>({tank(D, n)}, numerics, open_box<D>(n)));
  dynamics.prepare(particles, 0.0, nullptr);
  dynamics.right_hand_side(particles, 0.0);
  const double R = numerics.kernel_radius;
  double bulk = 0.0, most = 0.0;
  for (std::size_t i = 0; i < particles.n_owned; ++i) {
    bool centre = true;
    for (std::size_t d = 0; d < D; ++d) centre = centre && std::fabs(particles.x[d][i] - 0.5 * n) < 1.0;
    if (centre) bulk = dynamics.rate().acceleration[D - 1][i];
  }
  EXPECT_LT(std::fabs(bulk), 0.02 * k_g);  // what the lattice leaves of the balance, 1 - trace B / D
  for (std::size_t i = 0; i < particles.n_owned; ++i) {
    if (particles.x[D - 1][i] > n - R) continue;  // the surface truncates the kernel
    for (std::size_t d = 0; d < D; ++d)
      most = std::max(most, std::fabs(dynamics.rate().acceleration[d][i] - (d == D - 1 ? bulk : 0.0)));
    most = std::max(most, std::fabs(dynamics.rate().volume[i]));
  }
  EXPECT_LT(most, 1e-12);
}
TEST(BodiesWallsTest, WaterAtRestFeelsWallsAsWaterIn2D) { expect_rest_as_in_the_bulk<2>(14); }
TEST(BodiesWallsTest, WaterAtRestFeelsWallsAsWaterIn3D) { expect_rest_as_in_the_bulk<3>(10); }

template <int D>
void randomise(Particles<D>& particles) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  for (std::size_t i = 0; i < particles.n_owned; ++i) {
    for (auto& column : particles.u) column[i] = value(random);
    for (auto& column : particles.x) column[i] += 0.2 * value(random);
    particles.p[i] = 20.0 * value(random);
  }
}

/// What the water loses the bodies get, pressure and friction, for any states.
template <int D>
void expect_momentum_balance(int n, double viscosity) {
  auto numerics = numerics_of_unit_lattice<D>();
  numerics.viscosity = viscosity;
  auto particles = still_water<D>(n);
  randomise(particles);
  Spec rough = tank(D, n);
  rough.slip = Spec::Slip::none;
  auto walls = walls_of<D>({rough}, numerics, open_box<D>(n));
  Walls<D>* seen = walls.get();
  Dynamics<D> dynamics(numerics, open_box<D>(n), nullptr, std::move(walls));
  dynamics.prepare(particles, 0.0, nullptr);
  dynamics.right_hand_side(particles, 0.0);
  seen->begin_step(1.0);
  seen->add_stage_loads(particles, 1.0);
  Vector3 gained{}, turned{};
  double mass = 0.0;
  for (std::size_t i = 0; i < particles.n_owned; ++i) {
    Vector3 f{};
    for (std::size_t d = 0; d < D; ++d)
      f[scene_axis<D>(d)] = particles.m[i] * (dynamics.rate().acceleration[d][i] - numerics.gravity[d]);
    gained = gained + f;
    turned = turned + cross(in_scene<D>(at<D>(particles.x, i)) - seen->bodies()[0].state().position, f);
    mass += particles.m[i];
  }
  const BodyLoad& load = seen->loads()[0];
  const Vector3 force = load.pressure + load.viscous, moment = load.pressure_moment + load.viscous_moment;
  EXPECT_GT(norm(force), 1.0);
  EXPECT_GT(norm(load.viscous), 1e-3);
  for (std::size_t d = 0; d < 3; ++d) {
    EXPECT_NEAR(force[d], -gained[d], 1e-10 * mass);
    EXPECT_NEAR(moment[d], -turned[d], 1e-9 * mass);
  }
}
TEST(BodiesWallsTest, BodyGetsTheMomentumTheWaterLosesIn2D) { expect_momentum_balance<2>(10, 0.05); }
TEST(BodiesWallsTest, BodyGetsTheMomentumTheWaterLosesIn3D) { expect_momentum_balance<3>(7, 0.05); }

TEST(BodiesWallsTest, MovingWithTheWaterTheWallDoesWhatItDoesAtRest) {
  const auto numerics = numerics_of_unit_lattice<2>();
  const auto rates = [&](double U) {
    auto particles = still_water<2>(10);
    randomise(particles);
    for (auto& u : particles.u[0]) u += U;
    Spec moving = tank(2, 10);
    moving.motion.given = true;
    moving.motion.u = support::Formula(U);
    Dynamics<2> dynamics(numerics, open_box<2>(10), nullptr,
                         walls_of<2>({moving}, numerics, open_box<2>(10)));
    dynamics.prepare(particles, 0.0, nullptr);
    dynamics.right_hand_side(particles, 0.0);
    return dynamics.rate();
  };
  const auto still = rates(0.0), carried = rates(0.7);
  for (std::size_t i = 0; i < still.volume.size(); ++i) {
    EXPECT_NEAR(still.volume[i], carried.volume[i], 1e-11);
    EXPECT_NEAR(still.acceleration[1][i], carried.acceleration[1][i], 1e-9);
  }
}

TEST(BodiesWallsTest, AnAcceleratedTankOfStillWaterHasTheSlopingPressure) {
  // a frame in which the tank accelerates along x with a: water at rest in it has p = rho (g z' - a x)
  const auto numerics = numerics_of_unit_lattice<2>();
  const double a = 0.2;
  auto particles = still_water<2>(14);
  for (std::size_t i = 0; i < particles.n_owned; ++i) particles.p[i] -= a * particles.x[0][i];
  Spec moving = tank(2, 14);
  moving.motion.given = true;
  moving.motion.u = support::Formula("0.2*t");
  Dynamics<2> dynamics(numerics, open_box<2>(14), nullptr, walls_of<2>({moving}, numerics, open_box<2>(14)));
  dynamics.prepare(particles, 0.0, nullptr);
  dynamics.right_hand_side(particles, 0.0);
  double least = 1e9, most = -1e9;
  for (std::size_t i = 0; i < particles.n_owned; ++i) {
    if (particles.x[1][i] > 10.0) continue;
    least = std::min(least, dynamics.rate().acceleration[0][i]);
    most = std::max(most, dynamics.rate().acceleration[0][i]);
  }
  EXPECT_NEAR(most, least, 1e-10);  // wall or bulk
  EXPECT_NEAR(most, a, 0.01 * a);   // the lattice's .999 of the gradient
}

TEST(BodiesWallsTest, ParticlesThatEnteredSlightlyArePutBackAndTheBodyGetsTheirMomentum) {
  const auto numerics = numerics_of_unit_lattice<2>();
  auto particles = still_water<2>(10);
  auto walls = walls_of<2>({tank(2, 10)}, numerics, open_box<2>(10));
  walls->build(particles);
  particles.x[1][0] = -0.2;
  particles.u[1][0] = -3.0;
  EXPECT_EQ(walls->keep_out(particles, 0.5, 0.0), 1u);
  EXPECT_NEAR(particles.x[1][0], 0.2, 1e-12);
  EXPECT_NEAR(particles.u[1][0], 3.0, 1e-12);
  walls->begin_step(0.5);
  EXPECT_NEAR(walls->loads()[0].pressure[2], -particles.m[0] * 6.0 / 0.5, 1e-12);
  particles.x[1][0] = -0.7;
  try {
    walls->keep_out(particles, 0.5, 1.5);
    FAIL() << "nothing was thrown";
  } catch (const StabilityError& error) {
    for (const char* part : {"t = 1.5", "particle 0", "'tank'", "0.7 m deep"})
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

TEST(BodiesWallsTest, WallsAreNoVoidAndDryWallsNoWater) {
  auto numerics = numerics_of_unit_lattice<2>();
  numerics.free_surface = true;
  auto particles = still_water<2>(12);
  Dynamics<2> dynamics(numerics, open_box<2>(12), nullptr,
                       walls_of<2>({tank(2, 12)}, numerics, open_box<2>(12)));
  dynamics.prepare(particles, 0.0, nullptr);
  for (std::size_t i = 0; i < particles.n_owned; ++i) {
    EXPECT_EQ(particles.surface[i] == SurfaceFlag::surface, particles.x[1][i] > 11.0)
        << particles.x[0][i] << ", " << particles.x[1][i];
    if (particles.x[1][i] > 11.0) {
      EXPECT_GT(particles.normal[1][i], 0.9);
    }
  }
}

TEST(BodiesWallsTest, FasterThanSoundIsRefused) {
  const auto numerics = numerics_of_unit_lattice<2>();
  Spec moving = tank(2, 10);
  moving.motion.given = true;
  moving.motion.u = support::Formula(1.1 * k_c);
  const auto walls = walls_of<2>({moving}, numerics, open_box<2>(10));
  EXPECT_THROW(walls->move_to(0.0), StabilityError);
}

TEST(BodiesDummiesTest, FillEachPlaceOnceWhereBodiesOverlapAndAcrossPeriodicSides) {
  const auto numerics = numerics_of_unit_lattice<2>();
  DomainBox<2> box = open_box<2>(10);
  box.lower[0] = 0.0;
  box.upper[0] = 10.0;
  box.sides[0] = {Side::periodic, Side::periodic};
  Spec floor;
  floor.name = "floor";
  floor.size = {40, 0, 10};
  floor.position = {5, 0, -5};
  Spec bump;
  bump.name = "bump";
  bump.shape = Spec::Shape::cylinder;
  bump.radius = 3.0;
  bump.position = {5, 0, 0};
  const auto walls = walls_of<2>({floor, bump}, numerics, box);
  const auto& x = walls->dummies().x;
  std::size_t inside = 0;
  for (std::size_t a = 0; a < walls->dummies().size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) ASSERT_GT(std::hypot(x[0][a] - x[0][b], x[1][a] - x[1][b]), 0.9);
    inside += x[0][a] > 0.0 && x[0][a] < 10.0 && x[1][a] < 0.0 && x[1][a] > -4.0;
  }
  EXPECT_EQ(inside, 40u);  // floor or bump, four rows
}

}  // namespace
}  // namespace littoral::sph
