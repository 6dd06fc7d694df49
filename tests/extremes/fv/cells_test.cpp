// Shapes of cells: thin, stretched, skewed, alone, dead; grids that hardly overlap.
#include <gtest/gtest.h>

#include "overset/assembly.hpp"
#include "runs.hpp"
#include "split_grids.hpp"

namespace littoral::fv {
namespace {

/// Couette flow between plates one apart, in cells `aspect` times as long as high: u = z is the steady state.
double couette_error(Block<2> block, int steps, const char* what, double value) {
  close_with<2>(block, Condition::periodic);
  set_face<2>(block, 1, 0, Condition::wall);
  set_face<2>(block, 1, 1, Condition::wall, 1.0);
  Equations<2> equations;
  equations.fluid.viscosity = 0.1;
  InnerTolerance tolerance = three_orders();
  tolerance.drop = 1e-6;
  Stepper<2> stepper({block}, equations, std::make_unique<MultigridSolver<2>>(), tolerance);
  stepper.initialise([](const std::array<double, 2>&, double) { return PointState<2>{}; }, 0.0);
  march(stepper, 100.0, steps, what, value);
  double worst = 0.0;
  for_each_index<2>({}, block.extent.n, [&](const std::array<int, 2>& index) {
    const auto c = static_cast<std::size_t>(block.extent.at(index));
    worst = std::max(worst, std::abs(stepper.state()[0].u[0][c] - block.centre[1][c]));
  });
  return worst;
}

TEST(ExtremeCellsTest, AspectRatioFromOneToAHundredThousand) {
  for (const double aspect : {1.0, 1e2, 1e3, 1e4, 1e5}) {
    const Block<2> block =
        make_block<2>("thin", {8, 16}, {true, false}, [=](const std::array<int, 2>& index) {
          return std::array<double, 2>{aspect / 16.0 * index[0], index[1] / 16.0};
        });
    EXPECT_LT(couette_error(block, 5, "aspect ratio", aspect), 1e-5) << aspect;
  }
}

TEST(ExtremeCellsTest, EachCellHalfAsWideAgain) {
  const Block<2> block = make_block<
      2>("stretched", {8, 20}, {true, false}, [](const std::array<int, 2>& index) {
    return std::array<double, 2>{index[0] / 8.0, (std::pow(1.5, index[1]) - 1.0) / (std::pow(1.5, 20) - 1.0)};
  });
  EXPECT_LT(couette_error(block, 5, "stretching", 1.5), 1e-5);
}

TEST(ExtremeCellsTest, SkewedByEightyDegrees) {
  for (const double degrees : {45.0, 70.0, 80.0}) {
    const double shear = std::tan(degrees * M_PI / 180.0);
    const Block<2> block =
        make_block<2>("skewed", {16, 16}, {true, false}, [=](const std::array<int, 2>& index) {
          return std::array<double, 2>{index[0] / 16.0 + shear * index[1] / 16.0, index[1] / 16.0};
        });
    EXPECT_LT(couette_error(block, 8, "skew [degree]", degrees), 1e-4) << degrees;
  }
}

/// A turned patch of m x m cells over Couette flow: u = z is linear, so the fringes' interpolation is exact.
double patched_couette_error(int m, int overlap) {
  constexpr int n = 24;
  std::vector<Block<2>> blocks;
  blocks.push_back(make_block<2>("channel", {n, n}, {true, false}, [](const std::array<int, 2>& index) {
    return std::array<double, 2>{static_cast<double>(index[0]) / n, static_cast<double>(index[1]) / n};
  }));
  const double width = static_cast<double>(m) / n;
  blocks.push_back(make_block<2>("patch", {m, m}, {}, [=](const std::array<int, 2>& index) {
    const double a = width * (static_cast<double>(index[0]) / m - 0.5);
    const double b = width * (static_cast<double>(index[1]) / m - 0.5);
    return std::array<double, 2>{0.5 + 0.8 * a - 0.6 * b, 0.5 + 0.6 * a + 0.8 * b};
  }));
  close_with<2>(blocks[0], Condition::periodic);
  set_face<2>(blocks[0], 1, 0, Condition::wall);
  set_face<2>(blocks[0], 1, 1, Condition::wall, 1.0);
  close_with<2>(blocks[1], Condition::overset);
  OversetOptions options;
  options.overlap = overlap;
  OversetAssembly<2> assembly = assemble_overset<2>(blocks, options);
  Equations<2> equations;
  equations.fluid.viscosity = 0.1;
  InnerTolerance tolerance = three_orders();
  tolerance.drop = 1e-6;
  Stepper<2> stepper(std::move(blocks), equations, std::make_unique<MultigridSolver<2>>(), tolerance,
                     std::move(assembly.links));
  stepper.initialise([](const std::array<double, 2>&, double) { return PointState<2>{}; }, 0.0);
  march(stepper, 100.0, 5, "patch of cells", m);
  double worst = 0.0;
  for (std::size_t b = 0; b < 2; ++b)
    for_each_index<2>({}, stepper.blocks()[b].extent.n, [&](const std::array<int, 2>& index) {
      const auto c = static_cast<std::size_t>(stepper.blocks()[b].extent.at(index));
      if (stepper.blocks()[b].status[c] == CellStatus::blanked) return;
      worst = std::max(worst, std::abs(stepper.state()[b].u[0][c] - stepper.blocks()[b].centre[1][c]));
    });
  return worst;
}

TEST(ExtremeCellsTest, GridsThatHardlyOverlap) {
  EXPECT_LT(patched_couette_error(14, 1), 1e-5);
  EXPECT_LT(patched_couette_error(8, 1), 1e-5);  // fringe, overlap and fringe, and little else
  EXPECT_LT(patched_couette_error(6, 1), 1e-5);  // no hole below it
  EXPECT_LT(patched_couette_error(4, 1), 1e-5);  // fringe only
}

/// A channel of 3 x 3 blocks, the one in the middle a single cell, its neighbours one cell wide: Couette flow
/// as in one block.
TEST(ExtremeCellsTest, OneCellBetweenLongerBlocks) {
  const std::vector<int> parts = {8, 1, 7};
  const auto whole = [](const std::array<double, 2>& s) { return s; };
  const auto close = [](int direction, int side) {
    Window<2> w;
    w.condition = direction == 0 ? Condition::periodic : Condition::wall;
    w.velocity[0] = constant(side == 0 ? 0.0 : 1.0);
    return w;
  };
  const auto grid = split_grid<2>({parts, parts}, {true, false}, whole, close, 0);
  ASSERT_EQ(grid.parts.size(), 9u);
  Equations<2> equations;
  equations.fluid.viscosity = 0.1;
  InnerTolerance tolerance = three_orders();
  tolerance.drop = 1e-6;
  Stepper<2> stepper(grid.parts, equations, std::make_unique<MultigridSolver<2>>(), tolerance);
  stepper.initialise([](const std::array<double, 2>&, double) { return PointState<2>{}; }, 0.0);
  EXPECT_TRUE(march(stepper, 100.0, 5, "one cell in the middle of", 9).converged);
  for (std::size_t b = 0; b < stepper.blocks().size(); ++b) {
    const Block<2>& block = stepper.blocks()[b];
    for_each_index<2>({}, block.extent.n, [&](const std::array<int, 2>& index) {
      const auto c = static_cast<std::size_t>(block.extent.at(index));
      EXPECT_NEAR(stepper.state()[b].u[0][c], block.centre[1][c], 1e-5) << block.name;
    });
  }
}

TEST(ExtremeCellsTest, OneCellAlone) {
  Block<3> single = make_block<3>("one", {1, 1, 1}, {false, false, false}, [](const std::array<int, 3>& i) {
    return std::array<double, 3>{1.0 * i[0], 1.0 * i[1], 1.0 * i[2]};
  });
  close_with<3>(single, Condition::wall);
  Equations<3> equations;
  equations.fluid.viscosity = 0.1;
  Stepper<3> stepper({single}, equations, std::make_unique<MultigridSolver<3>>(), three_orders());
  stepper.initialise(
      [](const std::array<double, 3>&, double) {
        return PointState<3>{0.0, {1.0, 0.0, 0.0}};
      },
      0.0);
  EXPECT_LT(march(stepper, 1.0, 5, "one cell between walls", 1).fastest, 0.1);  // friction stops it
}

TEST(ExtremeCellsTest, ABlockOfDeadCellsIsLeftAlone) {
  Block<2> block = deformed_box<2>(8);
  close_with<2>(block, Condition::wall);
  for_each_index<2>({}, block.extent.n, [&](const std::array<int, 2>& index) {
    block.status[static_cast<std::size_t>(block.extent.at(index))] = CellStatus::blanked;
  });
  set_solved_mask(block);
  Stepper<2> stepper({block}, Equations<2>{}, std::make_unique<MultigridSolver<2>>(), three_orders());
  stepper.initialise(
      [](const std::array<double, 2>&, double) {
        return PointState<2>{7.0, {1.0, 2.0}};
      },
      0.0);
  const Outcome outcome = march(stepper, 0.1, 3, "dead block", 0);
  EXPECT_EQ(outcome.cycles, 0);
  EXPECT_TRUE(outcome.converged);
}

}  // namespace
}  // namespace littoral::fv
