#include <gtest/gtest.h>

#include "dual_time/stepper.hpp"
#include "grid/find_joins.hpp"
#include "grids.hpp"
#include "implicit/multigrid_solver.hpp"
#include "littoral/error.hpp"
#include "overset/assembly.hpp"
#include "overset/wall_side.hpp"

namespace littoral::fv {
namespace {

template <int D>
void window(Block<D>& block, int direction, int side, Condition condition) {
  Window<D> w;
  w.name = name(condition);
  w.condition = condition;
  w.direction = direction;
  w.side = side;
  w.upper = block.extent.n;
  block.windows.push_back(w);
}

/// Cells about a cylinder of radius .5, out to 1; closed on itself; a unit long in 3-D.
template <int D>
Block<D> ring(int n_around, int n_out) {
  std::array<int, D> cells{};
  cells[0] = n_around;
  cells[1] = n_out;
  std::array<bool, D> periodic{};
  periodic[0] = true;
  if (D == 3) cells[2] = 6, periodic[2] = true;
  Block<D> block = make_block<D>("ring", cells, periodic, [=](const std::array<int, D>& i) {
    const double r = 0.5 + 0.5 * i[1] / n_out, a = -2.0 * M_PI * i[0] / n_around;
    std::array<double, D> x{};
    x[0] = r * std::cos(a);
    x[1] = r * std::sin(a);
    if constexpr (D == 3) x[2] = i[2] / 6.0;
    return x;
  });
  window<D>(block, 0, 0, Condition::periodic);
  window<D>(block, 0, 1, Condition::periodic);
  window<D>(block, 1, 0, Condition::wall);
  window<D>(block, 1, 1, Condition::overset);
  if (D == 3) window<D>(block, 2, 0, Condition::periodic), window<D>(block, 2, 1, Condition::periodic);
  return block;
}

template <int D>
Block<D> box(int n, double half = 2.0) {
  std::array<int, D> cells{};
  cells[0] = n;
  cells[1] = n + 2;
  std::array<bool, D> periodic{};
  if (D == 3) cells[2] = 4, periodic[2] = true;
  Block<D> block = make_block<D>("box", cells, periodic, [=](const std::array<int, D>& i) {
    std::array<double, D> x{};
    x[0] = half * (2.0 * i[0] / n - 1.0);
    x[1] = half * (2.0 * i[1] / (n + 2) - 1.0);
    if (D == 3) x[D - 1] = i[D - 1] / 4.0;
    return x;
  });
  for (int d = 0; d < D; ++d)
    for (int side = 0; side < 2; ++side)
      window<D>(block, d, side, d < 2 ? Condition::far_field : Condition::periodic);
  return block;
}

template <int D>
std::vector<Block<D>> ring_over_box() {
  return {box<D>(48), ring<D>(64, 12)};
}

template <int D>
std::array<double, D> centre(const Block<D>& block, std::ptrdiff_t c) {
  std::array<double, D> x;
  for (std::size_t k = 0; k < D; ++k) x[k] = block.centre[k][static_cast<std::size_t>(c)];
  return x;
}

template <int D>
using Dim = std::integral_constant<int, D>;
using Dimensions = testing::Types<Dim<2>, Dim<3>>;
template <class T>
class OversetAssemblyTest : public testing::Test {};
TYPED_TEST_SUITE(OversetAssemblyTest, Dimensions);

TYPED_TEST(OversetAssemblyTest, BodyIsBlankedAndEveryNeighbourOfASolvedCellHasAValue) {
  constexpr int D = TypeParam::value;
  auto blocks = ring_over_box<D>();
  const auto assembly = assemble_overset<D>(blocks, {});
  EXPECT_GT(assembly.n_blanked, 0);
  EXPECT_EQ(assembly.n_interpolated, static_cast<long>(assembly.links.receivers.size()));
  for (const Block<D>& block : blocks)
    for_each_index<D>({}, block.extent.n, [&](const std::array<int, D>& index) {
      const std::ptrdiff_t c = block.extent.at(index);
      const auto x = centre<D>(block, c);
      const double r = std::hypot(x[0], x[1]);
      const CellStatus status = block.status[static_cast<std::size_t>(c)];
      if (block.name == "box" && r < 0.5) {
        EXPECT_NE(status, CellStatus::computed) << r;
      }
      if (block.name == "box" && r > 1.0) {
        EXPECT_EQ(status, CellStatus::computed) << r;
      }
      if (status != CellStatus::computed) return;
      for (std::size_t d = 0; d < D; ++d)
        for (const int step : {-2, -1, 1, 2}) {  // the reconstruction's reach
          auto other = index;
          other[d] += step;
          if (block.periodic[d]) other[d] = (other[d] + block.extent.n[d]) % block.extent.n[d];
          if (other[d] < 0 || other[d] >= block.extent.n[d]) continue;
          EXPECT_NE(block.status[static_cast<std::size_t>(block.extent.at(other))], CellStatus::blanked);
        }
    });
}

TYPED_TEST(OversetAssemblyTest, DonorsAreSolvedAndLinearFieldsExact) {
  constexpr int D = TypeParam::value;
  auto blocks = ring_over_box<D>();
  const auto assembly = assemble_overset<D>(blocks, {});
  // in space without the periodic direction, along which nothing linear is periodic
  const auto linear = [](const std::array<double, D>& x) { return 2.0 + 3.0 * x[0] - 1.7 * x[1]; };
  for (const auto& r : assembly.links.receivers) {
    double value = 0.0, sum = 0.0;
    for (std::size_t k = 0; k < r.weight.size(); ++k) {
      const Block<D>& donor = blocks[r.donor_block[k]];
      EXPECT_NE(r.donor_block[k], r.block);
      EXPECT_EQ(donor.status[static_cast<std::size_t>(r.donor[k])], CellStatus::computed);
      value += r.weight[k] * linear(centre<D>(donor, r.donor[k]));
      sum += r.weight[k];
    }
    EXPECT_NEAR(sum, 1.0, 1e-12);
    EXPECT_NEAR(value, linear(centre<D>(blocks[r.block], r.cell)), 1e-11);
  }
}

TYPED_TEST(OversetAssemblyTest, UniformStreamStaysUniformThroughTheOverlap) {
  constexpr int D = TypeParam::value;
  auto blocks = ring_over_box<D>();
  const auto stream = [](std::size_t k) { return k == 0 ? 1.0 : k == 1 ? 0.3 : -0.2; };
  for (Block<D>& block : blocks)
    for (Window<D>& w : block.windows) {
      if (w.condition == Condition::wall) w.condition = Condition::state;  // a ring of water in a stream
      for (std::size_t k = 0; k < D; ++k)
        w.velocity[k] = [=](const std::array<double, 3>&, double) { return stream(k); };
    }
  auto assembly = assemble_overset<D>(blocks, {});
  Equations<D> equations;
  equations.fluid.viscosity = 0.01;
  InnerTolerance tolerance;
  tolerance.floor = 1e-13;
  Stepper<D> stepper(std::move(blocks), equations, std::make_unique<MultigridSolver<D>>(), tolerance,
                     std::move(assembly.links));
  stepper.initialise(
      [&](const std::array<double, D>&, double) {
        PointState<D> s;
        for (std::size_t k = 0; k < D; ++k) s.u[k] = stream(k);
        return s;
      },
      0.0);
  for (int step = 0; step < 3; ++step) stepper.advance(0.1);
  for (std::size_t b = 0; b < 2; ++b)
    for_each_index<D>({}, stepper.blocks()[b].extent.n, [&](const std::array<int, D>& index) {
      const auto c = static_cast<std::size_t>(stepper.blocks()[b].extent.at(index));
      if (stepper.blocks()[b].status[c] == CellStatus::blanked) return;
      for (std::size_t k = 0; k < D; ++k) EXPECT_NEAR(stepper.state()[b].u[k][c], stream(k), 1e-11);
      EXPECT_NEAR(stepper.state()[b].p[c], 0.0, 1e-9);
    });
}

/// A grid below with cells too large to hold fringe, overlap and fringe under the ring.
TEST(OversetOrphansTest, AreNamedWithTheirPlace) {
  std::vector<Block<2>> blocks = {box<2>(48), ring<2>(64, 4)};
  try {
    assemble_overset<2>(blocks, {});
    FAIL() << "an overlap of four cells cannot hold both fringes";
  } catch (const ConfigError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("orphans"), std::string::npos) << text;
    EXPECT_NE(text.find("block '"), std::string::npos) << text;
  }
}

TEST(WallSideTest, TellsTheBodyFromTheWater) {
  const std::vector<Block<2>> blocks = {ring<2>(40, 4)};
  const WallSide<2> walls(blocks, {0});
  EXPECT_TRUE(walls.behind({0.0, 0.0}));
  EXPECT_TRUE(walls.behind({0.47, 0.1}));
  EXPECT_FALSE(walls.behind({0.5, 0.1}));
  EXPECT_FALSE(walls.behind({-3.0, 7.0}));
}

/// A sheet between two blocks, wet on both sides.
TEST(WallSideTest, AThinSheetHasNoInside) {
  std::vector<Block<2>> blocks;
  for (const int below : {0, 1}) {
    blocks.push_back(make_block<2>("half", {4, 4}, {}, [=](const std::array<int, 2>& i) {
      return std::array<double, 2>{0.25 * i[0], 0.25 * i[1] - below};
    }));
    window<2>(blocks.back(), 1, below, Condition::wall);
  }
  const WallSide<2> walls(blocks, {0, 1});
  for (const double z : {-0.3, -0.01, 0.01, 0.3})
    for (const double x : {-0.5, 0.1, 0.25, 1.0, 1.4}) EXPECT_FALSE(walls.behind({x, z})) << x << ' ' << z;
}

/// Taylor-Green vortices carried by a stream through a patch of finer, turned cells: second order across the
/// overlap, and no worse there than elsewhere.
double vortex_error(int n, double* jump) {
  const double k = 2.0 * M_PI, nu = 1e-3, dt = 0.2 / n;
  std::vector<Block<2>> blocks;
  blocks.push_back(make_block<2>("square", {n, n}, {true, true}, [=](const std::array<int, 2>& i) {
    return std::array<double, 2>{static_cast<double>(i[0]) / n, static_cast<double>(i[1]) / n};
  }));
  for (int d = 0; d < 2; ++d)
    for (int side = 0; side < 2; ++side) window<2>(blocks.back(), d, side, Condition::periodic);
  const int m = 5 * n / 8;
  blocks.push_back(make_block<2>("patch", {m, m}, {}, [=](const std::array<int, 2>& i) {
    const double a = 0.5 * (static_cast<double>(i[0]) / m - 0.5),
                 b = 0.5 * (static_cast<double>(i[1]) / m - 0.5);
    const double c = std::cos(0.5), s = std::sin(0.5);
    return std::array<double, 2>{0.5 + c * a - s * b, 0.5 + s * a + c * b};
  }));
  for (int d = 0; d < 2; ++d)
    for (int side = 0; side < 2; ++side) window<2>(blocks.back(), d, side, Condition::overset);
  auto assembly = assemble_overset<2>(blocks, {});
  Equations<2> equations;
  equations.fluid.density = 1.0;
  equations.fluid.viscosity = nu;
  equations.fluid.inverse_c2 = 1e-4;
  InnerTolerance tolerance;
  tolerance.drop = 1e-4;
  Stepper<2> stepper(std::move(blocks), equations, std::make_unique<MultigridSolver<2>>(), tolerance,
                     std::move(assembly.links));
  const auto exact = [=](const std::array<double, 2>& x, double t) {
    const double decay = std::exp(-2.0 * nu * k * k * t);
    const double X = k * (x[0] - t), Z = k * (x[1] - 0.5 * t);
    PointState<2> s;
    s.u = {1.0 + decay * std::sin(X) * std::cos(Z), 0.5 - decay * std::cos(X) * std::sin(Z)};
    s.p = 0.25 * decay * decay * (std::cos(2.0 * X) + std::cos(2.0 * Z));
    return s;
  };
  stepper.initialise(exact, 0.0);
  while (stepper.time() < 0.2 - 1e-9) stepper.advance(dt);
  double sum = 0.0, area = 0.0, at_fringe = 0.0;
  for (std::size_t b = 0; b < 2; ++b)
    for_each_index<2>({}, stepper.blocks()[b].extent.n, [&](const std::array<int, 2>& index) {
      const std::ptrdiff_t c = stepper.blocks()[b].extent.at(index);
      const auto at = static_cast<std::size_t>(c);
      const CellStatus status = stepper.blocks()[b].status[at];
      if (status == CellStatus::blanked) return;
      const auto e = exact(centre<2>(stepper.blocks()[b], c), stepper.time());
      const double error =
          std::hypot(stepper.state()[b].u[0][at] - e.u[0], stepper.state()[b].u[1][at] - e.u[1]);
      if (status == CellStatus::interpolated) {
        at_fringe = std::max(at_fringe, error);
        return;
      }
      sum += error * error * stepper.blocks()[b].volume[at];
      area += stepper.blocks()[b].volume[at];
    });
  *jump = at_fringe;
  return std::sqrt(sum / area);
}

TEST(OversetVortexTest, SecondOrderThroughTheOverlap) {
  double jump_coarse = 0.0, jump_fine = 0.0;
  const double coarse = vortex_error(32, &jump_coarse), fine = vortex_error(64, &jump_fine);
  std::printf(
      "vortex through the overlap: errors %.3g, %.3g, order %.2f; jumps at the fringe %.3g, %.3g, order "
      "%.2f\n",
      coarse, fine, std::log2(coarse / fine), jump_coarse, jump_fine, std::log2(jump_coarse / jump_fine));
  EXPECT_GT(std::log2(coarse / fine), 1.9) << coarse << ' ' << fine;
  EXPECT_GT(std::log2(jump_coarse / jump_fine), 1.7) << jump_coarse << ' ' << jump_fine;
  EXPECT_LT(jump_fine, 6.0 * fine);  // largest at the fringe against the mean everywhere
}

TEST(OversetHoleTest, AWallThatTheGridBelowDoesNotSeeIsRefused) {
  for (const auto condition : {Condition::wall, Condition::overset}) {
    std::vector<Block<2>> blocks;
    blocks.push_back(make_block<2>("coarse", {2, 2}, {}, [](const std::array<int, 2>& i) {
      return std::array<double, 2>{10.0 * i[0], 10.0 * i[1]};
    }));
    blocks.push_back(make_block<2>("patch", {12, 12}, {}, [](const std::array<int, 2>& i) {
      return std::array<double, 2>{9.4 + 0.1 * i[0], 9.4 + 0.1 * i[1]};
    }));
    for (int d = 0; d < 2; ++d)
      for (int side = 0; side < 2; ++side) {
        window<2>(blocks[0], d, side, Condition::slip);
        window<2>(blocks[1], d, side, d == 0 && side == 0 ? condition : Condition::overset);
      }
    if (condition == Condition::wall) {
      EXPECT_THROW(assemble_overset<2>(blocks, {}), ConfigError);
    } else {
      EXPECT_NE(assemble_overset<2>(blocks, {}).notes.back().find("warning"), std::string::npos);
    }
  }
}

/// Two patches, turned, over a box and over each other: every place is counted once.
TEST(OversetPartitionTest, EveryPlaceIsCountedOnce) {
  const auto patch = [](const char* name, double x, double angle, int n) {
    return make_block<2>(name, {n, n}, {}, [=](const std::array<int, 2>& i) {
      const double a = 0.5 * (static_cast<double>(i[0]) / n - 0.5),
                   b = 0.5 * (static_cast<double>(i[1]) / n - 0.5);
      return std::array<double, 2>{x + std::cos(angle) * a - std::sin(angle) * b,
                                   0.5 + std::sin(angle) * a + std::cos(angle) * b};
    });
  };
  std::vector<Block<2>> blocks;
  blocks.push_back(make_block<2>("box", {64, 64}, {}, [](const std::array<int, 2>& i) {
    return std::array<double, 2>{i[0] / 64.0, i[1] / 64.0};
  }));
  blocks.push_back(patch("one", 0.42, 0.5, 40));
  blocks.push_back(patch("other", 0.58, 0.2, 36));
  for (std::size_t b = 0; b < 3; ++b)
    for (int d = 0; d < 2; ++d)
      for (int side = 0; side < 2; ++side)
        window<2>(blocks[b], d, side, b == 0 ? Condition::slip : Condition::overset);
  assemble_overset<2>(blocks, {});
  double area = 0.0, solved = 0.0;
  for (const Block<2>& block : blocks)
    for_each_index<2>({}, block.extent.n, [&](const std::array<int, 2>& index) {
      const auto c = static_cast<std::size_t>(block.extent.at(index));
      area += counted_share(block, c) * block.volume[c];
      solved += block.solved[c] * block.volume[c];
    });
  EXPECT_NEAR(area, 1.0, 2e-4);
  EXPECT_GT(solved, 1.03);  // what the cells that are solved would make of it
}

/// A lid drives a closed, incompressible box: what the interpolation lets into the hole has nowhere to go,
/// and the inner iteration would stall at that flux (ClosedContour).
TEST(OversetClosedBoxTest, InnerIterationDoesNotStall) {
  std::vector<Block<2>> blocks;
  blocks.push_back(make_block<2>("box", {24, 24}, {}, [](const std::array<int, 2>& i) {
    return std::array<double, 2>{i[0] / 24.0, i[1] / 24.0};
  }));
  blocks.push_back(make_block<2>("patch", {16, 16}, {}, [](const std::array<int, 2>& i) {
    const double a = 0.6 * (i[0] / 16.0 - 0.5), b = 0.6 * (i[1] / 16.0 - 0.5);
    return std::array<double, 2>{0.5 + 0.8 * a - 0.6 * b, 0.5 + 0.6 * a + 0.8 * b};
  }));
  for (int d = 0; d < 2; ++d)
    for (int side = 0; side < 2; ++side) {
      window<2>(blocks[0], d, side, Condition::wall);
      window<2>(blocks[1], d, side, Condition::overset);
    }
  blocks[0].windows.back().velocity[0] = [](const std::array<double, 3>&, double) { return 1.0; };
  auto assembly = assemble_overset<2>(blocks, {});
  Equations<2> equations;
  equations.fluid.viscosity = 0.01;
  InnerTolerance tolerance;
  tolerance.drop = 1e-6;
  tolerance.max_cycles = 80;
  Stepper<2> stepper(std::move(blocks), equations, std::make_unique<MultigridSolver<2>>(), tolerance,
                     std::move(assembly.links));
  stepper.initialise([](const std::array<double, 2>&, double) { return PointState<2>{}; }, 0.0);
  for (int step = 0; step < 12; ++step) EXPECT_TRUE(stepper.advance(0.05).converged) << step;
}

}  // namespace
}  // namespace littoral::fv
