// Time steps, sound speeds, Reynolds numbers, units, impulsive starts: a lid cavity in each.
#include <gtest/gtest.h>

#include "littoral/error.hpp"
#include "runs.hpp"

namespace littoral::fv {
namespace {

/// Nothing in a lid cavity is faster than the lid, but for the overshoots of an unlimited scheme at its
/// corners.
constexpr double k_overshoot = 1.3;

TEST(ExtremeStepsTest, CourantNumberFromAHundredthToAThousand) {
  for (const double cfl : {0.01, 0.1, 1.0, 10.0, 100.0, 1000.0}) {
    Stepper<2> stepper = cavity(16, 1.0, 1.0, 0.01);
    const Outcome outcome = march(stepper, cfl / 16.0, 6, "Courant number", cfl);
    EXPECT_TRUE(outcome.converged) << cfl;
    EXPECT_LT(outcome.fastest, k_overshoot) << cfl;
  }
}

TEST(ExtremeFluidTest, SoundSpeedFromFiveTimesTheFlowToInfinite) {
  double infinite = 0.0;
  for (const double c : {0.0, 1e4, 1e2, 10.0, 5.0}) {  // 0: infinite
    Stepper<2> stepper = cavity(16, 1.0, 1.0, 0.01, c > 0.0 ? 1.0 / (c * c) : 0.0);
    const Outcome outcome = march(stepper, 0.05, 20, "sound speed over lid speed", c);
    EXPECT_TRUE(outcome.converged) << c;
    if (c == 0.0) infinite = outcome.fastest;
    EXPECT_NEAR(outcome.fastest, infinite, c > 50.0 || c == 0.0 ? 1e-3 : 0.1) << c;
  }
}

TEST(ExtremeFluidTest, ReynoldsNumberFromAHundredthToTenMillion) {
  for (const double reynolds : {1e-2, 1.0, 1e2, 1e4, 1e7}) {
    Stepper<2> stepper = cavity(16, 1.0, 1.0, 1.0 / reynolds);
    const Outcome outcome = march(stepper, 0.05, 20, "Reynolds number", reynolds);
    EXPECT_LT(outcome.fastest, k_overshoot) << reynolds;
    EXPECT_TRUE(outcome.converged) << reynolds;
  }
}

/// In the cavity above friction at Re = 1e7 moves nothing in a second. Here vortices turn three times, ten
/// cells across each: energy does not grow, and most of it is left.
TEST(ExtremeFluidTest, VorticesAtTenMillion) {
  Block<2> block = deformed_box<2>(20, 0.0, 0.0, 0.0, {true, true});
  close_with<2>(block, Condition::periodic);
  Equations<2> equations;
  equations.fluid.viscosity = 1e-7;
  Stepper<2> stepper({block}, equations, std::make_unique<MultigridSolver<2>>(), three_orders());
  stepper.initialise(
      [](const std::array<double, 2>& x, double) {
        PointState<2> q;
        q.u = {std::sin(2.0 * M_PI * x[0]) * std::cos(2.0 * M_PI * x[1]) + 0.1 * std::sin(2.0 * M_PI * x[1]),
               -std::cos(2.0 * M_PI * x[0]) * std::sin(2.0 * M_PI * x[1])};
        return q;
      },
      0.0);
  const double before = energy(stepper);
  const Outcome outcome = march(stepper, 0.02, 150, "vortices, Re", 1e7);
  EXPECT_TRUE(outcome.converged);
  EXPECT_LT(energy(stepper), before);
  EXPECT_GT(energy(stepper), 0.3 * before);
}

TEST(ExtremeFluidTest, UnitsFromMillimetresToKilometres) {
  double metre = 0.0;
  for (const double length : {1.0, 1e-3, 1e3}) {  // same Re, same Courant number
    Stepper<2> stepper = cavity(16, length, length, 0.01 * length * length);
    const Outcome outcome = march(stepper, 0.05, 10, "cavity's side [m]", length);
    if (length == 1.0) metre = outcome.fastest;
    EXPECT_NEAR(outcome.fastest / length, metre, 1e-4) << length;
  }
}

TEST(ExtremeStepsTest, AnImpulsiveStartOnThinCellsSurvives) {
  // the lid starts at once; cells beside it 20 times thinner than at the floor
  Stepper<2> stepper = cavity(24, 1.0, 1.0, 1e-4, 0.0, -3.0);
  const Outcome outcome = march(stepper, 0.02, 15, "impulsive start, Re", 1e4);
  EXPECT_TRUE(outcome.converged);
  EXPECT_LT(outcome.fastest, k_overshoot);
  EXPECT_GT(outcome.fastest, 0.3);  // the first row follows the lid
}

TEST(ExtremeStepsTest, ANonsenseStepIsRefused) {
  Stepper<2> stepper = cavity(4, 1.0, 1.0, 0.01);
  for (const double dt : {0.0, -1.0, std::nan(""), HUGE_VAL})
    EXPECT_THROW(stepper.advance(dt), StabilityError);
}

}  // namespace
}  // namespace littoral::fv
