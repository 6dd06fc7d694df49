#include <gtest/gtest.h>

#include "boundary/ghosts.hpp"
#include "grid/ring.hpp"
#include "grid/stretching.hpp"
#include "grids.hpp"
#include "littoral/error.hpp"

namespace littoral::fv {
namespace {

Spacing spacing_of(Spacing::Kind kind, double first, Spacing::Toward toward) {
  Spacing s;
  s.kind = kind;
  s.first_cell = first;
  s.toward = toward;
  return s;
}

TEST(StretchingTest, TheFirstCellIsTheOneAskedFor) {
  using Kind = Spacing::Kind;
  using Toward = Spacing::Toward;
  for (const Kind kind : {Kind::geometric, Kind::tanh})
    for (const Toward toward : {Toward::lower, Toward::upper, Toward::both})
      for (const double first : {1e-5, 1e-2}) {
        Stretching s;
        static_cast<Spacing&>(s) = spacing_of(kind, first, toward);
        const auto x = node_positions(s, 96, -1.0, 3.0, "here");
        ASSERT_EQ(x.size(), 97u);
        EXPECT_EQ(x.front(), -1.0);
        EXPECT_EQ(x.back(), 3.0);
        if (toward != Toward::upper) {
          EXPECT_NEAR((x[1] - x[0]) / first, 1.0, 1e-9);
        }
        if (toward != Toward::lower) {
          EXPECT_NEAR((x[96] - x[95]) / first, 1.0, 1e-9);
        }
        for (std::size_t i = 1; i < x.size(); ++i) EXPECT_GT(x[i], x[i - 1]);
      }
}

TEST(StretchingTest, SectionsFollowOneAnother) {
  Stretching s;
  s.sections.resize(2);
  s.sections[0].to = 1.0;
  s.sections[0].cells = 4;
  s.sections[0].spacing = spacing_of(Spacing::Kind::geometric, 0.1, Spacing::Toward::upper);
  s.sections[1].to = 2.0;
  s.sections[1].cells = 10;
  const auto x = node_positions(s, 14, 0.0, 2.0, "here");
  EXPECT_DOUBLE_EQ(x[4], 1.0);
  EXPECT_NEAR(x[4] - x[3], 0.1, 1e-9);
  EXPECT_NEAR(x[5] - x[4], 0.1, 1e-12);
  EXPECT_THROW(node_positions(s, 13, 0.0, 2.0, "here"), ConfigError);
  EXPECT_THROW(node_positions(s, 14, 0.0, 2.5, "here"), ConfigError);
}

TEST(StretchingTest, AFirstCellThatDoesNotFitIsRefused) {
  Stretching s;
  static_cast<Spacing&>(s) = spacing_of(Spacing::Kind::geometric, 0.5, Spacing::Toward::lower);
  EXPECT_THROW(node_positions(s, 10, 0.0, 1.0, "here"), ConfigError);
  s.first_cell = 1e-30;
  EXPECT_THROW(node_positions(s, 10, 0.0, 1.0, "here"), ConfigError);
}

RingConfig ring_of(int around, int outward) {
  RingConfig r;
  r.radius = 0.5;
  r.outer_radius = 4.0;
  r.around = around;
  r.outward = outward;
  r.spacing = spacing_of(Spacing::Kind::geometric, 0.01, Spacing::Toward::lower);
  for (auto& face : r.faces) face.condition = static_cast<int>(Condition::wall);
  r.span.upper = 0.7;
  r.span.cells = 3;
  for (auto& face : r.span.faces) face.condition = static_cast<int>(Condition::symmetry);
  return r;
}

template <int D>
void check_ring(double span) {
  support::Scene scene;
  scene.gravity[2] = -9.81;  // no obstacle: a ring closes on itself without an offset
  const Block<D> ring = build_ring<D>(ring_of(40, 12), scene, {});
  check_windows(ring);
  EXPECT_TRUE(ring.periodic[0]);
  double volume = 0.0;
  for_each_index<D>({}, ring.extent.n, [&](const std::array<int, D>& i) {
    volume += ring.volume[static_cast<std::size_t>(ring.extent.at(i))];
  });
  const double polygon = 20.0 * std::sin(2.0 * M_PI / 40);  // area of the 40-gon of radius 1
  EXPECT_NEAR(volume, polygon * (16.0 - 0.25) * span, 1e-12);
}

TEST(RingTest, IsRightHandedClosedAndOfTheRightArea) {
  check_ring<2>(1.0);
  check_ring<3>(0.7);
}

TEST(RingTest, FacesWithoutConditionAskForAJoin) {
  RingConfig r = ring_of(8, 12);
  r.faces[RingConfig::outer] = {};
  const Block<2> ring = build_ring<2>(r, support::Scene(), {});
  for (const auto& w : ring.windows)
    if (w.direction == 1 && w.side == 1) {
      EXPECT_EQ(w.request.kind, JoinRequest<2>::Kind::required);
    }
}

}  // namespace
}  // namespace littoral::fv
