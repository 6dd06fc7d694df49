#include "littoral/support/due.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace littoral::support {
namespace {

std::vector<double> times(double window, double interval, double end) {
  std::vector<double> written;
  double last = 0.0;
  for (int n = 1; n * window < end; ++n)
    if (due(last, n * window, interval)) written.push_back(last = n * window);
  return written;
}

TEST(DueTest, TimesStayWithTheMultiplesOfTheInterval) {
  const auto written = times(0.3, 1.0, 10.0);
  ASSERT_EQ(written.size(), 9u);  // counted from the last one they would drift: 1.2, 2.4, 3.6, ...
  double multiple = 1.0;
  for (const double time : written) {
    EXPECT_GE(time, multiple - 1e-6);
    EXPECT_LT(time, multiple + 0.3 - 1e-6);
    multiple += 1.0;
  }
}

TEST(DueTest, RoundOffDoesNotDelayAMultiple) { EXPECT_EQ(times(0.1, 0.3, 3.05).size(), 10u); }

TEST(DueTest, AWindowThatEndedEarlyIsNotFollowedByAnother) {
  EXPECT_FALSE(due(0.97, 1.05, 1.0));  // written at .97 in place of 1
  EXPECT_TRUE(due(0.97, 2.0, 1.0));
}

TEST(DueTest, NoIntervalNothingDue) { EXPECT_FALSE(due(0.0, 100.0, 0.0)); }

TEST(DueTest, AGivenWindowIsExpectedByBothPrograms) {
  Scene scene;
  EXPECT_EQ(expected_end(scene, 1.0, 0.25), 1.25);
  scene.coupling.window.dt = 0.5;
  EXPECT_EQ(expected_end(scene, 1.0, 0.25), 1.25);  // alone it means nothing
  scene.coupling.kind = Scene::CouplingKind::imposed;
  EXPECT_EQ(expected_end(scene, 1.0, 0.25), 1.5);
}

}  // namespace
}  // namespace littoral::support
