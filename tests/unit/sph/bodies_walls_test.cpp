#include <gtest/gtest.h>

#include <random>

#include "bodies/wall_view.hpp"
#include "bodies_models.hpp"
#include "littoral/error.hpp"
#include "physics/dynamics.hpp"
#include "physics/riemann_fluxes.hpp"
#include "physics/surface.hpp"

namespace littoral::sph {
namespace {

using namespace test;
using Side = support::Scene::Side;

/// Next to flat walls and in their corners the pairs must give what a complete lattice of water gives.
template <int D>
void expect_rest_as_in_the_bulk(int n, WallStates states = WallStates::linear) {
  auto numerics = numerics_of_unit_lattice<D>();
  numerics.wall_states = states;
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
TEST(BodiesWallsTest, WaterAtRestFeelsExtrapolatedDummiesAsWater) {
  expect_rest_as_in_the_bulk<2>(14, WallStates::extrapolated);
  expect_rest_as_in_the_bulk<3>(10, WallStates::extrapolated);
}

TEST(BodiesWallsTest, AForceByFormulaMeetsWallsAsGravityDoes) {
  const auto rates = [](bool by_formula) {
    auto numerics = numerics_of_unit_lattice<2>();
    if (by_formula) {
      numerics.gravity = {};
      numerics.body_force = BodyForce<2>::Field{support::Formula(0.0), support::Formula("0*t-0.3")};
    }
    auto particles = still_water<2>(10);
    Dynamics<2> dynamics(numerics, open_box<2>(10), nullptr,
                         walls_of<2>({tank(2, 10)}, numerics, open_box<2>(10)));
    dynamics.prepare(particles, 0.0, nullptr);
    dynamics.right_hand_side(particles, 0.0);
    return dynamics.rate();
  };
  const auto gravity = rates(false), formula = rates(true);
  for (std::size_t i = 0; i < gravity.volume.size(); ++i)
    for (std::size_t d = 0; d < 2; ++d)
      EXPECT_NEAR(gravity.acceleration[d][i], formula.acceleration[d][i], 1e-13);
}

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

/// Still water, n deep; discs of two spacings in the wall at x = n.
template <int D>
void expect_pressure_of_discs(int n) {
  const auto numerics = numerics_of_unit_lattice<D>();
  auto particles = still_water<D>(n);
  auto walls = walls_of<D>({tank(D, n)}, numerics, open_box<D>(n));
  Walls<D>* seen = walls.get();
  const auto disc = [&](double z) {
    return WallDisc{"d", {1.0 * n, D == 3 ? 0.5 * n : 0.0, z}, {1.0, 0.0, 0.0}, 2.0};
  };
  seen->watch({disc(0.4 * n), disc(1.0), disc(n + 6.0)}, open_box<D>(n));
  Dynamics<D> dynamics(numerics, open_box<D>(n), nullptr, std::move(walls));
  dynamics.prepare(particles, 0.0, nullptr);
  dynamics.right_hand_side(particles, 0.0);
  seen->begin_step(1.0);
  seen->add_stage_loads(particles, 0.25);
  seen->add_stage_loads(particles, 0.75);
  const double bottom = k_g * n;
  EXPECT_NEAR(seen->sensed()[0], k_g * 0.6 * n, 0.03 * bottom);
  EXPECT_NEAR(seen->sensed()[1], k_g * (n - 1.0), 0.1 * bottom);  // a quarter of its surroundings is floor
  EXPECT_EQ(seen->sensed()[2], 0.0);                              // dry
  auto off_the_wall = disc(3.0);
  off_the_wall.centre[0] -= 1.0;
  EXPECT_THROW(seen->watch({off_the_wall}, open_box<D>(n)), ConfigError);
}
TEST(BodiesWallsTest, DiscsShowThePressureOfStillWaterIn2D) { expect_pressure_of_discs<2>(14); }
TEST(BodiesWallsTest, DiscsShowThePressureOfStillWaterIn3D) { expect_pressure_of_discs<3>(10); }

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
  walls->build(particles, 0.5 * numerics.skin);
  const auto start = particles.x;
  particles.x[1][0] = -0.2;
  particles.u[1][0] = -3.0;
  walls->begin_step(0.5);
  EXPECT_EQ(walls->keep_out(particles, start, 0.5, 0.0), 1u);
  EXPECT_NEAR(particles.x[1][0], 0.2, 1e-12);
  EXPECT_NEAR(particles.u[1][0], 3.0, 1e-12);
  EXPECT_NEAR(walls->loads()[0].pressure[2], -particles.m[0] * 6.0 / 0.5, 1e-12);
  particles.x[1][0] = -0.7;
  try {
    walls->keep_out(particles, start, 0.5, 1.5);
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

TEST(BodiesWallsTest, ALatticeThatAnInclinedWallCutsIsEvenToTheShifting) {
  // a wedge of 45 degrees, dummies on its very faces, its foot and its tip; then one of other slopes
  for (const double apex : {0.0, 3.3}) {
    auto numerics = numerics_of_unit_lattice<2>();
    numerics.free_surface = true;
    const int n = 20;
    Spec wedge;
    wedge.name = "wedge";
    wedge.shape = Spec::Shape::wedge;
    wedge.size = {16, 0, 8};
    wedge.apex = apex;
    wedge.position = {10, 0, 0};
    auto walls = walls_of<2>({tank(2, n), wedge}, numerics, open_box<2>(n));
    auto particles = still_water<2>(n);
    std::vector<char> inside;
    for (std::size_t i = 0; i < particles.n_owned; ++i)
      inside.push_back(walls->inside(at<2>(particles.x, i)));
    particles.remove(inside);
    Walls<2>* seen = walls.get();
    Dynamics<2> dynamics(numerics, open_box<2>(n), nullptr, std::move(walls));
    dynamics.prepare(particles, 0.0, nullptr);
    Shifting<2>(1.0).compute(particles, dynamics.neighbors(), nullptr, &seen->support());
    for (std::size_t i = 0; i < particles.n_owned; ++i) {
      if (particles.x[1][i] > n - numerics.kernel_radius) continue;
      EXPECT_NEAR(particles.shift[0][i], 0.0, 1e-12) << particles.x[0][i] << ", " << particles.x[1][i];
      EXPECT_NEAR(particles.shift[1][i], 0.0, 1e-12) << particles.x[0][i] << ", " << particles.x[1][i];
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

TEST(BodiesWallsTest, AMotionWithoutAFiniteValueIsRefusedWithItsKey) {
  const auto numerics = numerics_of_unit_lattice<2>();
  const auto message = [&](const Spec& spec, double t) {
    try {
      walls_of<2>({spec}, numerics, open_box<2>(10))->move_to(t);
    } catch (const StabilityError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  Spec from_nothing = tank(2, 10), later = from_nothing;
  from_nothing.motion.given = later.motion.given = true;
  from_nothing.motion.w = support::Formula("0/t");
  later.motion.rate_y = support::Formula("0.1*sqrt(2-t)");
  EXPECT_NE(message(from_nothing, 0.0).find("t = 0 s: body 'tank': its motion.w"), std::string::npos);
  EXPECT_EQ(message(later, 1.0), "");
  EXPECT_NE(message(later, 3.0).find("motion.rate_y"), std::string::npos) << message(later, 3.0);
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
  const auto& x = walls->dummies().x();
  std::size_t inside = 0;
  for (std::size_t a = 0; a < walls->dummies().size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) ASSERT_GT(std::hypot(x[0][a] - x[0][b], x[1][a] - x[1][b]), 0.9);
    inside += x[0][a] > 0.0 && x[0][a] < 10.0 && x[1][a] < 0.0 && x[1][a] > -4.0;
  }
  EXPECT_EQ(inside, 40u);  // floor or bump, four rows
}

}  // namespace
}  // namespace littoral::sph
