#include <gtest/gtest.h>

#include <cmath>

#include "bodies/body.hpp"
#include "littoral/error.hpp"

namespace littoral::sph {
namespace {

using Spec = support::BodySpec;

Spec spec(Spec::Shape shape, Vector3 size = {0, 0, 0}, double radius = 0.0, double length = 0.0) {
  Spec s;
  s.name = "body";
  s.shape = shape;
  s.size = size;
  s.radius = radius;
  s.length = length;
  return s;
}

void expect_wall(const Body& body, const Vector3& x, double distance, const Vector3& point,
                 const Vector3& normal) {
  const SurfacePoint wall = body.closest_wall(x);
  EXPECT_NEAR(wall.distance, distance, 1e-12);
  for (std::size_t d = 0; d < 3; ++d) {
    EXPECT_NEAR(wall.point[d], point[d], 1e-12);
    EXPECT_NEAR(wall.normal[d], normal[d], 1e-12);
  }
}

TEST(BodiesShapeTest, BoxSeenFromOutsideInsideAndAtAnEdge) {
  const Body body(spec(Spec::Shape::box, {2, 4, 6}), false, 1.0);
  expect_wall(body, {3, 0.5, 1}, 2.0, {1, 0.5, 1}, {-1, 0, 0});
  expect_wall(body, {0.75, 0.5, 1}, -0.25, {1, 0.5, 1}, {-1, 0, 0});
  expect_wall(body, {0.0, 1.9, 0.0}, -0.1, {0, 2, 0}, {0, -1, 0});
  expect_wall(body, {4, 6, 0}, 5.0, {1, 2, 0}, {-0.6, -0.8, 0});
  expect_wall(body, {4, 0, 7}, 5.0, {1, 0, 3}, {-0.6, 0, -0.8});
}

TEST(BodiesShapeTest, TankIsWetInside) {
  Spec s = spec(Spec::Shape::box, {2, 0, 6});
  s.fluid = Spec::Fluid::inside;
  const Body body(s, true, 1.0);
  expect_wall(body, {0.75, 0, 1}, 0.25, {1, 0, 1}, {1, 0, 0});
  expect_wall(body, {4, 0, 7}, -5.0, {1, 0, 3}, {0.6, 0, 0.8});  // behind a corner: away from it
}

TEST(BodiesShapeTest, SphereAndCylinder) {
  const Body sphere(spec(Spec::Shape::sphere, {}, 2.0), false, 1.0);
  expect_wall(sphere, {0, 3, 4}, 3.0, {0, 1.2, 1.6}, {0, -0.6, -0.8});
  const Body cylinder(spec(Spec::Shape::cylinder, {}, 2.0, 6.0), false, 1.0);
  expect_wall(cylinder, {3, 1, 4}, 3.0, {1.2, 1, 1.6}, {-0.6, 0, -0.8});
  expect_wall(cylinder, {0.5, 4, 0}, 1.0, {0.5, 3, 0}, {0, -1, 0});
  const Body disc(spec(Spec::Shape::cylinder, {}, 2.0), true, 1.0);
  expect_wall(disc, {3, 0, 4}, 3.0, {1.2, 0, 1.6}, {-0.6, 0, -0.8});
}

TEST(BodiesShapeTest, WedgeStandsOnItsBase) {
  const Body wedge(spec(Spec::Shape::wedge, {2, 0, 1}), true, 1.0);
  const double h = std::sqrt(0.5);
  expect_wall(wedge, {1, 0, 1}, h, {0.5, 0, 0.5}, {-h, 0, -h});
  expect_wall(wedge, {0, 0, 3}, 2.0, {0, 0, 1}, {0, 0, -1});
  expect_wall(wedge, {0.1, 0, 0.2}, -0.2, {0.1, 0, 0}, {0, 0, 1});
}

TEST(BodiesShapeTest, TurnedAndMoved) {
  Spec s = spec(Spec::Shape::box, {2, 2, 6});
  s.rotation = {0, 90, 0};  // its long side along x
  s.position = {10, 0, 0};
  const Body body(s, false, 1.0);
  expect_wall(body, {14, 0, 0}, 1.0, {13, 0, 0}, {-1, 0, 0});
  expect_wall(body, {10, 0, 3}, 2.0, {10, 0, 1}, {0, 0, -1});
}

TEST(BodiesMotionTest, IntegratesVelocityAndKnowsItsSlopes) {
  Spec s = spec(Spec::Shape::sphere, {}, 1.0);
  s.motion.given = true;
  s.motion.u = support::Formula("cos(t)");
  s.motion.z = support::Formula("t^2");
  s.motion.rate_y = support::Formula("2*t");
  Motion motion(s, 0.05);
  const BodyState state = motion.at(1.23);
  EXPECT_NEAR(state.position[0], std::sin(1.23), 1e-8);
  EXPECT_NEAR(state.position[2], 1.23 * 1.23, 1e-12);
  EXPECT_NEAR(state.velocity[2], 2.46, 1e-9);
  EXPECT_NEAR(state.acceleration[0], -std::sin(1.23), 1e-5);
  EXPECT_NEAR(state.acceleration[2], 2.0, 1e-6);
  const Vector3 turned = state.rotation({0, 0, 1});  // about y, z goes towards x
  EXPECT_NEAR(std::atan2(turned[0], turned[2]), 1.23 * 1.23, 1e-9);
  EXPECT_NEAR(state.spin_rate[1], 2.0, 1e-9);
}

TEST(BodiesMotionTest, DependsOnTimeAloneToTheBit) {
  Spec s = spec(Spec::Shape::sphere, {}, 1.0);
  s.motion.given = true;
  s.motion.u = support::Formula("sin(3*t)");
  s.motion.rate_y = support::Formula("cos(t)");
  Motion once(s, 0.05), often(s, 0.05);
  for (int k = 0; k < 700; ++k) (void)often.at(0.0031 * k);
  (void)often.at(0.7);
  const BodyState a = once.at(2.0), b = often.at(2.0);
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.rotation.v, b.rotation.v);
}

}  // namespace
}  // namespace littoral::sph
