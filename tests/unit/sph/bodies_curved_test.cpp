#include <gtest/gtest.h>

#include <cmath>

#include "bodies/triangle_surface.hpp"
#include "bodies/wall_view.hpp"
#include "bodies_models.hpp"
#include "littoral/error.hpp"
#include "physics/dynamics.hpp"

namespace littoral::sph {
namespace {

using namespace test;

/// A round body of `radius` amid n^D particles of unit spacing, all at the pressure of the surface, so that
/// whatever accelerates them comes from jumps of velocity.
template <int D>
struct RoundBody {
  Numerics<D> numerics = numerics_of_unit_lattice<D>();
  Particles<D> particles;
  std::unique_ptr<Dynamics<D>> dynamics;
  Vector<D> centre;

  template <class Velocity>
  RoundBody(int n, double radius, Spec::Fluid fluid, const Velocity& velocity, bool triangles = false) {
    numerics.gravity = {};
    Spec spec;
    spec.name = "round";
    spec.shape = D == 2 ? Spec::Shape::cylinder : Spec::Shape::sphere;
    spec.radius = radius;
    spec.fluid = fluid;
    centre.fill(0.5 * n + 0.2);  // no point of symmetry of the lattice
    for (std::size_t d = 0; d < D; ++d) spec.position[scene_axis<D>(d)] = centre[d];
    std::shared_ptr<const TriangleSurface> surface;
    if (triangles) {
      spec.shape = Spec::Shape::stl;
      surface = std::make_shared<const TriangleSurface>(ball_of_triangles(radius, 20, 40), "ball.stl");
    }
    std::vector<Body> bodies;
    bodies.emplace_back(spec, D == 2, 0.1, surface);
    auto walls = std::make_unique<Walls<D>>(std::move(bodies), numerics, open_box<D>(n), Lattice<D>{{}, 1.0});
    std::array<int, D> cells;
    cells.fill(n);
    particles = cloud<D>(cells, 1.0, 0.0, [&](const Vector<D>& x) { return !walls->inside(x); });
    for (std::size_t i = 0; i < particles.n_owned; ++i) {
      Vector<D> x = at<D>(particles.x, i);
      for (std::size_t d = 0; d < D; ++d) x[d] -= centre[d];
      const Vector<D> u = velocity(x);
      for (std::size_t d = 0; d < D; ++d) particles.u[d][i] = u[d];
    }
    dynamics = std::make_unique<Dynamics<D>>(numerics, open_box<D>(n), nullptr, std::move(walls));
    dynamics->prepare(particles, 0.0, nullptr);
    dynamics->right_hand_side(particles, 0.0);
  }
  bool sees_wall(std::size_t i) const { return dynamics->walls()->list().row_of(i) >= 0; }
};

/// Potential flow about a cylinder or sphere at rest in a stream of 1 along x.
template <int D>
Vector<D> stream_about(double radius, const Vector<D>& x) {
  const double r2 = dot_of<D>(x, x), s = std::pow(radius * radius / r2, 0.5 * D);
  Vector<D> u{};
  const double share = D == 2 ? 1.0 : 0.5;
  for (std::size_t d = 0; d < D; ++d) u[d] = -share * s * D * x[0] * x[d] / r2;
  u[0] += 1.0 + share * s;
  return u;
}

template <int D>
void expect_no_energy_from_a_round_wall(int n, double radius, bool triangles = false) {
  const RoundBody<D> water(
      n, radius, Spec::Fluid::outside, [&](const Vector<D>& x) { return stream_about<D>(radius, x); },
      triangles);
  double power = 0.0, most = 0.0;
  for (std::size_t i = 0; i < water.particles.n_owned; ++i) {
    if (!water.sees_wall(i)) continue;
    double mine = 0.0, force2 = 0.0;
    for (std::size_t d = 0; d < D; ++d) {
      const double force = water.particles.m[i] * water.dynamics->rate().acceleration[d][i];
      mine += force * water.particles.u[d][i];
      force2 += force * force;
    }
    power += mine;
    most = std::max(most, mine);
  }
  // c U / radius is what each particle would gain along a wall answered dummy by dummy
  const double by_dummies = k_c / radius;
  EXPECT_LT(power, 0.0);
  EXPECT_LT(most, 0.1 * by_dummies);
}
TEST(BodiesCurvedTest, WaterThatSlidesAlongACylinderGetsNoEnergy) {
  expect_no_energy_from_a_round_wall<2>(30, 5.0);
  expect_no_energy_from_a_round_wall<2>(50, 15.0);
}
TEST(BodiesCurvedTest, WaterThatSlidesAlongASphereGetsNoEnergy) {
  expect_no_energy_from_a_round_wall<3>(20, 4.0);
}
TEST(BodiesCurvedTest, WaterThatSlidesAlongABallOfTrianglesGetsNoEnergy) {
  expect_no_energy_from_a_round_wall<3>(20, 4.0, true);
}

TEST(BodiesCurvedTest, WaterThatTurnsInARoundTankFeelsNoWall) {
  const double w = 0.1;
  const RoundBody<2> water(34, 15.0, Spec::Fluid::inside, [&](const Vector<2>& x) {
    return Vector<2>{w * x[1], -w * x[0]};
  });
  for (std::size_t i = 0; i < water.particles.n_owned; ++i) {
    EXPECT_NEAR(water.dynamics->rate().acceleration[0][i], 0.0, 1e-12);
    EXPECT_NEAR(water.dynamics->rate().acceleration[1][i], 0.0, 1e-12);
    EXPECT_NEAR(water.dynamics->rate().volume[i], 0.0, 1e-12);
  }
}

TEST(BodiesCurvedTest, StatesOfDummiesAreForPlaneWallsOnly) {
  Numerics<2> numerics = numerics_of_unit_lattice<2>();
  numerics.wall_states = WallStates::extrapolated;
  for (const auto shape : {Spec::Shape::box, Spec::Shape::cylinder}) {
    Spec spec;
    spec.name = "body";
    spec.shape = shape;
    spec.radius = 5.0;
    spec.size = {10.0, 10.0, 10.0};
    spec.position = {10.0, 0.0, 10.0};
    std::vector<Body> bodies;
    bodies.emplace_back(spec, true, 0.1, nullptr);
    const auto make = [&] { Walls<2>(std::move(bodies), numerics, open_box<2>(20), Lattice<2>{{}, 1.0}); };
    if (shape == Spec::Shape::box)
      EXPECT_NO_THROW(make());
    else
      EXPECT_THROW(make(), ConfigError);
  }
}

}  // namespace
}  // namespace littoral::sph
