#include <gtest/gtest.h>

#include <cmath>

#include "coupling/face_elements.hpp"
#include "coupling_support.hpp"

// Regions of several boxes: an L of two that touch.

namespace littoral::sph {
namespace {

template <int D>
RegionBox<D> open_box(const Point<D>& lower, const Point<D>& upper) {
  RegionBox<D> box;
  box.lower = lower;
  box.upper = upper;
  box.open = test::all_open<D>();
  return box;
}

/// Layers .25 wide: outer faces [-.25, 1.25] x [-.25, 1.25] and [.75, 2.25] x [-.25, .65].
Layers<2> bent() {
  return Layers<2>({open_box<2>({0.0, 0.0}, {1.0, 1.0}), open_box<2>({1.0, 0.0}, {2.0, 0.4})}, 0.125, 0.125);
}

test::FormulaExterior stream(const coupler::Vec3& u) {
  return test::FormulaExterior([u](const coupler::Vec3&, double) {
    return coupler::DonorState{0.0, u, 0.0};
  });
}

TEST(SeveralBoxesTest, OnlyTheBoundaryOfTheUnionHasElements) {
  const FaceElements<2> faces(bent(), 0.1, FaceRows::fixed);
  double area[2][2] = {};
  for (std::size_t e = 0; e < faces.size(); ++e) area[faces[e].axis][faces[e].side] += faces[e].area;
  EXPECT_NEAR(area[0][0], 1.5, 1e-12);
  EXPECT_NEAR(area[0][1], 0.6 + 0.9, 1e-12) << "the step of the L and its end";
  EXPECT_NEAR(area[1][0], 2.5, 1e-12);
  EXPECT_NEAR(area[1][1], 1.5 + 1.0, 1e-12);
}

TEST(SeveralBoxesTest, AClosedSurfaceInSpaceToo) {
  // a box on top of another's side, set off by what is no multiple of the spacing
  const Layers<3> layers({open_box<3>({0, 0, 0}, {1, 1, 1}), open_box<3>({1, 0.13, 0.27}, {2, 0.71, 1.33})},
                         0.1, 0.1);
  const FaceElements<3> faces(layers, 0.09, FaceRows::fixed);
  for (std::size_t d = 0; d < 3; ++d) {
    double sum = 0.0;
    for (std::size_t e = 0; e < faces.size(); ++e)
      if (faces[e].axis == d) sum += faces[e].inward * faces[e].area;
    EXPECT_NEAR(sum, 0.0, 1e-12) << "direction " << d;
  }
}

TEST(SeveralBoxesTest, AStreamBringsNoNetMass) {
  FaceElements<2> faces(bent(), 0.1, FaceRows::fixed);
  faces.integrate(stream({1.0, 0.0, 0.7}), {1000.0, 10.0, 0.0}, 0.0, 1.0);
  EXPECT_NEAR(faces.flux(), 0.0, 1e-9);
}

TEST(SeveralBoxesTest, FaceBetweenTouchingBoxesIsNoBoundary) {
  const auto layers = bent();
  EXPECT_EQ(layers.zone(layers.excess({1.0, 0.2})), Zone::interior);
  EXPECT_EQ(layers.zone(layers.excess({1.1, 0.2})), Zone::interior);
  EXPECT_EQ(layers.zone(layers.excess({1.1, 0.9})), Zone::blending);
  EXPECT_EQ(layers.blocked_normals({1.2, 0.2}, 0.2), (std::array<bool, 2>{false, false}));
  EXPECT_EQ(layers.blocked_normals({1.2, 0.9}, 0.2), (std::array<bool, 2>{true, false}));
}

TEST(SeveralBoxesTest, AParticleLeavesThroughTheUnionsBoundary) {
  const FaceElements<2> faces(bent(), 0.1, FaceRows::fixed);
  const auto through = [&](const Point<2>& x) { return faces.crossed(x); };
  EXPECT_EQ(through({1.2, 0.2}), faces.size()) << "from one box into the other";
  EXPECT_EQ(through({0.9, 0.64}), faces.size());
  const std::size_t step = through({1.26, 0.9});
  ASSERT_LT(step, faces.size());
  EXPECT_EQ(faces[step].centre[0], 1.25);
  EXPECT_NEAR(faces[step].centre[1], 0.9, 0.051);
  const std::size_t roof = through({1.8, 0.66});
  ASSERT_LT(roof, faces.size());
  EXPECT_EQ(faces[roof].centre[1], 0.65);
  const std::size_t corner = through({1.2505, 0.651});  // in the bay of the L
  ASSERT_LT(corner, faces.size());
  EXPECT_LT(std::hypot(faces[corner].centre[0] - 1.25, faces[corner].centre[1] - 0.65), 0.08);
}

}  // namespace
}  // namespace littoral::sph
