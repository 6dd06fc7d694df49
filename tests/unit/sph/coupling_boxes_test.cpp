#include <gtest/gtest.h>

#include <cmath>

#include "coupling/face_elements.hpp"
#include "coupling/particle_exchange.hpp"
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

/// Particles inside the outer faces of each box.
template <int D>
std::vector<double> count_by_box(const Particles<D>& particles, const Layers<D>& layers) {
  std::vector<double> n;
  for (const auto& box : layers.boxes()) {
    n.push_back(0.0);
    for (std::size_t i = 0; i < particles.n_owned; ++i) n.back() += box.inside_outer(at<D>(particles.x, i));
  }
  return n;
}

TEST(SeveralBoxesTest, AStreamLeavesOneBoxAndEntersTheNext) {
  // outer faces .75 apart, the second box half a row higher
  const double dx = 0.125, u = 1.0, dt = 0.15 * dx * 1.01, rise = 0.0625;
  const Layers<2> layers({open_box<2>({0.0, 0.0}, {1.0, 1.0}), open_box<2>({2.75, rise}, {3.75, 1.0 + rise})},
                         0.25, 0.25);
  const LinearEos eos{1000.0, 10.0, 0.0};
  const auto fv = stream({u, 0.0, 0.0});
  Particles<2> particles;
  for (const auto& box : layers.boxes()) {
    const auto own = test::lattice<2>(box.outer_lower, box.outer_upper, dx, eos, fv);
    for (std::size_t i = 0; i < own.n_owned; ++i)
      particles.append({at<2>(own.x, i), at<2>(own.u, i), own.V[i], own.m[i], own.p[i], own.zone[i]});
  }
  ParticleExchange<2> exchange(layers, eos, dx, Removal::crossing);
  exchange.start(particles);
  const auto start = count_by_box(particles, layers);
  constexpr int k_steps = 400;
  for (int k = 0; k < k_steps; ++k) {
    for (std::size_t i = 0; i < particles.n_owned; ++i) particles.x[0][i] += u * dt;
    exchange.step(particles, fv, k * dt, dt);
    const auto ledger = exchange.ledger(particles);
    const auto n = count_by_box(particles, layers);
    ASSERT_LT(std::fabs(ledger.defect), 1e-14 * ledger.mass_inside) << "step " << k;
    for (std::size_t b = 0; b < 2; ++b) ASSERT_LE(std::fabs(n[b] - start[b]), 16.0) << "a row of box " << b;
    ASSERT_EQ(n[0] + n[1], static_cast<double>(particles.n_owned)) << "none between the boxes";
  }
  const double rows = k_steps * u * dt / dx;  // that have crossed each face
  const auto& counts = exchange.counts();
  EXPECT_NEAR(static_cast<double>(counts.injected_through[0]), 2.0 * 16.0 * rows, 2.0 * 16.0);
  EXPECT_NEAR(static_cast<double>(counts.removed_through[1]), 2.0 * 16.0 * rows, 2.0 * 16.0);
  EXPECT_EQ(counts.injected_through[1] + counts.removed_through[0], 0);
}

}  // namespace
}  // namespace littoral::sph
