#include <gtest/gtest.h>

#include <cmath>

#include "bodies/walls.hpp"
#include "clouds.hpp"
#include "littoral/error.hpp"
#include "physics/dynamics.hpp"

namespace littoral::sph {
namespace {

using Spec = support::BodySpec;

constexpr double k_c = 20.0, k_g = 0.3;

/// Still water of 24 x 12 particles of unit spacing in a tank, and one further body.
struct Tank {
  Numerics<2> numerics;
  Particles<2> particles;
  std::unique_ptr<Dynamics<2>> dynamics;
  double t = 0.0;

  explicit Tank(const Spec& other) {
    numerics.eos = {1.0, k_c, 0.0};
    numerics.gravity[1] = -k_g;
    numerics.spacing = 1.0;
    numerics.kernel_radius = 4.0;
    numerics.skin = 0.3;
    numerics.free_surface = true;
    numerics.reference_velocity = 2.0;
    DomainBox<2> box;
    box.lower = {-6.0, -6.0};
    box.upper = {30.0, 60.0};
    Spec tank;
    tank.name = "tank";
    tank.size = {24, 0, 200};
    tank.position = {12, 0, 100};
    tank.fluid = Spec::Fluid::inside;
    std::vector<Body> bodies;
    for (const Spec& spec : {tank, other}) bodies.emplace_back(spec, true, 0.2);
    auto walls = std::make_unique<Walls<2>>(std::move(bodies), numerics, box, Lattice<2>{{}, 1.0});
    particles =
        test::cloud<2>({24, 12}, 1.0, 0.0, [&](const std::array<double, 2>& x) { return !walls->inside(x); });
    for (std::size_t i = 0; i < particles.n_owned; ++i) {
      particles.p[i] = k_g * (12.0 - particles.x[1][i]);
      particles.m[i] = numerics.eos.density(particles.p[i]);
      particles.rho[i] = particles.m[i];
    }
    dynamics = std::make_unique<Dynamics<2>>(numerics, box, nullptr, std::move(walls));
  }

  /// Goes on until `end` and returns the mean upward force on the other body meanwhile.
  double run(double end) {
    double impulse = 0.0;
    const double begin = t;
    while (t < end) {
      const double dt = std::min(dynamics->stable_time_step(), end - t);
      dynamics->step(particles, t, dt, nullptr);
      t += dt;
      impulse += dt * dynamics->walls()->loads()[1].pressure[2];
    }
    return impulse / (end - begin);
  }

  void expect_sound() const {
    for (std::size_t i = 0; i < particles.n_owned; ++i) {
      ASSERT_TRUE(std::isfinite(particles.x[0][i] + particles.x[1][i] + particles.p[i]) &&
                  particles.V[i] > 0.0);
      for (const Body& body : dynamics->walls()->bodies())
        ASSERT_GT(body.closest_wall({particles.x[0][i], 0.0, particles.x[1][i]}).distance, -0.5)
            << body.name();
    }
  }
};

TEST(BodiesExtremesTest, ACylinderThatDropsIntoTheWaterIsPushedUpAsItEnters) {
  Spec cylinder;
  cylinder.name = "cylinder";
  cylinder.shape = Spec::Shape::cylinder;
  cylinder.radius = 3.0;
  cylinder.position = {12, 0, 15.5};  // clear of the surface by half a spacing
  cylinder.motion.given = true;
  cylinder.motion.w = support::Formula(-0.1 * k_c);
  Tank tank(cylinder);
  EXPECT_GT(tank.run(0.6), 0.0);  // half a radius deep; sound from the floor is back later
  tank.run(3.0);
  tank.expect_sound();
}

TEST(BodiesExtremesTest, AGapNarrowerThanTheSpacingStaysFinite) {
  Spec block;
  block.name = "block";
  block.size = {8, 0, 30};
  block.position = {4.6, 0, 15};  // .6 from the tank's side
  Tank tank(block);
  tank.run(3.0);
  tank.expect_sound();
}

TEST(BodiesExtremesTest, ABodyThatOutrunsSoundEndsTheRunWithItsName) {
  Spec block;
  block.name = "hammer";
  block.size = {8, 0, 8};
  block.position = {12, 0, 18};
  block.motion.given = true;
  block.motion.w = support::Formula("-100*t");
  Tank tank(block);
  try {
    tank.run(1.0);
    FAIL() << "nothing was thrown";
  } catch (const StabilityError& error) {
    EXPECT_NE(std::string(error.what()).find("hammer"), std::string::npos) << error.what();
  }
}

/// A cylinder of five spacings, impulsively started in a closed channel of water without friction.
struct Channel {
  double t = 0.0, work = 0.0, drag_impulse = 0.0;  // on the water
  Particles<2> particles;
  Numerics<2> numerics;
  std::unique_ptr<Dynamics<2>> dynamics;

  Channel(const char* speed, double stream, double place = 25.0) {
    numerics.eos = {1.0, k_c, 0.0};
    numerics.spacing = 1.0;
    numerics.kernel_radius = 4.0;
    numerics.skin = 0.4;
    numerics.reference_velocity = 1.0;
    using Side = support::Scene::Side;
    DomainBox<2> box;
    box.upper = {50.0, 25.0};
    box.sides = {{{Side::periodic, Side::periodic}, {Side::symmetry, Side::symmetry}}};
    Spec cylinder;
    cylinder.name = "cylinder";
    cylinder.shape = Spec::Shape::cylinder;
    cylinder.radius = 5.0;
    cylinder.position = {place, 0, 12.5};
    cylinder.motion.given = true;
    cylinder.motion.u = support::Formula(speed);
    std::vector<Body> bodies;
    bodies.emplace_back(cylinder, true, 0.2);
    auto walls = std::make_unique<Walls<2>>(std::move(bodies), numerics, box, Lattice<2>{{}, 1.0});
    particles =
        test::cloud<2>({50, 25}, 1.0, 0.0, [&](const std::array<double, 2>& x) { return !walls->inside(x); });
    for (std::size_t i = 0; i < particles.n_owned; ++i) particles.u[0][i] = stream;
    dynamics = std::make_unique<Dynamics<2>>(numerics, box, nullptr, std::move(walls));
  }
  double kinetic_energy() const {
    double sum = 0.0;
    for (std::size_t i = 0; i < particles.n_owned; ++i)
      sum += 0.5 * particles.m[i] *
             (particles.u[0][i] * particles.u[0][i] + particles.u[1][i] * particles.u[1][i]);
    return sum;
  }
  void run(double end) {
    while (t < end) {
      const double dt = std::min(dynamics->stable_time_step(), end - t);
      dynamics->step(particles, t, dt, nullptr);
      t += dt;
      const double force = dynamics->walls()->loads()[0].pressure[0];
      work -= dt * force * dynamics->walls()->bodies()[0].state().velocity[0];
      drag_impulse -= dt * force;
    }
  }
};

TEST(BodiesExtremesTest, AMovedCylinderGivesTheWaterNoMoreThanItsWork) {
  Channel channel("min(t/5,1)", 0.0);
  channel.run(15.0);
  const double energy = channel.kinetic_energy();
  EXPECT_GT(channel.work, 0.0);  // it is held back by what it moves
  EXPECT_LT(energy, channel.work);
  // and keeps what an ideal fluid would have, rho pi r^2 U^2 / 2 in water without bounds
  EXPECT_GT(energy, 0.8 * 0.5 * 3.14159 * 25.0);
}

TEST(BodiesExtremesTest, AcrossAPeriodicSideABodyIsWhatItIsInTheMiddle) {
  Channel middle("min(t/5,1)", 0.3);
  middle.run(4.0);
  for (const double place : {0.0, 50.0, 23.0}) {
    Channel shifted("min(t/5,1)", 0.3, place);
    ASSERT_EQ(shifted.particles.n_owned, middle.particles.n_owned) << place;
    shifted.run(4.0);
    EXPECT_NEAR(shifted.kinetic_energy(), middle.kinetic_energy(), 1e-9 * middle.kinetic_energy()) << place;
    EXPECT_NEAR(shifted.work, middle.work, 1e-9 * std::fabs(middle.work)) << place;
    const BodyLoad &load = shifted.dynamics->walls()->loads()[0],
                   &expected = middle.dynamics->walls()->loads()[0];
    EXPECT_NEAR(load.pressure_moment[1], expected.pressure_moment[1], 1e-8 * norm(expected.pressure))
        << place;
  }
}

TEST(BodiesExtremesTest, AStreamAboutAFixedCylinderLosesEnergyAndPushesItAlong) {
  Channel channel("0*t", 1.0);
  const double before = channel.kinetic_energy();
  channel.run(15.0);
  EXPECT_LT(channel.kinetic_energy(), before);
  EXPECT_GT(channel.kinetic_energy(), 0.6 * before);
  EXPECT_LT(channel.drag_impulse, 0.0);  // taken from the water
}

}  // namespace
}  // namespace littoral::sph
