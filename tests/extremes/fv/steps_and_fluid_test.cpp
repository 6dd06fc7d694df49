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
  // the lid starts at once; cells 20 times thinner at one corner
  Stepper<2> stepper = cavity(24, 1.0, 1.0, 1e-4, 0.0, 3.0);
  EXPECT_LT(march(stepper, 0.02, 15, "impulsive start, Re", 1e4).fastest, k_overshoot);
}

TEST(ExtremeStepsTest, ANonsenseStepIsRefused) {
  Stepper<2> stepper = cavity(4, 1.0, 1.0, 0.01);
  for (const double dt : {0.0, -1.0, std::nan(""), HUGE_VAL})
    EXPECT_THROW(stepper.advance(dt), StabilityError);
}

}  // namespace
}  // namespace littoral::fv
