// Free surfaces where they hardly fit the grid: in a corner, in less than a cell, at its ends, too steep, too
// fast.
#include <gtest/gtest.h>

#include "free_surface/free_surface.hpp"
#include "grid/space.hpp"
#include "level_set/volume.hpp"
#include "littoral/error.hpp"
#include "runs.hpp"

namespace littoral::fv {
namespace {

constexpr double k_g = 9.81, k_rho = 1000.0;
using Surface = std::function<double(const std::array<double, 2>&)>;

enum class Start { hydrostatic, without_pressure };

/// A tank of length and height 1 (of `aspect` at equal cells in x), water at rest under p = 0 at the level 0
/// of `surface`; gravity turned by `degrees`; `top`: of its upper side; `roll` [m/s]: about the tank's
/// middle.
Stepper<2> tank(int n, const Surface& surface, double degrees = 0.0, double aspect = 1.0,
                Start start = Start::hydrostatic, Condition top = Condition::slip, double roll = 0.0) {
  Block<2> block = make_block<2>("tank", {n, n}, {}, [=](const std::array<int, 2>& i) {
    return std::array<double, 2>{aspect * i[0] / n, static_cast<double>(i[1]) / n};
  });
  close_with<2>(block, Condition::slip);
  set_face<2>(block, 1, 1, top);
  if (top == Condition::outflow)
    for (Window<2>& w : block.windows)
      if (w.condition == top) w.pressure = constant(0.0);
  const double angle = degrees * M_PI / 180.0;
  Equations<2> equations;
  equations.fluid.density = k_rho;
  equations.fluid.gravity = {-k_g * std::sin(angle), -k_g * std::cos(angle)};
  InnerTolerance tolerance = three_orders();
  tolerance.floor = 1e-9;
  Stepper<2> stepper({block}, equations, std::make_unique<MultigridSolver<2>>(), tolerance);
  stepper.initialise(
      [&](const std::array<double, 2>& x, double) {
        const double a = M_PI * x[0] / aspect, b = M_PI * x[1];
        return PointState<2>{start == Start::hydrostatic ? -k_rho * k_g * surface(x) : 0.0,
                             {roll * std::sin(a) * std::cos(b), -roll * std::cos(a) * std::sin(b)}};
      },
      0.0);
  stepper.set_surface([&](const std::array<double, 3>& x, double) { return surface({x[0], x[2]}); });
  return stepper;
}

double volume(const Stepper<2>& stepper) { return water_volume(stepper.blocks(), stepper.surface()->phi()); }

/// Steps until the end, or an error that says why not.
struct Fate {
  bool refused = false;  // given up with an error: the state is nobody's then
  std::string told;
  double volume = 0.0, fastest = 0.0;
};
Fate fate(Stepper<2>& stepper, double dt, int steps, const char* what, double value) {
  Fate fate;
  const double before = volume(stepper);
  try {
    fate.fastest = march(stepper, dt, steps, what, value).fastest;
  } catch (const StabilityError& told) {
    fate.refused = true;
    fate.told = told.what();
    std::printf("%-34s %10.3g   refused: %.100s\n", what, value, told.what());
  }
  fate.volume = stepper.surface()->budget().error / before;  // less what passed an opening
  EXPECT_TRUE(fate.refused || (std::isfinite(fate.fastest) && std::isfinite(fate.volume))) << what;
  std::printf("%-34s %10.3g   volume %+.2e\n", what, value, fate.volume);
  return fate;
}

TEST(ExtremeSurfaceTest, WaterAtRestInACorner) {
  for (const double across : {0.9, 0.31, 0.12}) {  // of the tank, along each wall
    Stepper<2> stepper = tank(
        12, [=](const std::array<double, 2>& x) { return (x[0] + x[1] - across) / std::sqrt(2.0); }, 45.0);
    const Fate is = fate(stepper, 0.01, 20, "corner, part of a side", across);
    EXPECT_FALSE(is.refused);
    EXPECT_LT(is.fastest, 1e-6) << across;
    EXPECT_NEAR(is.volume, 0.0, 1e-6) << across;
  }
}

TEST(ExtremeSurfaceTest, FilmsOnTheBottom) {
  const int n = 12;
  for (const double cells : {1.51, 1.0, 0.7, 0.5, 0.3}) {  // at .5 the surface lies in the first centres
    Stepper<2> stepper = tank(n, [=](const std::array<double, 2>& x) { return x[1] - cells / n; });
    const Fate is = fate(stepper, 0.005, 20, "film, cells deep", cells);
    EXPECT_FALSE(is.refused);
    EXPECT_LT(is.fastest, 1e-6) << cells;
    EXPECT_NEAR(is.volume, 0.0, 1e-6) << cells;
  }
}

TEST(ExtremeSurfaceTest, FilledToTheTop) {
  const int n = 12;
  for (const Start start : {Start::hydrostatic, Start::without_pressure})
    for (const double cells : {1.2, 0.5, 0.2, 0.0}) {  // of air
      Stepper<2> stepper = tank(
          n, [=](const std::array<double, 2>& x) { return x[1] - 1.0 + cells / n; }, 0.0, 1.0, start);
      const Fate is =
          fate(stepper, 0.005, 20,
               start == Start::hydrostatic ? "air under the lid, cells" : "the same from p = 0", cells);
      EXPECT_FALSE(is.refused) << cells;
      EXPECT_LT(is.fastest, 1e-6) << cells;
      EXPECT_NEAR(is.volume, 0.0, 1e-6) << cells;
    }
}

/// The scene's p may be anything in incompressible flow; what comes of it must not.
TEST(ExtremeSurfaceTest, AtRestWithoutAPressureAtTheStart) {
  for (const double degrees : {0.0, 7.0}) {
    const double tilt = std::tan(degrees * M_PI / 180.0);
    Stepper<2> stepper = tank(
        12,
        [=](const std::array<double, 2>& x) {
          return (x[1] - 0.52 + tilt * (x[0] - 0.5)) * std::cos(degrees * M_PI / 180.0);
        },
        degrees, 1.0, Start::without_pressure);
    const Fate is = fate(stepper, 0.01, 20, "rest from p = 0, degrees", degrees);
    EXPECT_LT(is.fastest, 1e-6);
    EXPECT_NEAR(is.volume, 0.0, 1e-6);
  }
}

TEST(ExtremeSurfaceTest, TenThousandStepsAtRest) {
  constexpr double degrees = 7.0, angle = degrees * M_PI / 180.0;
  Stepper<2> stepper = tank(
      6,
      [=](const std::array<double, 2>& x) {
        return (x[1] - 0.53) * std::cos(angle) + (x[0] - 0.5) * std::sin(angle);
      },
      degrees);
  const Fate is = fate(stepper, 0.01, 10000, "steps at rest", 10000);
  EXPECT_LT(is.fastest, 1e-8);
  EXPECT_NEAR(is.volume, 0.0, 1e-5);
}

/// From rest that is exact nothing is ever corrected: a roll has to die down, and not to come back.
TEST(ExtremeSurfaceTest, ASmallRollDies) {
  constexpr double degrees = 7.0, angle = degrees * M_PI / 180.0, roll = 1e-2;
  Stepper<2> stepper = tank(
      6,
      [=](const std::array<double, 2>& x) {
        return (x[1] - 0.53) * std::cos(angle) + (x[0] - 0.5) * std::sin(angle);
      },
      degrees, 1.0, Start::hydrostatic, Condition::slip, roll);
  const Fate early = fate(stepper, 0.05, 40, "roll of .01 m/s, steps", 40);
  const Fate late = fate(stepper, 0.05, 160, "roll of .01 m/s, steps", 200);
  EXPECT_LT(early.fastest, roll);
  EXPECT_LT(late.fastest, 0.9 * early.fastest);
  EXPECT_NEAR(late.volume, 0.0, 5e-3);
}

/// A wave whose crest passes an open top: what leaves is accounted for.
TEST(ExtremeSurfaceTest, SurfaceThatLeavesTheGrid) {
  for (const Condition top : {Condition::outflow, Condition::slip}) {
    Stepper<2> stepper = tank(
        16, [](const std::array<double, 2>& x) { return x[1] - 0.85 - 0.12 * std::cos(2.0 * M_PI * x[0]); },
        0.0, 1.0, Start::hydrostatic, top);
    const Fate is =
        fate(stepper, 0.008, 100, top == Condition::slip ? "crest at a lid" : "crest out of the top", 0.12);
    EXPECT_FALSE(is.refused);
    EXPECT_NEAR(is.volume, 0.0, top == Condition::slip ? 5e-3 : 5e-4);
  }
}

TEST(ExtremeSurfaceTest, SloshingAgainstTheLidAndDownToTheBottom) {
  for (const double tilt : {0.4, 0.8}) {
    Stepper<2> stepper =
        tank(16, [=](const std::array<double, 2>& x) { return x[1] - 0.5 - tilt * (x[0] - 0.5); });
    const Fate is = fate(stepper, 0.005, 120, "sloshing, tilt at start", tilt);
    EXPECT_FALSE(is.refused) << tilt;
    EXPECT_NEAR(is.volume, 0.0, tilt < 0.5 ? 2e-3 : 3e-2) << tilt;
  }
}

TEST(ExtremeSurfaceTest, SteepnessUpToBreaking) {
  for (const double ka : {0.1, 0.3, 0.6, 1.0}) {
    Stepper<2> stepper = tank(16, [=](const std::array<double, 2>& x) {
      return x[1] - 0.5 - ka / (2.0 * M_PI) * std::cos(2.0 * M_PI * x[0]);
    });
    const Fate is = fate(stepper, 0.008, 100, "standing wave, ka", ka);
    EXPECT_FALSE(is.refused) << ka;
    EXPECT_NEAR(is.volume, 0.0, ka < 0.5 ? 5e-4 : 5e-3) << ka;
  }
}

TEST(ExtremeSurfaceTest, SurfaceCourantNumberOneAndFive) {
  for (const double cfl : {1.0, 5.0}) {
    Stepper<2> stepper = tank(
        24, [=](const std::array<double, 2>& x) { return x[1] - 0.5 - 0.1 * std::cos(2.0 * M_PI * x[0]); });
    // the surface moves with about a omega
    const double speed = 0.1 * std::sqrt(k_g * 2.0 * M_PI);
    const Fate is = fate(stepper, cfl / 24.0 / speed, 12, "surface CFL", cfl);
    if (cfl > 1.0) {
      EXPECT_NE(is.told.find("surface Courant numbers"), std::string::npos) << is.told;
    } else {
      EXPECT_FALSE(is.refused);
      EXPECT_NEAR(is.volume, 0.0, 1e-2);
    }
  }
}

/// A long wave in shallow water, a (0.1 H) high, half a period on: linear theory but for a part of a/H.
TEST(ExtremeSurfaceTest, CellsAHundredTimesAsLongAsHigh) {
  constexpr double depth = 0.52, a = 0.05, k = 2.0 * M_PI / 100.0, dt = 0.5;
  constexpr int n = 16;
  Stepper<2> stepper = tank(
      n, [=](const std::array<double, 2>& x) { return x[1] - depth - a * std::cos(k * x[0]); }, 0.0, 100.0);
  const double period = 2.0 * M_PI / std::sqrt(k_g * k * std::tanh(k * depth));
  const Fate is = fate(stepper, dt, static_cast<int>(std::lround(0.5 * period / dt)), "aspect ratio", 100.0);
  EXPECT_FALSE(is.refused);
  EXPECT_NEAR(is.volume, 0.0, 1e-3);
  const Block<2>& block = stepper.blocks()[0];
  const auto c =
      static_cast<std::size_t>(block.extent.at({n / 2, n / 2}));  // phi there: height over the surface
  const double elevation = block.centre[1][c] - stepper.surface()->phi()[0][c] - depth;
  std::printf("elevation less linear theory, of a: %+.3f\n",
              (elevation - a * std::cos(k * block.centre[0][c] + M_PI)) / a);
  EXPECT_NEAR(elevation, a * std::cos(k * block.centre[0][c] + M_PI), 0.15 * a);
}

}  // namespace
}  // namespace littoral::fv
