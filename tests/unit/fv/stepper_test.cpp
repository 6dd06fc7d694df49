#include "dual_time/stepper.hpp"

#include <gtest/gtest.h>

#include "dual_time/plain.hpp"
#include "grids.hpp"
#include "implicit/multigrid_solver.hpp"
#include "littoral/error.hpp"

namespace littoral::fv {
namespace {

/// All faces periodic, fields uniform: only the time terms are left.
Stepper<2> periodic_box(int n, const Equations<2>& equations, double drop = 1e-13, double pseudo_cfl = 1.0) {
  Block<2> block = deformed_box<2>(n, 0.0, 0.0, 0.0, {true, true});
  close_with<2>(block, Condition::periodic);
  std::vector<Block<2>> blocks{block};
  InnerTolerance tolerance;
  tolerance.drop = drop;
  tolerance.floor = 1e-15;
  tolerance.max_cycles = 5000;
  return Stepper<2>(std::move(blocks), equations, std::make_unique<PlainDualTime<2>>(pseudo_cfl), tolerance);
}

TEST(StepperTest, ForcingOvershootsAsBackwardDifferencesDo) {
  // rest, driven towards u = 1 with K/dt, K = 10: BDF1, then BDF2 give K/(1+K), (K + 2u1)/(K + 3/2), ...
  for (const auto& [K, expected] :
       std::vector<std::pair<double, std::array<double, 3>>>{{5.0, {.8333, 1.0256, 1.0207}},
                                                             {10.0, {.9091, 1.0277, 1.0088}},
                                                             {20.0, {.9524, 1.0188, 1.0029}}}) {
    Stepper<2> stepper = periodic_box(4, Equations<2>{});
    const double dt = 0.1;
    stepper.initialise([](const std::array<double, 2>&, double) { return PointState<2>{}; }, 0.0);
    Forcing<2>& forcing = stepper.forcing()[0];
    const std::size_t size = stepper.blocks()[0].extent.size;
    forcing.rate.assign(size, K / dt);
    forcing.pressure_rate = forcing.rate;
    forcing.target.resize(size);
    forcing.target.u[0].assign(size, 1.0);
    forcing.psi = 1.0;
    double before = 0.0, now = 0.0;
    for (int step = 0; step < 3; ++step) {
      stepper.advance(dt);
      const double exact = step == 0 ? K / (1.0 + K) : (K + 2.0 * now - 0.5 * before) / (1.5 + K);
      before = now;
      now = exact;
      const double u =
          stepper.state()[0].u[0][static_cast<std::size_t>(stepper.blocks()[0].extent.at({1, 2}))];
      EXPECT_NEAR(u, exact, 1e-10);
      EXPECT_NEAR(u, expected[static_cast<std::size_t>(step)], 6e-5);  // the table's four digits
    }
  }
}

/// Velocity of a uniform stream under the body force rho0 cos 2t, after time 1, by n steps: sin(2)/2 exactly.
double swung_stream(int n) {
  Equations<2> equations;
  Stepper<2> stepper = periodic_box(4, equations);
  stepper.initialise([](const std::array<double, 2>&, double) { return PointState<2>{}; }, 0.0);
  stepper.set_source([](const std::array<double, 2>&, double t) {
    Source<2> s;
    s.momentum[0] = 1000.0 * std::cos(2.0 * t);
    return s;
  });
  for (int step = 0; step < n; ++step) stepper.advance(1.0 / n);
  return stepper.state()[0].u[0][static_cast<std::size_t>(stepper.blocks()[0].extent.at({0, 0}))];
}

TEST(StepperTest, TimeIsSecondOrder) {
  const double a = swung_stream(20), b = swung_stream(40), c = swung_stream(80);
  const double ratio = (a - b) / (b - c);
  EXPECT_GT(ratio, 3.5);
  EXPECT_LT(ratio, 4.3);
  EXPECT_NEAR(c, std::sin(2.0) / 2.0, 1e-3);
}

TEST(StepperTest, ARestoredStepRepeatsToTheBit) {
  Equations<2> equations;
  equations.fluid.inverse_c2 = 0.01;
  Stepper<2> stepper = periodic_box(8, equations, 1e-4);
  stepper.initialise(
      [](const std::array<double, 2>& x, double) {
        PointState<2> s;
        s.u = {std::sin(2.0 * M_PI * x[1]), 0.3};
        s.p = 10.0 * std::cos(2.0 * M_PI * x[0]);
        return s;
      },
      0.0);
  for (int before = 0; before < 4; ++before) {
    State<2> rate, rate_again;
    stepper.time_derivative(0, rate);
    stepper.advance(0.02);
    const State<2> first = stepper.state()[0];
    stepper.restore();
    stepper.time_derivative(0, rate_again);
    EXPECT_EQ(rate.p, rate_again.p);
    EXPECT_EQ(rate.u[1], rate_again.u[1]);
    stepper.advance(0.02);
    EXPECT_EQ(first.p, stepper.state()[0].p);
    EXPECT_EQ(first.u[0], stepper.state()[0].u[0]);
    EXPECT_EQ(stepper.steps(), before + 1);
  }
}

TEST(StepperTest, ImposedCellsKeepTheirValues) {
  Stepper<2> stepper = periodic_box(6, Equations<2>{}, 1e-3);
  stepper.initialise([](const std::array<double, 2>&, double) { return PointState<2>{}; }, 0.0);
  Block<2>& block = stepper.blocks()[0];
  const auto c = static_cast<std::size_t>(block.extent.at({3, 3}));
  block.status[c] = CellStatus::fringe;
  set_solved_mask(block);
  stepper.advance(0.1, {Imposed<2>{{c}, {5.0}, {Field{0.2}, Field{-0.1}}, {}}});
  EXPECT_EQ(stepper.state()[0].p[c], 5.0);
  EXPECT_EQ(stepper.state()[0].u[0][c], 0.2);
  EXPECT_EQ(stepper.state()[0].u[1][c], -0.1);
  EXPECT_NE(stepper.state()[0].u[0][c + 1], 0.0);
}

TEST(StepperTest, ANaNIsNamedWithPlaceAndAdvice) {
  Stepper<2> stepper = periodic_box(6, Equations<2>{}, 1e-3);
  stepper.initialise([](const std::array<double, 2>&, double) { return PointState<2>{}; }, 0.0);
  stepper.state()[0].u[1][static_cast<std::size_t>(stepper.blocks()[0].extent.at({2, 4}))] = NAN;
  try {
    stepper.advance(0.1);
    FAIL() << "a NaN went on";
  } catch (const StabilityError& e) {
    const std::string text = e.what();
    for (const char* part : {"block 'deformed'", "cell (", "dt was 0.1 s", "try"})
      EXPECT_NE(text.find(part), std::string::npos) << text;
  }
}

TEST(StepperTest, AnInitialStateWithoutDensityIsRefused) {
  Equations<2> equations;
  equations.fluid.inverse_c2 = 0.01;
  Stepper<2> stepper = periodic_box(4, equations);
  EXPECT_THROW(stepper.initialise(
                   [](const std::array<double, 2>&, double) {
                     return PointState<2>{-1e6, {}};
                   },
                   0.0),
               StabilityError);
}

/// A far field's own wave speed is far below c_p = kappa h/dt here: explicit pseudo-time has to know of it.
TEST(StepperTest, PlainDualTimeStandsAFarField) {
  Block<2> block = deformed_box<2>(12, 0.0, 0.0, 0.0);
  const Prescribed stream = [](const std::array<double, 3>&, double) { return 1.0; };
  close_with<2>(block, Condition::far_field, {stream, {}});
  InnerTolerance tolerance;
  tolerance.max_cycles = 200;
  Stepper<2> stepper({block}, Equations<2>{}, std::make_unique<PlainDualTime<2>>(1.0), tolerance);
  stepper.initialise(
      [](const std::array<double, 2>& x, double) {
        const double bump = std::exp(-30.0 * (std::pow(x[0] - 0.5, 2) + std::pow(x[1] - 0.5, 2)));
        return PointState<2>{0.0, {1.0 + bump, 0.0}};
      },
      0.0);
  const StepReport report = stepper.advance(1e-3);
  EXPECT_LT(report.norms.back(), 0.2 * report.norms.front());
  double seconds = 0.0;
  for (const auto& phase : stepper.phases().table()) seconds += phase.second;
  EXPECT_GT(seconds, 0.0);
}

/// The steps of pseudo-time lead to the same answer, the pressure's free level included, and so does the
/// multigrid.
TEST(StepperTest, TheInnerIterationLeavesNoMark) {
  const auto after = [](std::unique_ptr<StepSolver<2>> solver) {
    Block<2> block = deformed_box<2>(8, 0.1, 0.0, 0.0);
    close_with<2>(block, Condition::wall);
    for (Window<2>& w : block.windows)
      if (w.direction == 1 && w.side == 1)
        w.velocity[0] = [](const std::array<double, 3>&, double) { return 1.0; };
    Equations<2> equations;
    equations.fluid.viscosity = 0.05;
    InnerTolerance tolerance;
    tolerance.drop = 1e-9;
    tolerance.floor = 1e-14;
    tolerance.max_cycles = 20000;
    Stepper<2> stepper({block}, equations, std::move(solver), tolerance);
    stepper.initialise([](const std::array<double, 2>&, double) { return PointState<2>{}; }, 0.0);
    for (int step = 0; step < 4; ++step) EXPECT_TRUE(stepper.advance(0.1).converged);
    return stepper.state()[0];
  };
  const State<2> one = after(std::make_unique<PlainDualTime<2>>(1.0));
  const State<2> two = after(std::make_unique<PlainDualTime<2>>(2.0));
  const State<2> multigrid = after(std::make_unique<MultigridSolver<2, double>>());
  const Extent<2> e({8, 8});
  for_each_index<2>({}, {8, 8}, [&](const std::array<int, 2>& index) {
    const auto c = static_cast<std::size_t>(e.at(index));
    for (const State<2>* other : {&two, &multigrid}) {
      EXPECT_NEAR(one.p[c], other->p[c], 1e-4);  // of rho U^2 = 1000 Pa
      for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(one.u[k][c], other->u[k][c], 1e-7);
    }
  });
}

TEST(StepperTest, StartingRatesComeFromTheFieldEquations) {
  // plane acoustic wave in a compressible fluid at rest: du/dt = -p_x/rho
  Equations<2> equations;
  equations.fluid.inverse_c2 = 0.01;
  equations.speeds.c0 = 10.0;
  Stepper<2> stepper = periodic_box(32, equations, 1e-3);
  stepper.initialise(
      [](const std::array<double, 2>& x, double) {
        PointState<2> s;
        s.p = std::sin(2.0 * M_PI * x[0]);
        return s;
      },
      0.0);
  State<2> rate;
  stepper.time_derivative(0, rate);
  const Block<2>& block = stepper.blocks()[0];
  for (int i = 0; i < 32; ++i) {
    const auto c = static_cast<std::size_t>(block.extent.at({i, 3}));
    const double exact = -2.0 * M_PI * std::cos(2.0 * M_PI * block.centre[0][c]) / 1000.0;
    // second-order pressure difference on 32 cells a wave: 4 pi^2/6/32^2 = .6%
    EXPECT_NEAR(rate.u[0][c], exact, 0.01 * 2.0 * M_PI / 1000.0);
  }
}

}  // namespace
}  // namespace littoral::fv
