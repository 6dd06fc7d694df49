#include "littoral/support/summary.hpp"

#include <limits>

#include "support_test.hpp"

namespace littoral::support {
namespace {

TEST(SummaryTest, IsJson) {
  const TemporaryFolder folder;
  Summary s;
  s.program = "fv_solver";
  s.version = "0.1.0";
  s.ranks = 2;
  s.threads = 1;
  s.wall_time = 1.5;
  s.phases = {{"work", 1.0}, {"wait", 0.25}};
  s.results = {{"mass", 0.1}, {"residual", std::numeric_limits<double>::quiet_NaN()}};
  s.notes = {{"scene", "a \"wave\"\n\x01"}};
  s.write(folder / "fv/summary.json");
  EXPECT_EQ(content(folder / "fv/summary.json"), R"json({
  "program": "fv_solver",
  "version": "0.1.0",
  "ranks": 2,
  "threads": 1,
  "wall_time": 1.5,
  "phases": {
    "work": 1,
    "wait": 0.25
  },
  "results": {
    "mass": 0.1,
    "residual": null
  },
  "notes": {
    "scene": "a \"wave\"\n\u0001"
  },
  "warnings": []
}
)json");
}

TEST(SummaryTest, UnwritablePath) {
  EXPECT_CONTAINS(message_of<IoError>([] { Summary{}.write("/dev/null/summary.json"); }), "/dev/null");
}

}  // namespace
}  // namespace littoral::support
