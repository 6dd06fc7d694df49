#include <gtest/gtest.h>

#include "coupling/bodies_in_layers.hpp"
#include "coupling/coupling_hooks.hpp"
#include "coupling/face_elements.hpp"
#include "coupling_support.hpp"
#include "littoral/error.hpp"

namespace littoral::sph {
namespace {

const LinearEos k_eos{1000.0, 10.0, 0.0};

TEST(FaceElementsTest, TileTheOuterFaces) {
  const auto layers = test::unit_box<3>(test::all_open<3>(), 0.25, 0.25);
  const FaceElements<3> faces(layers, 0.26, FaceRows::fixed);
  double area = 0.0;
  for (std::size_t e = 0; e < faces.size(); ++e) area += faces[e].area;
  EXPECT_NEAR(area, 6 * 2.0 * 2.0, 1e-12);
  EXPECT_EQ(faces.size(), 6u * 8u * 8u);
}

TEST(FaceElementsTest, IntegrateTheMassFluxWithTheLocalDensity) {  // (18)
  const auto layers = test::unit_box<2>(test::all_open<2>(), 0.25, 0.25);
  FaceElements<2> faces(layers, 0.5, FaceRows::fixed);
  // u_x = 3 t: the mean over [1, 2] is 4.5; rho(p) = 1000 + 500/100
  const test::FormulaExterior fv([](const coupler::Vec3&, double t) {
    return coupler::DonorState{500.0, {3.0 * t, 0.0, 0.0}, 0.0};
  });
  faces.integrate(fv, k_eos, 1.0, 1.0);
  for (std::size_t e = 0; e < faces.size(); ++e) {
    const double inward = faces[e].axis == 0 ? faces[e].inward : 0.0;
    EXPECT_NEAR(faces.mass(e), inward * 1005.0 * 4.5 * 0.5, 1e-9);
  }
  EXPECT_NEAR(faces.flux(), 0.0, 1e-9);
}

TEST(FaceElementsTest, CountOnlyTheWetPart) {  // (19)
  const auto layers = test::unit_box<2>({{{true, false}, {false, false}}}, 0.25, 0.25);
  FaceElements<2> faces(layers, 0.25, FaceRows::fixed);  // four elements up the face x = -0.5
  const test::FormulaExterior fv(
      [](const coupler::Vec3& x, double) {
        return coupler::DonorState{0.0, {1.0, 0.0, 0.0}, x[2] - 0.55};
      },
      true);
  faces.integrate(fv, k_eos, 0.0, 1.0);
  ASSERT_EQ(faces.size(), 4u);
  EXPECT_DOUBLE_EQ(faces.mass(0), 250.0);
  EXPECT_DOUBLE_EQ(faces.mass(1), 250.0);
  EXPECT_NEAR(faces.mass(2), 50.0, 1e-9);  // wet from .50 to .55
  EXPECT_DOUBLE_EQ(faces.mass(3), 0.0);
}

TEST(FaceElementsTest, WetPartIsRightWhereTheGridKnowsOneEndOnly) {  // (19)
  const auto layers = test::unit_box<2>({{{true, false}, {false, false}}}, 0.25, 0.25);
  FaceElements<2> faces(layers, 0.25, FaceRows::fixed);
  const test::FormulaExterior fv(
      [](const coupler::Vec3& x, double) -> std::optional<coupler::DonorState> {
        if (x[2] > 0.7) return std::nullopt;  // FV has no state in the air
        return coupler::DonorState{0.0, {1.0, 0.0, 0.0}, x[2] - 0.55};
      },
      true);
  faces.integrate(fv, k_eos, 0.0, 1.0);
  EXPECT_NEAR(faces.mass(2), 50.0, 1e-9);  // wet from .50 to .55, as with both ends
}

TEST(FaceElementsTest, CutElementInSpaceCountsItsWetShare) {  // (19)
  const auto layers = test::unit_box<3>({{{true, false}, {false, false}, {false, false}}}, 0.25, 0.25);
  FaceElements<3> faces(layers, 1.0, FaceRows::fixed);
  const test::FormulaExterior fv(
      [](const coupler::Vec3& x, double) {
        return coupler::DonorState{0.0, {1.0, 0.0, 0.0}, (x[1] + x[2] - 1.0) / std::sqrt(2.0)};
      },
      true);
  faces.integrate(fv, k_eos, 0.0, 1.0);
  EXPECT_NEAR(faces.mass(0), 500.0, 1000.0 / 32.0);  // half, to half a row of the 16 sub-points
}

TEST(FaceElementsTest, KnowWhereAParticleLeft) {
  const auto layers = test::unit_box<2>(test::all_open<2>(), 0.25, 0.25);
  const FaceElements<2> faces(layers, 0.5, FaceRows::fixed);
  EXPECT_EQ(faces.crossed({0.5, 0.5}), faces.size());
  const std::size_t e = faces.crossed({1.51, 0.6});
  EXPECT_EQ(faces[e].axis, 0u);
  EXPECT_EQ(faces[e].inward, -1.0);
  EXPECT_NEAR(faces[e].centre[1], 0.75, 0.26);
  const std::size_t corner = faces.crossed({-0.52, 1.6});
  EXPECT_EQ(faces[corner].axis, 1u) << "through the face it is furthest beyond";
  EXPECT_EQ(faces[corner].centre[0], -0.25);
}

TEST(FaceElementsTest, RestoreToTheBit) {
  const auto layers = test::unit_box<2>(test::all_open<2>(), 0.25, 0.25);
  FaceElements<2> faces(layers, 0.5, FaceRows::fixed), other(layers, 0.5, FaceRows::fixed);
  const test::FormulaExterior fv([](const coupler::Vec3& x, double) {
    return coupler::DonorState{0.0, {0.1 * x[0], 0.0, 0.3}, 0.0};
  });
  for (int k = 0; k < 10; ++k) faces.integrate(fv, k_eos, 0.0, 0.1);
  other.unpack(faces.pack());
  for (std::size_t e = 0; e < faces.size(); ++e) EXPECT_EQ(faces.mass(e), other.mass(e));
  EXPECT_EQ(faces.flux(), other.flux());
  EXPECT_THROW(other.unpack({1.0, 2.0, 3.0, 4.0}), IoError);
}

TEST(CouplingHooksTest, NormalIsPhisGradientWhereTheGridKnowsOneSideOnly) {
  Numerics<2> numerics;
  numerics.eos = k_eos;
  numerics.spacing = 0.1;
  numerics.kernel_radius = 0.4;
  const test::FormulaExterior fv(
      [](const coupler::Vec3& x, double) -> std::optional<coupler::DonorState> {
        if (x[2] > 0.51) return std::nullopt;
        return coupler::DonorState{0.0, {}, 0.8 * (x[2] - 0.52) + 0.6 * (x[0] + 0.4)};
      },
      true);
  const auto layers = test::unit_box<2>({{{true, false}, {false, false}}}, 0.25, 0.25);
  CouplingHooks<2> hooks(layers, numerics, fv, Removal::crossing);
  Particles<2> particles;
  particles.append({{-0.4, 0.5}, {}, 0.01, 10.0, 0.0, Zone::driven});
  hooks.adjust_surface(particles, 0.0);
  ASSERT_EQ(particles.surface[0], SurfaceFlag::surface);
  EXPECT_NEAR(particles.normal[0][0], 0.6, 1e-12);
  EXPECT_NEAR(particles.normal[1][0], 0.8, 1e-12);
}

TEST(BodiesInLayersTest, AreNamedWithTheirPlace) {
  const auto layers = test::unit_box<2>(test::all_open<2>(), 0.25, 0.25);  // outer faces at -.5 and 1.5
  const FaceElements<2> faces(layers, 0.05, FaceRows::fixed);
  Numerics<2> numerics;
  numerics.eos = k_eos;
  numerics.spacing = 0.05;
  numerics.kernel_radius = 0.2;
  DomainBox<2> domain;
  domain.lower.fill(-2.0);
  domain.upper.fill(3.0);
  const auto fault = [&](double x, double size) {
    support::BodySpec spec;
    spec.name = "pier";
    spec.size = {size, 0, size};
    spec.position = {x, 0, 0.5};
    std::vector<Body> bodies;
    bodies.emplace_back(spec, true, 0.1);
    const Walls<2> walls(std::move(bodies), numerics, domain, Lattice<2>{{}, 0.05});
    return body_in_the_layers<2>(walls, layers, faces);
  };
  EXPECT_EQ(fault(0.5, 0.4), "");
  EXPECT_EQ(fault(2.2, 0.4), "");  // beyond the outer face: no water of these particles
  for (const double x : {-0.1, -0.4, 1.2, 1.6})
    EXPECT_NE(fault(x, 0.4).find("body 'pier' reaches into the coupling layers"), std::string::npos) << x;
  EXPECT_NE(fault(2.4, 2.5), "");  // wide enough to have no dummies in the layer's middle
}

}  // namespace
}  // namespace littoral::sph
