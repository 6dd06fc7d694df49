#include <gtest/gtest.h>

#include "implicit/held_directions.hpp"
#include "implicit_models.hpp"

namespace littoral::fv {
namespace {

using test::dense;

/// Solving one colour's lines must leave those rows of the dense system satisfied: round-off of the
/// elimination only.
template <int D>
void expect_exact_lines(const Block<D>& block, int direction, double tolerance) {
  LevelGrid<D> grid = level_grid(block);
  test::set_all_edges(grid, EdgeCondition::wall, EdgeCondition::outflow);
  State<D> q = test::smooth_state(block, 1.0);
  for (auto* f : {&q.p, &q.u[0]}) fill_periodic(grid, *f);
  LineOperator<D, double> op(grid, direction);
  op.build(grid, q, test::physics<D>(0.01, 0.1, 1e-3));
  Correction<D, double> b, e, r;
  for (auto* f : {&b, &e, &r}) f->assign_zero(grid.extent.size);
  test::randomise(grid, b);
  test::randomise(grid, e, 11);
  for (auto& f : e.q) fill_periodic(grid, f);
  const double scale = test::norm(grid, b);
  for (int colour = 0; colour < op.layout().n_colours(); ++colour) {
    op.smooth(colour, b, e);
    for (auto& f : e.q) fill_periodic(grid, f);
    op.residual(b, e, r);
    for (std::size_t bundle = op.layout().colour_begin(colour);
         bundle < op.layout().colour_end[static_cast<std::size_t>(colour)]; ++bundle)
      for (const std::ptrdiff_t first : op.layout().bundles[bundle].first)
        for (int k = 0; k < op.layout().length; ++k)
          for (const auto& f : r.q)
            EXPECT_NEAR(f[static_cast<std::size_t>(first + k * op.layout().stride)], 0.0, tolerance * scale);
  }
}

TEST(ImplicitLinesTest, LinesAreSolvedExactly) {
  expect_exact_lines<2>(test::stretched_block<2>({10, 12}, {false, false}, 50.0, 0.3), 1, 1e-11);
  expect_exact_lines<2>(test::stretched_block<2>({10, 12}, {false, false}, 50.0, 0.3), 0, 1e-11);
  expect_exact_lines<3>(test::stretched_block<3>({5, 6, 7}, {false, false, false}, 20.0, 0.2), 2, 1e-11);
}

TEST(ImplicitLinesTest, PeriodicLinesAreSolvedExactly) {
  expect_exact_lines<2>(test::stretched_block<2>({11, 8}, {true, false}, 1.0), 0, 1e-11);
  expect_exact_lines<2>(test::stretched_block<2>({11, 8}, {true, false}, 30.0), 1,
                        1e-11);  // odd: three colours
  expect_exact_lines<3>(test::stretched_block<3>({5, 4, 6}, {true, true, false}, 1.0), 1, 1e-11);
}

TEST(ImplicitLinesTest, NeighboursNeverShareAColour) {
  const auto block = test::stretched_block<3>({5, 7, 3}, {true, true, false}, 1.0);
  const LevelGrid<3> grid = level_grid(block);
  const LineLayout layout = line_layout(grid, 2);
  std::vector<int> colour(35, -1);
  int lines = 0;
  for (int c = 0; c < layout.n_colours(); ++c)
    for (std::size_t b = layout.colour_begin(c); b < layout.colour_end[static_cast<std::size_t>(c)]; ++b) {
      lines += layout.bundles[b].n_lines;
      for (int l = 0; l < layout.bundles[b].n_lines; ++l) {
        const auto index = grid.extent.index(layout.bundles[b].first[static_cast<std::size_t>(l)]);
        colour[static_cast<std::size_t>(index[0] + 5 * index[1])] = c;
      }
    }
  EXPECT_EQ(lines, 35);
  for (int j = 0; j < 7; ++j)
    for (int i = 0; i < 5; ++i) {
      const auto at = [&](int a, int b) {
        return colour[static_cast<std::size_t>((a + 5) % 5 + 5 * ((b + 7) % 7))];
      };
      EXPECT_NE(at(i, j), at(i + 1, j));
      EXPECT_NE(at(i, j), at(i, j + 1));
    }
}

TEST(ImplicitLinesTest, LinesFollowTheThinDirection) {
  EXPECT_EQ(stiff_directions(level_grid(test::stretched_block<2>({16, 16}, {false, false}, 100.0)))[0], 1);
  // uniform: not along the periodic direction
  EXPECT_EQ(stiff_directions(level_grid(test::stretched_block<2>({16, 8}, {false, true}, 1.0)))[0], 0);
  // thin cells at two faces, in different directions
  const auto corner = make_block<2>("corner", {16, 16}, {false, false}, [](const std::array<int, 2>& i) {
    return std::array<double, 2>{std::pow(1.5, i[0]), std::pow(1.5, i[1])};
  });
  EXPECT_EQ(stiff_directions(level_grid(corner)).size(), 2u);
}

TEST(ImplicitLinesTest, LongDirectionsAreHeldWhileTheThinOnesAreHalved) {
  const auto held = [](const std::array<int, 3>& n, const std::array<double, 3>& h) {
    const auto block = make_block<3>("box", n, {false, true, false}, [&](const std::array<int, 3>& i) {
      return std::array<double, 3>{h[0] * i[0], h[1] * i[1], h[2] * i[2]};
    });
    const LevelGrid<3> grid = level_grid(block);
    return held_directions<3>(grid, coarsening_ratio<3>(n, grid.periodic));
  };
  using Held = std::array<bool, 3>;
  EXPECT_EQ(held({8, 8, 8}, {1.0, 1.0, 1.0}), (Held{false, false, false}));
  EXPECT_EQ(held({8, 8, 8}, {4.0, 1.0, 1.0}), (Held{true, false, false}));
  EXPECT_EQ(held({8, 8, 8}, {4.0, 1.0, 0.01}), (Held{true, false, false}));
  EXPECT_EQ(held({8, 8, 8}, {1.0, 1.0, 0.01}), (Held{false, false, false}));  // lines do it
  EXPECT_EQ(held({8, 3, 3}, {4.0, 1.0, 1.0}), (Held{false, false, false}));   // nothing else to halve
}

/// The operator is the derivative of the flux it says it linearises: finite differences of the first-order
/// residual, here by the rows' conservation: without boundaries, time term and forcing, the columns of the
/// mass and momentum rows sum to zero.
TEST(ImplicitLinesTest, FluxesCancelBetweenNeighbours) {
  const auto block = test::stretched_block<2>({6, 6}, {true, true}, 1.0);
  const LevelGrid<2> grid = level_grid(block);
  State<2> q = test::smooth_state(block, 1.0);
  for (auto* f : {&q.p, &q.u[0], &q.u[1]}) fill_periodic(grid, *f);
  auto physics = test::physics<2>(0.01, 0.1, 1e-3);
  physics.time = BackwardDifference::steady();
  LineOperator<2, double> op(grid, 1);
  op.build(grid, q, physics);
  const Eigen::MatrixXd a = dense<2>(grid, op);
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(3, a.cols());
  for (Eigen::Index i = 0; i < a.rows(); ++i) sums.row(i % 3) += a.row(i);
  EXPECT_LT(sums.cwiseAbs().maxCoeff(), 1e-13 * a.cwiseAbs().maxCoeff());
}

TEST(ImplicitLinesTest, FaceJacobianIsTheDerivativeOfItsFlux) {
  CorrectionPhysics<3> physics = test::physics<3>(0.1, 0.2, 0.01);
  physics.fluid.density = 2.0;
  physics.speeds.c0 = 3.0;
  const std::array<double, 3> area{0.3, -0.2, 0.4};
  const double volume = 0.1;
  FaceState<3> left, right;
  left.u = {1.0, 0.4, -0.2};
  right.u = {0.8, 0.5, 0.1};
  SmallMatrix<3> by_left, by_right;
  face_jacobian<3>(area, volume, left, right, physics, physics.mass_speed_between_cells(), by_left, by_right);
  // F9's first-order flux about this state, with the carried velocity and the mass flow's centre frozen
  const double flow0 = 0.5 * (1.8 * 0.3 - 0.9 * 0.2 - 0.1 * 0.4);
  const double s = std::sqrt(0.3 * 0.3 + 0.2 * 0.2 + 0.4 * 0.4);
  const auto flux = [&](const std::array<double, 4>& l, const std::array<double, 4>& r) {
    const double c0 = 3.0, cp = 1.0 / physics.mass_speed().inverse(volume / s);
    double m = 0.5 * c0 * s / cp * (l[0] - r[0]) + c0 * physics.fluid.inverse_c2 * flow0 * l[0], jump = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      m += 0.5 * area[k] * (l[k + 1] + r[k + 1]);
      jump += area[k] * (r[k + 1] - l[k + 1]);
    }
    std::array<double, 4> f{c0 * m, 0, 0, 0};
    for (std::size_t k = 0; k < 3; ++k)
      f[k + 1] = m * left.u[k] + flow0 * l[k + 1] + 0.5 * c0 * area[k] * (l[0] + r[0]) -
                 0.5 * c0 * area[k] / s * jump -
                 0.01 / volume * (s * s * (r[k + 1] - l[k + 1]) + area[k] * jump);
    return f;
  };
  for (std::size_t j = 0; j < 4; ++j) {  // linear in the corrections: unit vectors give the columns
    std::array<double, 4> unit{}, zero{};
    unit[j] = 1.0;
    const auto fl = flux(unit, zero), fr = flux(zero, unit);
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_NEAR(by_left[i][j], fl[i], 1e-14);
      EXPECT_NEAR(by_right[i][j], fr[i], 1e-14);
    }
  }
}

}  // namespace
}  // namespace littoral::fv
