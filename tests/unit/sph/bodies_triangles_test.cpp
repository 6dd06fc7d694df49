#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "bodies/triangle_surface.hpp"
#include "bodies_models.hpp"
#include "io/stl.hpp"
#include "littoral/error.hpp"

namespace littoral::sph {
namespace {

/// The box [-a, a] x [-b, b] x [-c, c], twelve triangles with their normals outward.
TriangleSoup box(double a, double b, double c) {
  const auto corner = [&](int k) { return Vector3{k & 1 ? a : -a, k & 2 ? b : -b, k & 4 ? c : -c}; };
  const int faces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                           {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  TriangleSoup soup;
  for (const auto& f : faces) {
    soup.push_back({corner(f[0]), corner(f[1]), corner(f[2])});
    soup.push_back({corner(f[0]), corner(f[2]), corner(f[3])});
  }
  return soup;
}

std::shared_ptr<const TriangleSurface> surface(const TriangleSoup& soup) {
  return std::make_shared<const TriangleSurface>(soup, "test.stl");
}

TEST(BodiesTrianglesTest, BoxOfTrianglesIsTheBox) {
  Spec spec;
  spec.size = {2, 3, 4};
  const Body given(spec, false, 1.0);
  spec.shape = Spec::Shape::stl;
  TriangleSoup inside_out = box(1, 1.5, 2);
  for (auto& triangle : inside_out) std::swap(triangle[0], triangle[1]);
  const Body read(spec, false, 1.0, surface(box(1, 1.5, 2))), turned(spec, false, 1.0, surface(inside_out));
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-4.0, 4.0);
  for (int k = 0; k < 2000; ++k) {
    const Vector3 x = {place(random), place(random), place(random)};
    const auto wall = given.closest_wall(x);
    for (const Body* body : {&read, &turned}) {
      const auto other = body->closest_wall(x);
      ASSERT_NEAR(wall.distance, other.distance, 1e-12);
      ASSERT_EQ(other.patch, -1);  // of planes
      ASSERT_LT(norm(wall.point - other.point), 1e-12);
      ASSERT_LT(norm(wall.normal - other.normal), 1e-7);  // along a line that may be short
    }
  }
}

TEST(BodiesTrianglesTest, NearestOfManyTriangles) {
  // a sphere of 2 x 40 x 80 triangles is round to 1 - cos(pi/80) of its radius
  const auto sphere = surface(test::ball_of_triangles(1.0, 40, 80));
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-1.5, 1.5);
  for (int k = 0; k < 3000; ++k) {
    const Vector3 x = {place(random), place(random), place(random)};
    EXPECT_NEAR(sphere->closest(x).distance, norm(x) - 1.0, 2e-3);
    EXPECT_EQ(sphere->closest(x).patch, 0);  // round, without an edge
  }
}

TEST(BodiesTrianglesTest, FaultsAreNamed) {
  const auto message = [](const TriangleSoup& soup) {
    try {
      surface(soup);
    } catch (const ConfigError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  TriangleSoup open = box(1, 1, 1), twisted = open, crowded = open;
  open.pop_back();
  std::swap(twisted[3][0], twisted[3][1]);
  crowded.push_back({crowded[0][0], crowded[0][1], Vector3{5, 5, 5}});
  EXPECT_NE(message(open).find("3 edges belong to one triangle only"), std::string::npos) << message(open);
  EXPECT_NE(message(twisted).find("opposite orientation"), std::string::npos) << message(twisted);
  EXPECT_NE(message(crowded).find("more than two triangles"), std::string::npos) << message(crowded);
  EXPECT_NE(message({}).find("no triangle"), std::string::npos);
  TriangleSoup nowhere = box(1, 1, 1);
  nowhere[4][1][2] = std::nan("");
  EXPECT_NE(message(nowhere).find("triangle 5"), std::string::npos) << message(nowhere);
}

TEST(BodiesTrianglesTest, ReadsTextAndScalesIt) {
  const std::string path = testing::TempDir() + "littoral_box.stl";
  {
    std::ofstream file(path);
    file << "solid box\n";
    for (const auto& triangle : box(10, 20, 30)) {
      file << "facet normal 0 0 0\nouter loop\n";
      for (const auto& x : triangle) file << "vertex " << x[0] << " " << x[1] << " " << x[2] << "\n";
      file << "endloop\nendfacet\n";
    }
    file << "endsolid box\n";
  }
  const auto read = surface(read_triangles(path, 0.1));
  EXPECT_EQ(read->size(), 12u);
  EXPECT_NEAR(read->closest({4, 0, 0}).distance, 3.0, 1e-6);
  EXPECT_NEAR(read->closest({0.9, 0, 0}).distance, -0.1, 1e-6);
  EXPECT_THROW(read_triangles(path + ".missing", 1.0), ConfigError);
}

TEST(BodiesTrianglesTest, ATankOfTrianglesHoldsWaterAsTheBoxDoes) {
  const auto numerics = test::numerics_of_unit_lattice<3>();
  const int n = 8;
  Spec given = test::tank(3, n), read = given;
  read.shape = Spec::Shape::stl;
  const auto rates = [&](std::vector<Body> bodies) {
    auto particles = test::still_water<3>(n);
    Dynamics<3> dynamics(
        numerics, test::open_box<3>(n), nullptr,
        std::make_unique<Walls<3>>(std::move(bodies), numerics, test::open_box<3>(n), Lattice<3>{{}, 1.0}));
    dynamics.prepare(particles, 0.0, nullptr);
    dynamics.right_hand_side(particles, 0.0);
    return dynamics.rate();
  };
  std::vector<Body> one, other;
  one.emplace_back(given, false, 0.1);
  other.emplace_back(read, false, 0.1, surface(box(0.5 * n, 0.5 * n, 2.0 * n)));
  const auto expected = rates(std::move(one)), found = rates(std::move(other));
  for (std::size_t i = 0; i < expected.volume.size(); ++i)
    for (std::size_t d = 0; d < 3; ++d)
      EXPECT_NEAR(expected.acceleration[d][i], found.acceleration[d][i], 1e-12);
}

}  // namespace
}  // namespace littoral::sph
