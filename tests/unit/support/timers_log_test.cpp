#include "littoral/support/log.hpp"
#include "littoral/support/timers.hpp"
#include "support_test.hpp"

namespace littoral::support {
namespace {

TEST(TimersTest, ScopesAddToTheirPhase) {
  Timers timers;
  const auto work = timers.declare("work");
  const auto wait = timers.declare("wait");
  const double begin = Timers::now();
  {
    const auto outer = timers.scope(work);
    const auto inner = timers.scope(wait);
    while (Timers::now() - begin < 2e-3) {
    }
  }
  EXPECT_GE(timers.seconds(work), timers.seconds(wait));  // nested: counted in both
  EXPECT_GE(timers.seconds(wait), 1.9e-3);                // the loop above, but for the call before it
  timers.add(work, 10.0);
  EXPECT_GE(timers.seconds(work), 10.0);
}

TEST(TimersTest, TableKeepsTheOrderAndDeclaresOnce) {
  Timers timers;
  timers.declare("b");
  timers.declare("a");
  EXPECT_EQ(timers.declare("b"), 0U);
  const auto table = timers.table();
  ASSERT_EQ(table.size(), 2U);
  EXPECT_EQ(table[0].first + table[1].first, "ba");
}

TEST(LogTest, OnlyRankZeroSpeaksAndTheFileHasEverything) {
  const TemporaryFolder folder;
  ::testing::internal::CaptureStdout();
  {
    Log mute("fv_solver", 1, "");
    mute.info("from rank 1");
    Log log("fv_solver", 0, folder / "fv/log.txt");
    log.info("braces {} are text");
    log.warn("something odd");
  }
  EXPECT_EQ(::testing::internal::GetCapturedStdout(),
            "fv_solver: braces {} are text\nfv_solver: warning: something odd\n");
  EXPECT_CONTAINS(content(folder / "fv/log.txt"), " fv_solver: braces {} are text\n");
  EXPECT_CONTAINS(content(folder / "fv/log.txt"), "warning: something odd");
}

TEST(LogTest, ProgressIsThrottledOnTheConsoleOnly) {
  const TemporaryFolder folder;
  ::testing::internal::CaptureStdout();
  {
    Log log("sph_solver", 0, folder / "log.txt", 1000.0);
    for (int i = 0; i <= 4; ++i) log.progress(0.25 * i, 1.0, "window " + std::to_string(i));
  }
  const std::string console = ::testing::internal::GetCapturedStdout();
  EXPECT_CONTAINS(console, "t 0 of 1 s (0%), ? left  window 0");
  EXPECT_FALSE(contains(console, "window 1"));
  EXPECT_CONTAINS(console, "t 1 of 1 s (100%), 0s left  window 4");  // the last one always
  for (int i = 0; i <= 4; ++i) EXPECT_CONTAINS(content(folder / "log.txt"), "window " + std::to_string(i));
}

TEST(LogTest, UnwritableFile) {
  const TemporaryFolder folder;
  write_text(folder / "file", "x");
  EXPECT_CONTAINS(message_of<IoError>([&] { Log("fv_solver", 1, folder / "file/log.txt"); }),
                  "cannot open the log");
}

TEST(LogTest, FullDiskIsSaidOnceAndTheRunGoesOn) {
  ::testing::internal::CaptureStdout();
  {
    Log log("fv_solver", 0, "/dev/full");
    log.info("first");
    log.info("second");
  }
  const std::string console = ::testing::internal::GetCapturedStdout();
  EXPECT_CONTAINS(console, "cannot write the log");
  EXPECT_CONTAINS(console, "second");
  EXPECT_EQ(console.find("cannot write"), console.rfind("cannot write"));
}

}  // namespace
}  // namespace littoral::support
