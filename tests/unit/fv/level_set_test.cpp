#include <gtest/gtest.h>

#include "level_set/elevation.hpp"
#include "level_set_march.hpp"
#include "overset/assembly.hpp"
#include "split_grids.hpp"

namespace littoral::fv {
namespace {

template <int D>
using Dim = std::integral_constant<int, D>;
using Dimensions = testing::Types<Dim<2>, Dim<3>>;
template <class T>
class LevelSetTest : public testing::Test {};
TYPED_TEST_SUITE(LevelSetTest, Dimensions);

template <int D>
Window<D> of(Condition condition) {
  Window<D> w;
  w.name = "face";
  w.condition = condition;
  return w;
}

/// A unit box of n cells a side, sheared, in walls; as one block.
template <int D>
std::vector<Block<D>> sheared_box(int n, double shear = 0.4) {
  std::vector<Block<D>> blocks = {deformed_box<D>(n, 0.0, shear, 0.0)};
  close_with<D>(blocks[0], Condition::slip);
  return blocks;
}

template <int D>
double ball(const SpaceVector<D>& x, double centre, double radius) {
  SpaceVector<D> r = x;
  for (double& component : r) component -= centre;
  return length(r) - radius;
}

TEST(WetShareTest, IsTheShareOfPointsBelowThePlane) {
  const int n = 60;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  for (int trial = 0; trial < 40; ++trial) {
    const std::array<double, 3> slope = {number(random), number(random) * (trial % 3), number(random)};
    const double value = number(random);
    int below = 0;
    for_each_index<3>({}, {n, n, n}, [&](const std::array<int, 3>& i) {
      double f = value;
      for (std::size_t d = 0; d < 3; ++d) f += slope[d] * ((2.0 * i[d] + 1.0) / n - 1.0);
      below += f < 0.0 ? 1 : 0;
    });
    EXPECT_NEAR(wet_share<3>(value, slope), static_cast<double>(below) / (n * n * n), 2.0 / n) << trial;
    EXPECT_NEAR(wet_share<3>(value, slope) + wet_share<3>(-value, slope), 1.0, 1e-13);
    // a direction without slope does not count
    EXPECT_NEAR(wet_share<3>(value, {slope[0], 0.0, slope[2]}), wet_share<2>(value, {slope[0], slope[2]}),
                1e-13);
    EXPECT_NEAR(wet_share<3>(value, {slope[0], 1e-7, slope[2]}), wet_share<2>(value, {slope[0], slope[2]}),
                1e-6);
  }
  EXPECT_NEAR(wet_share<2>(0.25, {0.0, 0.5}), 0.25, 1e-15);
  EXPECT_NEAR((wet_share<3>(0.5, {0.5, 0.5, 0.5})), 1.0 / 6.0, 1e-13);  // a corner
}

TYPED_TEST(LevelSetTest, GhostsContinueLinearPhiOnAnyGrid) {
  constexpr int D = TypeParam::value;
  for (const Condition condition : {Condition::wall, Condition::outflow, Condition::far_field}) {
    auto grid = split_grid<D>(
        [] {
          std::array<std::vector<int>, D> cuts;
          cuts.fill({4, 3});
          return cuts;
        }(),
        {}, skewed<D>, [&](int, int) { return of<D>(condition); }, 5);
    const Exchange<D> exchange(grid.parts);
    const auto plane = [](const SpaceVector<D>& x) { return 0.3 + 0.7 * x[0] - 1.1 * x[D - 1]; };
    std::vector<Field> phi;
    for (const auto& block : grid.parts) {
      phi.emplace_back(block.extent.size, -1e30);
      for_each_index<D>({}, block.extent.n, [&](const std::array<int, D>& index) {
        const std::ptrdiff_t c = block.extent.at(index);
        phi.back()[static_cast<std::size_t>(c)] = plane(place(block, c));
      });
    }
    exchange.scalar(grid.parts, phi, ScalarGhosts::level_set);
    for (std::size_t b = 0; b < phi.size(); ++b)
      for (std::size_t c = 0; c < phi[b].size(); ++c)
        EXPECT_NEAR(phi[b][c], plane(place(grid.parts[b], static_cast<std::ptrdiff_t>(c))), 1e-11);
  }
}

TYPED_TEST(LevelSetTest, GivenSurfaceBeyondAFarFieldIsADistance) {
  constexpr int D = TypeParam::value;
  auto blocks = sheared_box<D>(5);
  for (auto& w : blocks[0].windows) {
    w.condition = Condition::far_field;
    w.surface = [](const std::array<double, 3>& x, double t) { return 7.0 * (x[2] - 0.3 - t); };
  }
  evaluate_surface_windows(blocks[0], 0.2);
  std::vector<Field> phi = {Field(blocks[0].extent.size, 0.0)};
  Exchange<D>(blocks).scalar(blocks, phi, ScalarGhosts::level_set);
  std::array<int, D> corner;
  corner.fill(-2);
  const std::ptrdiff_t c = blocks[0].extent.at(corner);
  EXPECT_NEAR(phi[0][static_cast<std::size_t>(c)], place(blocks[0], c)[D - 1] - 0.5, 1e-11);
}

TYPED_TEST(LevelSetTest, PlaneIsExactOutToTheBandsEdge) {
  constexpr int D = TypeParam::value;
  const auto plane = [](const SpaceVector<D>& x) { return (0.6 * (x[0] - 0.7) + 0.8 * (x[D - 1] - 0.47)); };
  // any function with the same zero level; cells are parallelepipeds, where a plane is exact
  const March<D> march(
      sheared_box<D>(14), [&](const SpaceVector<D>& x) { return 3.0 * plane(x); }, {}, 5);
  EXPECT_LT(march.error(plane, 5), 1e-13);
  std::ptrdiff_t cells = 0;
  for_each_index<D>({}, march.blocks[0].extent.n, [&](const std::array<int, D>& index) {
    const std::ptrdiff_t c = march.blocks[0].extent.at(index);
    EXPECT_EQ(march.surface.phi[0][static_cast<std::size_t>(c)] < 0.0,
              plane(place(march.blocks[0], c)) < 0.0);
    ++cells;
  });
  EXPECT_GT(cells, march.surface.band.cells(0).size());  // the box is larger than the band
}

TYPED_TEST(LevelSetTest, BallFromAnUnevenFunctionOfThirdOrder) {
  constexpr int D = TypeParam::value;
  const auto exact = [](const SpaceVector<D>& x) { return ball<D>(x, 0.52, 0.31); };
  const auto uneven = [&](const SpaceVector<D>& x) { return exact(x) * (2.0 + std::sin(5.0 * x[0])); };
  std::array<double, 2> error;
  for (std::size_t i = 0; i < 2; ++i)
    error[i] = March<D>(sheared_box<D>(D == 2 ? 20 << i : 12 << i, 0.2), uneven, {}, 4).error(exact, 4);
  EXPECT_GT(std::log2(error[0] / error[1]), 2.5) << error[0] << ' ' << error[1];
}

TYPED_TEST(LevelSetTest, ReinitialisingAgainAndAgainMovesNothing) {
  constexpr int D = TypeParam::value;
  March<D> march(
      sheared_box<D>(16, 0.2), [](const SpaceVector<D>& x) { return ball<D>(x, 0.53, 0.3); }, {}, 4);
  const auto start = march.surface.phi;
  const double h = 1.0 / 16;
  // a wave on phi that leaves its zero level alone, off the cells at the surface
  for (const std::ptrdiff_t c : march.surface.band.cells(0, 1, 4)) {
    const auto i = static_cast<std::size_t>(c);
    march.surface.phi[0][i] *= 1.0 + 0.5 * std::sin(20.0 * place(march.blocks[0], c)[0]);
  }
  march.exchange.scalar(march.blocks, march.surface.phi, ScalarGhosts::level_set);
  for (int i = 0; i < 50; ++i)
    reinitialise(march.blocks, march.exchange, 4, InterfaceCells::frozen, march.surface.phi,
                 march.surface.band, march.surface.patches);
  for (const std::ptrdiff_t c : march.surface.band.cells(0, 0, 1))
    EXPECT_EQ(march.surface.phi[0][static_cast<std::size_t>(c)], start[0][static_cast<std::size_t>(c)]);
  EXPECT_LT(march.error([](const SpaceVector<D>& x) { return ball<D>(x, 0.53, 0.3); }, 4), 0.05 * h);
}

/// Cells of one grid, as one block and as several turned ones.
template <int D>
void expect_parts_equal_whole(const std::array<bool, D>& periodic) {
  std::array<std::vector<int>, D> cuts;
  cuts.fill({4, 4});
  cuts[0] = {7, 5};
  const auto grid = split_grid<D>(
      cuts, periodic, wavy<D>, [](int, int) { return of<D>(Condition::wall); }, 7);
  // periodic along the first direction
  const auto shape = [](const SpaceVector<D>& x) {
    return x[D - 1] - 0.45 - 0.13 * std::sin(2.0 * M_PI * (x[0] - 0.25 * x[D - 1]));
  };
  const auto flow = [](const SpaceVector<D>& x, double) {
    SpaceVector<D> u{};
    u[0] = 0.6;
    u[D - 1] = 0.3 * std::cos(2.0 * M_PI * (x[0] - 0.25 * x[D - 1]));
    return u;
  };
  March<D> whole({grid.whole}, shape, {}, 4), parts(grid.parts, shape, {}, 4);
  for (int i = 0; i < 3; ++i) {
    whole.step(0.02, flow);
    parts.step(0.02, flow);
  }
  int compared = 0;
  grid.for_each_cell_of_parts([&](std::size_t b, std::size_t c, std::size_t w) {
    const int layer = whole.surface.band.layer(0, static_cast<std::ptrdiff_t>(w));
    EXPECT_EQ(parts.surface.band.layer(b, static_cast<std::ptrdiff_t>(c)), layer);
    if (layer >= 4) return;
    EXPECT_NEAR(parts.surface.phi[b][c], whole.surface.phi[0][w], 1e-13);
    ++compared;
  });
  EXPECT_GT(compared, 60);
}

TYPED_TEST(LevelSetTest, JoinedBlocksGiveWhatOneBlockGives) {
  constexpr int D = TypeParam::value;
  std::array<bool, D> periodic{};
  periodic[0] = true;
  if (D == 3) periodic[1] = true;
  expect_parts_equal_whole<D>(periodic);
}

TYPED_TEST(LevelSetTest, LinearVelocityIsContinuedExactlyIntoAir) {
  constexpr int D = TypeParam::value;
  std::array<std::vector<int>, D> cuts;
  cuts.fill({5, 4});
  const auto grid = split_grid<D>(
      cuts, {}, skewed<D>, [](int, int) { return of<D>(Condition::wall); }, 11);
  const auto shape = [](const SpaceVector<D>& x) { return ball<D>(x, 0.8, 0.35); };
  March<D> march(grid.parts, shape, {}, 5);
  const auto linear = [](const SpaceVector<D>& x, double) {
    SpaceVector<D> u{};
    for (std::size_t k = 0; k < D; ++k) u[k] = 0.3 + 1.7 * x[k] - 0.9 * x[(k + 1) % D];
    return u;
  };
  march.set_flow(linear, 0.0);
  std::vector<VectorField<D>*> at;
  std::vector<WetMask> wet;
  for (std::size_t b = 0; b < march.blocks.size(); ++b) {
    at.push_back(&march.u[b]);
    wet.emplace_back(march.surface.phi[b].size(), 1);
    for (std::size_t c = 0; c < march.surface.phi[b].size(); ++c) {
      if (march.surface.phi[b][c] < 0.0) continue;
      wet[b][c] = 0;
      march.u[b][0][c] = march.u[b][D - 1][c] = 1e9;
    }
  }
  march.surface.extension.extend(march.blocks, march.exchange, march.surface.band, march.surface.patches, wet,
                                 3, at);
  int reached = 0;
  for (std::size_t b = 0; b < march.blocks.size(); ++b)
    for (const std::ptrdiff_t c : march.surface.band.cells(b, 0, 3)) {
      const SpaceVector<D> exact = linear(place(march.blocks[b], c), 0.0);
      for (std::size_t k = 0; k < D; ++k)
        EXPECT_NEAR(march.u[b][k][static_cast<std::size_t>(c)], exact[k], 1e-10);
      ++reached;
    }
  EXPECT_GT(reached, 50);
}

TYPED_TEST(LevelSetTest, SurfaceVelocityIsThatOfTheClosestPoint) {
  constexpr int D = TypeParam::value;
  const auto shape = [](const SpaceVector<D>& x) { return ball<D>(x, 0.5, 0.29); };
  const auto flow = [](const SpaceVector<D>& x, double) {
    SpaceVector<D> u{};
    for (std::size_t k = 0; k < D; ++k) u[k] = std::sin(2.0 * x[k] + 3.0 * x[(k + 1) % D]);
    return u;
  };
  std::array<std::array<double, 2>, 2> error{};  // [resolution][layer 0, beyond]
  for (std::size_t i = 0; i < 2; ++i) {
    March<D> march(sheared_box<D>(D == 2 ? 24 << i : 14 << i, 0.2), shape, {}, 3);
    march.set_flow(flow, 0.0);
    march.surface.follower.follow(march.blocks, march.exchange, march.surface.band, march.surface.patches,
                                  march.surface.phi, {&march.u[0]}, false, march.surface.surface_velocity);
    for (const std::ptrdiff_t c : march.surface.band.cells(0)) {
      SpaceVector<D> r = place(march.blocks[0], c);
      for (double& x : r) x -= 0.5;
      const double size = length(r);
      for (double& x : r) x = 0.5 + x * 0.29 / size;
      const SpaceVector<D> exact = flow(r, 0.0);
      double& worst = error[i][march.surface.band.layer(0, c) == 0 ? 0 : 1];
      for (std::size_t k = 0; k < D; ++k)
        worst = std::max(
            worst, std::abs(march.surface.surface_velocity[0][k][static_cast<std::size_t>(c)] - exact[k]));
    }
  }
  EXPECT_GT(std::log2(error[0][0] / error[1][0]), 2.6) << error[0][0] << ' ' << error[1][0];
  EXPECT_GT(std::log2(error[0][1] / error[1][1]), 1.6) << error[0][1] << ' ' << error[1][1];
}

TEST(LevelSetTransportTest, CircleCarriedAndTurnedKeepsItsShape) {
  // a stream with a rotation that comes and goes, so that the closest points matter
  const auto flow = [](const SpaceVector<2>& x, double t) {
    return SpaceVector<2>{0.5 + std::cos(t) * (x[1] - 0.5), 0.25 - std::cos(t) * (x[0] - 0.35 - 0.5 * t)};
  };
  std::array<double, 2> error, lost;
  for (std::size_t i = 0; i < 2; ++i) {
    const int n = 32 << i;
    March<2> march(sheared_box<2>(n, 0.2), [](const SpaceVector<2>& x) {
      return length(SpaceVector<2>{x[0] - 0.45, x[1] - 0.45}) - 0.2;
    });
    const double before = march.volume(), dt = 0.4 / n;
    while (march.t < 0.4 - 1e-9) march.step(dt, flow);
    lost[i] = std::abs(march.volume() / before - 1.0);
    // the centre's path by a fine integration of the flow at it: the circle stays one, the flow is rigid
    SpaceVector<2> centre = {0.45, 0.45};
    for (int k = 0; k < 4000; ++k) {
      const double t = (k + 0.5) * 1e-4;
      const SpaceVector<2> u = flow(centre, t);
      const SpaceVector<2> middle = {centre[0] + 0.5e-4 * u[0], centre[1] + 0.5e-4 * u[1]};
      const SpaceVector<2> v = flow(middle, t);
      centre = {centre[0] + 1e-4 * v[0], centre[1] + 1e-4 * v[1]};
    }
    error[i] = march.error(
        [&](const SpaceVector<2>& x) {
          return length(SpaceVector<2>{x[0] - centre[0], x[1] - centre[1]}) - 0.2;
        },
        1);
  }
  EXPECT_GT(std::log2(error[0] / error[1]), 1.8) << error[0] << ' ' << error[1];
  EXPECT_LT(error[1], 0.02 / 64);
  EXPECT_LT(lost[1], 2e-4) << lost[0];
}

TEST(LevelSetTransportTest, SweepsConvergeAtASurfaceCflOfFive) {
  March<2> march(
      sheared_box<2>(24, 0.0), [](const SpaceVector<2>& x) { return x[1] - 0.5; }, {}, 12);
  const auto flow = [](const SpaceVector<2>&, double) { return SpaceVector<2>{0.0, 1.0}; };
  march.step(1.0 / 24, flow, 10);
  march.surface.options.sweeps = 40;
  march.step(5.0 / 25, flow, 6);
  EXPECT_LT(march.residual, 1e-3);
  EXPECT_LT(march.error([&](const SpaceVector<2>& x) { return x[1] - 0.5 - march.t; }, 1), 1e-3);
}

TEST(LevelSetTransportTest, ForcedPhiReachesItsTarget) {  // (23)
  March<2> march(sheared_box<2>(16, 0.0), [](const SpaceVector<2>& x) { return x[1] - 0.5; });
  SurfaceForcing& forcing = march.surface.forcing[0];
  forcing.rate.assign(march.blocks[0].extent.size, 40.0);
  forcing.target.resize(march.blocks[0].extent.size);
  for (std::size_t c = 0; c < forcing.target.size(); ++c)
    forcing.target[c] = march.blocks[0].centre[1][c] - 0.53;
  const auto rest = [](const SpaceVector<2>&, double) { return SpaceVector<2>{}; };
  for (int i = 0; i < 10; ++i) march.step(0.05, rest);
  EXPECT_LT(march.error([](const SpaceVector<2>& x) { return x[1] - 0.53; }, 4), 1e-5);
}

TYPED_TEST(LevelSetTest, ElevationOfATiltedPlaneAndOfTheUpperOfTwoSurfaces) {
  constexpr int D = TypeParam::value;
  std::array<std::vector<int>, D> cuts;
  cuts.fill({6, 5});
  const auto grid = split_grid<D>(
      cuts, {}, [](const std::array<double, D>& xi) { return xi; },
      [](int, int) { return of<D>(Condition::wall); }, 3);
  const auto plane = [](const SpaceVector<D>& x) { return 0.6 * (x[0] - 0.5) + 0.8 * (x[D - 1] - 0.47); };
  const March<D> tilted(grid.parts, plane);
  const coupler::Vec3 up = {0.0, 0.0, 1.0};
  const auto height = [&](const March<D>& march, double x) {
    std::vector<Elevation> readings;
    for (std::size_t b = 0; b < march.blocks.size(); ++b)
      readings.push_back(ElevationLine<D>(march.blocks[b], {x, 0.4, 9.0}, up).read(march.surface.phi[b]));
    return highest(readings).height;
  };
  for (const double x : {0.07, 0.31, 0.5, 0.82})
    EXPECT_NEAR(height(tilted, x), 0.47 - 0.75 * (x - 0.5), 1e-12);
  // a layer of air with water over it, and air again
  const March<D> layers(grid.parts, [](const SpaceVector<D>& x) {
    const double z = x[D - 1];
    return std::max(z - 0.83, std::min(z - 0.22, 0.52 - z));
  });
  EXPECT_NEAR(height(layers, 0.4), 0.83, 1e-9);
  const March<D> air(grid.parts, [](const SpaceVector<D>& x) { return x[0] + 9.0; });
  EXPECT_TRUE(std::isnan(height(air, 0.4)));
  EXPECT_FALSE(ElevationLine<D>(air.blocks[0], {7.0, 0.4, 0.0}, up).found());
}

/// A surface through a turned, finer patch: distance and motion across the overlap.
TEST(LevelSetOversetTest, PlaneIsExactAndWaveUndisturbedAcrossTheOverlap) {
  const auto grid = [] {
    std::vector<Block<2>> blocks;
    blocks.push_back(make_block<2>("box", {32, 32}, {}, [](const std::array<int, 2>& i) {
      return std::array<double, 2>{i[0] / 32.0, i[1] / 32.0};
    }));
    close_with<2>(blocks[0], Condition::slip);
    blocks.push_back(make_block<2>("patch", {26, 26}, {}, [](const std::array<int, 2>& i) {
      const double a = 0.5 * (i[0] / 26.0 - 0.5), b = 0.5 * (i[1] / 26.0 - 0.5);
      return std::array<double, 2>{0.5 + 0.8 * a - 0.6 * b, 0.5 + 0.6 * a + 0.8 * b};
    }));
    close_with<2>(blocks[1], Condition::overset);
    return blocks;
  };
  auto blocks = grid();
  auto assembly = assemble_overset<2>(blocks, {});
  const auto plane = [](const SpaceVector<2>& x) { return 0.28 * (x[0] - 0.5) + 0.96 * (x[1] - 0.49); };
  March<2> still(blocks, plane, assembly.links, 5);
  EXPECT_LT(still.error(plane, 5), 1e-12);

  const auto shape = [](double t) {
    return [t](const SpaceVector<2>& x) { return length(SpaceVector<2>{x[0] - 0.3 - t, x[1] - 0.5}) - 0.13; };
  };
  March<2> moving(blocks, shape(0.0), assembly.links);
  const double before = moving.volume();
  while (moving.t < 0.4 - 1e-9)
    moving.step(0.4 / 40, [](const SpaceVector<2>&, double) { return SpaceVector<2>{1.0, 0.0}; });
  EXPECT_LT(moving.error(shape(0.4), 2), 0.06 / 32);
  EXPECT_NEAR(moving.volume() / before, 1.0, 0.02);
}

}  // namespace
}  // namespace littoral::fv
