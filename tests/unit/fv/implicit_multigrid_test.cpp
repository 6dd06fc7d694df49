#include <gtest/gtest.h>

#include "implicit_models.hpp"

namespace littoral::fv {
namespace {

/// The cycle as a solver of the first-order Jacobian itself, all its levels alike.
MultigridOptions first_order() {
  MultigridOptions options;
  options.jump.fill(1.0);
  return options;
}

/// Mean reduction of the residual a V(1,1) cycle, over `cycles` cycles from random data.
template <int D>
double convergence_factor(const Block<D>& block, const CorrectionPhysics<D>& physics, EdgeCondition upper,
                          int cycles = 6, double speed = 1.0) {
  LevelGrid<D> grid = level_grid(block);
  test::set_all_edges(grid, EdgeCondition::wall, upper);
  State<D> q = test::smooth_state(block, speed);
  fill_periodic(grid, q.p);
  for (auto& f : q.u) fill_periodic(grid, f);
  Multigrid<D, double> multigrid({grid}, first_order());
  multigrid.build({&q}, physics);
  test::randomise(grid, multigrid.right_side(0));
  Correction<D, double> r;
  multigrid.cycle(true);
  multigrid.residual(0, r);
  const double first = test::norm(grid, r);
  for (int i = 0; i < cycles; ++i) multigrid.cycle(false);
  multigrid.residual(0, r);
  return std::pow(test::norm(grid, r) / first, 1.0 / cycles);
}

/// c0 dt/h below 1, where coupled runs live (h = 1/32): lines and coarse levels leave little.
TEST(ImplicitMultigridTest, CycleContractsWhateverMachNumberAndAspectRatio) {
  for (const double aspect : {1.0, 30.0, 1000.0})
    for (const double dt : {0.001, 0.005, 0.02})
      for (const double mach : {0.0, 0.1})
        EXPECT_LT(convergence_factor<2>(test::stretched_block<2>({32, 32}, {true, false}, aspect),
                                        test::physics<2>(dt, mach, 1e-3), EdgeCondition::outflow),
                  0.25)
            << "aspect " << aspect << " dt " << dt << " mach " << mach;
}

/// Beyond, the dissipation of first-order upwinding, which doubles from level to level, allows no better than
/// about 1/2 for what it damps: the classical limit, reached at c0 dt/h = 32.
TEST(ImplicitMultigridTest, LargeStepsContractToTheLimitOfUpwinding) {
  for (const double aspect : {1.0, 30.0, 1000.0})
    for (const double dt : {0.1, 1.0})
      EXPECT_LT(convergence_factor<2>(test::stretched_block<2>({32, 32}, {true, false}, aspect),
                                      test::physics<2>(dt, 0.1, 1e-3), EdgeCondition::outflow),
                dt > 0.5 ? 0.68 : 0.45)
          << "aspect " << aspect << " dt " << dt;
}

TEST(ImplicitMultigridTest, ThreeDimensions) {
  for (const double aspect : {1.0, 100.0})
    EXPECT_LT(convergence_factor<3>(test::stretched_block<3>({12, 12, 12}, {true, true, false}, aspect),
                                    test::physics<3>(0.02, 0.1, 1e-3), EdgeCondition::outflow, 4),
              0.35)
        << "aspect " << aspect;
}

TEST(ImplicitMultigridTest, OddCountsAndSkewCostLittle) {
  EXPECT_LT(convergence_factor<2>(test::stretched_block<2>({25, 27}, {false, false}, 10.0),
                                  test::physics<2>(0.02, 0.1, 0.0), EdgeCondition::outflow),
            0.25);
  EXPECT_LT(convergence_factor<2>(test::stretched_block<2>({25, 25}, {true, false}, 1.0),
                                  test::physics<2>(0.02, 0.1, 0.0), EdgeCondition::imposed),
            0.25);
  EXPECT_LT(convergence_factor<2>(test::stretched_block<2>({32, 32}, {false, false}, 1.0, 0.7),
                                  test::physics<2>(0.02, 0.0, 0.0), EdgeCondition::outflow),
            0.3);
}

TEST(ImplicitMultigridTest, ClosedIncompressibleBoxIsSolvableUpToItsPressureLevel) {
  // the right side sums to zero in the mass row, as a conservative residual does
  const auto block = test::stretched_block<2>({32, 32}, {false, false}, 1.0);
  LevelGrid<2> grid = level_grid(block);
  test::set_all_edges(grid, EdgeCondition::wall, EdgeCondition::wall);
  const State<2> q = test::smooth_state(block, 0.0);
  Multigrid<2, double> multigrid({grid}, first_order());
  multigrid.build({&q}, test::physics<2>(0.02, 0.0, 1e-2));
  EXPECT_TRUE(multigrid.floating());
  auto& b = multigrid.right_side(0);
  test::randomise(grid, b);
  double mean = 0.0;
  for_each_cell<2>(grid.extent,
                   [&](const auto&, std::ptrdiff_t c) { mean += b.q[0][static_cast<std::size_t>(c)]; });
  for_each_cell<2>(grid.extent, [&](const auto&, std::ptrdiff_t c) {
    b.q[0][static_cast<std::size_t>(c)] -= mean / 1024.0;
  });
  const double start = test::norm(grid, b);
  Correction<2, double> r;
  for (int i = 0; i < 10; ++i) multigrid.cycle(i == 0);
  multigrid.residual(0, r);
  EXPECT_LT(test::norm(grid, r), 1e-6 * start);
}

TEST(ImplicitMultigridTest, CycleConvergesToTheDenseSolution) {
  const auto block = test::stretched_block<2>({8, 8}, {false, false}, 5.0);
  LevelGrid<2> grid = level_grid(block);
  test::set_all_edges(grid, EdgeCondition::wall, EdgeCondition::outflow);
  // a hole with its fringe, so that all statuses but forced take part
  for (int j = 5; j < 8; ++j)
    for (int i = 3; i < 6; ++i)
      grid.status[static_cast<std::size_t>(grid.extent.at({i, j}))] =
          j == 5 ? CellStatus::fringe : CellStatus::blanked;
  const State<2> q = test::smooth_state(block, 1.0);
  const auto physics = test::physics<2>(0.02, 0.1, 1e-3);
  Multigrid<2, double> multigrid({grid}, first_order());
  multigrid.build({&q}, physics);
  auto& b = multigrid.right_side(0);
  test::randomise(grid, b);
  for (int i = 0; i < 40; ++i) multigrid.cycle(i == 0);

  LineOperator<2, double> op(grid, 1);
  op.build(grid, q, physics);
  const Eigen::MatrixXd a = test::dense<2>(grid, op);
  Eigen::VectorXd right(a.rows());
  Eigen::Index at = 0;
  for_each_cell<2>(grid.extent, [&](const auto&, std::ptrdiff_t c) {
    for (const auto& f : b.q) right[at++] = f[static_cast<std::size_t>(c)];
  });
  const Eigen::VectorXd exact = a.partialPivLu().solve(right);
  at = 0;
  const auto& e = multigrid.correction(0);
  for_each_cell<2>(grid.extent, [&](const auto&, std::ptrdiff_t c) {
    for (const auto& f : e.q)
      EXPECT_NEAR(f[static_cast<std::size_t>(c)], exact[at++], 1e-9 * exact.cwiseAbs().maxCoeff());
    if (!grid.solved(c)) {
      for (const auto& f : e.q) EXPECT_EQ(f[static_cast<std::size_t>(c)], 0.0);
    }
  });
}

/// K/delta stands in the diagonal of every level, so forced regions contract as computed ones do, whether
/// the mass row is forced with them or not.
TEST(ImplicitMultigridTest, ForcedCellsCostNothing) {
  const auto block = test::stretched_block<2>({32, 32}, {true, false}, 1.0);
  LevelGrid<2> grid = level_grid(block);
  test::set_all_edges(grid, EdgeCondition::wall, EdgeCondition::outflow);
  for (const double psi : {0.0, 0.01})
    for (const double k : {10.0, 100.0, 1000.0}) {
      auto physics = test::physics<2>(0.02, 0.1, 0.0);
      physics.forcing_psi = psi;
      Field rate(grid.extent.size, 0.0);
      for (int j = 8; j < 24; ++j)
        for (int i = 8; i < 24; ++i) {
          const auto c = static_cast<std::size_t>(grid.extent.at({i, j}));
          rate[c] = k / physics.time.dt;
          grid.status[c] = CellStatus::forced;
        }
      State<2> q = test::smooth_state(block, 1.0);
      fill_periodic(grid, q.p);
      for (auto& f : q.u) fill_periodic(grid, f);
      Multigrid<2, double> multigrid({grid}, first_order());
      multigrid.build({&q}, physics, {&rate});
      test::randomise(grid, multigrid.right_side(0));
      Correction<2, double> r;
      multigrid.cycle(true);
      multigrid.residual(0, r);
      const double first = test::norm(grid, r);
      for (int i = 0; i < 6; ++i) multigrid.cycle(false);
      multigrid.residual(0, r);
      EXPECT_LT(std::pow(test::norm(grid, r) / first, 1.0 / 6.0), 0.3) << "K " << k << " psi " << psi;
    }
}

/// <P e, r> = <e, P^T r>, with mirrored, periodic and odd ends: the restriction is the exact transpose.
/// (Where two slip faces meet at an angle their reflections do not commute, and the corner cell is not.)
TEST(ImplicitMultigridTest, RestrictionIsTheTransposeOfProlongation) {
  for (const std::array<int, 2>& cells : {std::array<int, 2>{12, 9}, std::array<int, 2>{7, 16}}) {
    const auto block = test::stretched_block<2>(cells, {cells[0] % 2 == 0, false}, 3.0);
    LevelGrid<2> fine = level_grid(block);
    test::set_all_edges(fine, EdgeCondition::wall, EdgeCondition::slip);
    const auto ratio = coarsening_ratio<2>(fine);
    const LevelGrid<2> coarse = coarsen<2>(fine, ratio);
    const Transfer<2> transfer(fine, coarse, ratio);
    Correction<2, double> e, r, pe, rr;
    e.assign_zero(coarse.extent.size);
    rr.assign_zero(coarse.extent.size);
    r.assign_zero(fine.extent.size);
    pe.assign_zero(fine.extent.size);
    test::randomise(coarse, e, 1);
    test::randomise(fine, r, 2);
    fill_correction_ghosts(coarse, e);
    transfer.add_prolonged(e, pe);
    fill_correction_ghosts(fine, r);
    transfer.restrict_residual(r, rr);
    double left = 0.0, right = 0.0, size = 0.0;
    for_each_cell<2>(fine.extent, [&](const auto&, std::ptrdiff_t c) {
      for (std::size_t i = 0; i < 3; ++i) {
        const auto s = static_cast<std::size_t>(c);
        left += pe.q[i][s] * r.q[i][s];
        size += std::abs(pe.q[i][s] * r.q[i][s]);
      }
    });
    for_each_cell<2>(coarse.extent, [&](const auto&, std::ptrdiff_t c) {
      for (std::size_t i = 0; i < 3; ++i)
        right += e.q[i][static_cast<std::size_t>(c)] * rr.q[i][static_cast<std::size_t>(c)];
    });
    EXPECT_NEAR(left, right, 1e-14 * size);
  }
}

}  // namespace
}  // namespace littoral::fv
