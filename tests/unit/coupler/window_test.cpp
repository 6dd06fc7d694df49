#include "littoral/coupler/window.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "littoral/error.hpp"

namespace littoral::coupler {
namespace {

constexpr double k_inf = std::numeric_limits<double>::infinity();

Proposal stable(double dt) {
  Proposal proposal;
  proposal.dt_stable = dt;
  return proposal;
}

WindowPolicy fixed(double dt) {
  WindowPolicy policy;
  policy.dt = dt;
  return policy;
}

WindowPolicy multiple(int substeps) {
  WindowPolicy policy;
  policy.substeps = substeps;
  return policy;
}

TEST(AgreeTest, SmallestNumberOfStableSubsteps) {  // (25)
  const auto a = agree(stable(0.3), stable(k_inf), fixed(1.0), 7, 0.0, 100.0);
  EXPECT_EQ(a.window.index, 7);
  EXPECT_EQ(a.window.substeps, 4);
  EXPECT_DOUBLE_EQ(a.window.t_end, 1.0);
  EXPECT_EQ(agree(stable(0.1), stable(k_inf), fixed(0.3), 0, 0.0, 100.0).window.substeps, 3);
}

TEST(AgreeTest, WindowOfAPrescribedNumberOfSubsteps) {
  const auto a = agree(stable(0.1), stable(k_inf), multiple(5), 0, 2.0, 100.0);
  EXPECT_DOUBLE_EQ(a.window.t_end, 2.5);
  EXPECT_EQ(a.window.substeps, 5);
}

TEST(AgreeTest, GridLimitShortensTheWindow) {
  const auto a = agree(stable(0.1), stable(0.25), multiple(5), 0, 0.0, 100.0);
  EXPECT_DOUBLE_EQ(a.window.t_end, 0.25);
  EXPECT_EQ(a.window.substeps, 3);
}

TEST(AgreeTest, EndsExactlyWithoutSliver) {
  for (const double dt : {0.1, 0.3, 0.07, 0.4999}) {
    double time = 0.0, shortest = k_inf;
    const double end = 1.0;
    int windows = 0;
    for (; windows < 1000; ++windows) {
      const auto a = agree(stable(k_inf), stable(k_inf), fixed(dt), windows, time, end);
      if (a.stop) break;
      EXPECT_LE(a.window.dt(), dt * (1 + 1e-8));
      shortest = std::min(shortest, a.window.dt());
      time = a.window.t_end;
    }
    EXPECT_EQ(time, end);  // to the bit: outputs are due at it
    EXPECT_GT(shortest, 0.5 * dt * (1 - 1e-12));
    EXPECT_EQ(windows, static_cast<int>(std::ceil(end / dt - 1e-9)));
  }
}

TEST(AgreeTest, LastWindowOfRoundOffLengthIsNotTaken) {
  double time = 0.0;  // ten times 0.1 is not 1
  int windows = 0;
  for (;; ++windows) {
    const auto a = agree(stable(0.1), stable(k_inf), multiple(1), windows, time, 1.0);
    if (a.stop) break;
    EXPECT_EQ(a.window.substeps, 1);
    time = a.window.t_end;
  }
  EXPECT_EQ(windows, 10);
}

TEST(AgreeTest, FlagsByEither) {
  Proposal sph = stable(0.1), fv = stable(0.1);
  sph.write = fv.checkpoint = true;
  fv.wants_particles = true;
  sph.region_changed = true;
  const auto a = agree(sph, fv, multiple(1), 0, 0.0, 1.0);
  EXPECT_TRUE(a.write && a.checkpoint && a.wants_particles && a.region_changed && !a.stop);
}

TEST(AgreeTest, StopNeedsNoStepAndTellsWhy) {
  Proposal sph, fv;
  sph.dt_stable = std::nan("");
  fv.stop = true;
  fv.reason = "steady";
  const auto a = agree(sph, fv, multiple(1), 3, 0.5, 1.0);
  EXPECT_TRUE(a.stop);
  EXPECT_EQ(a.reason, "steady");
  EXPECT_EQ(a.window.dt(), 0.0);
  sph.stop = true;
  sph.reason = "asked by the user";
  EXPECT_EQ(agree(sph, fv, multiple(1), 3, 0.5, 1.0).reason, "asked by the user; steady");
}

TEST(AgreeTest, StopsAtTheEnd) {
  EXPECT_TRUE(agree(stable(0.1), stable(0.1), multiple(1), 0, 1.0, 1.0).stop);
}

TEST(AgreeTest, RefusesWhatIsNoWindowAndNamesTheProposals) {
  const auto refused = [](double sph, double fv, const WindowPolicy& policy, double time = 0.0,
                          double end = k_inf) {
    EXPECT_THROW(agree(stable(sph), stable(fv), policy, 0, time, end), CouplingError) << sph << " " << fv;
  };
  refused(0.0, 1.0, multiple(1));
  refused(-1.0, 1.0, multiple(1));
  refused(std::nan(""), 1.0, fixed(0.1));
  refused(1.0, std::nan(""), fixed(0.1));
  refused(k_inf, k_inf, multiple(1));
  refused(0.1, 0.1, fixed(0.0));
  refused(0.1, 0.1, multiple(0));
  refused(1e-20, k_inf, fixed(1.0));             // a million substeps and more
  refused(1e-20, k_inf, multiple(1), 1.0, 1e9);  // t + dt == t
  try {
    agree(stable(-2.0), stable(0.5), fixed(0.1), 12, 0.0, 1.0);
  } catch (const CouplingError& error) {
    const std::string text = error.what();
    for (const char* part : {"window 12", "sph proposed dt = -2", "fv dt = 0.5"})
      EXPECT_NE(text.find(part), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace littoral::coupler
