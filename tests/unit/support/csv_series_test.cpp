#include <cmath>
#include <limits>

#include "littoral/support/series.hpp"
#include "support_test.hpp"

namespace littoral::support {
namespace {

TEST(CsvSeriesTest, HeaderUnitsAndFullPrecision) {
  const TemporaryFolder folder;
  const std::string path = folder / "sub/scalars.csv";
  CsvSeries series(path, {"time", "mass"}, "s, kg");
  series.row({0.1, 1.0 / 3.0});
  // readable before the series is closed: a run may die at any time
  EXPECT_EQ(content(path), "time,mass\n# s, kg\n0.10000000000000001,0.33333333333333331\n");
}

TEST(CsvSeriesTest, AppendAfterCutsLaterAndTornRows) {
  const TemporaryFolder folder;
  const std::string path = folder / "a.csv";
  {
    CsvSeries series(path, {"time", "a"}, "s, 1");
    for (const double t : {0.1, 0.2, 0.3, 0.4}) series.row({t, 10 * t});
  }
  std::ofstream(path, std::ios::app) << "0.05,7";  // cut off in the middle of a number
  {
    CsvSeries series = CsvSeries::append_after(path, {"time", "a"}, 0.2);
    series.row({0.25, 1});
  }
  EXPECT_EQ(content(path), "time,a\n# s, 1\n0.10000000000000001,1\n0.20000000000000001,2\n0.25,1\n");
  EXPECT_FALSE(std::filesystem::exists(path + ".part"));
}

TEST(CsvSeriesTest, AppendAfterBeginsAMissingFile) {
  const TemporaryFolder folder;
  CsvSeries::append_after(folder / "a.csv", {"time"}, 1.0).row({2});
  EXPECT_EQ(content(folder / "a.csv"), "time\n2\n");
}

TEST(CsvSeriesTest, AppendAfterRefusesOtherColumns) {
  const TemporaryFolder folder;
  const std::string path = folder / "a.csv";
  CsvSeries(path, {"time", "a"}).row({0, 1});
  const std::string before = content(path);
  EXPECT_CONTAINS(message_of<IoError>([&] {
                    CsvSeries::append_after(path, {"time", "b"}, 1.0);
                  }),
                  "its columns are 'time,a', those of this run are 'time,b'");
  EXPECT_EQ(content(path), before);
}

TEST(CsvSeriesTest, WrongCountOfValues) {
  const TemporaryFolder folder;
  CsvSeries series(folder / "a.csv", {"time", "a"});
  EXPECT_CONTAINS(message_of<IoError>([&] { series.row({1}); }), "a row of 1 values for 2 columns");
}

TEST(CsvSeriesTest, SpecialValuesAreWritten) {
  const TemporaryFolder folder;
  CsvSeries(folder / "a.csv", {"time", "a"}).row({0, std::numeric_limits<double>::quiet_NaN()});
  EXPECT_CONTAINS(content(folder / "a.csv"), "0,nan\n");
}

TEST(CsvSeriesTest, DiskFull) {
  EXPECT_EQ(message_of<IoError>([] { CsvSeries("/dev/full", {"time"}); }),
            "/dev/full: cannot write: No space left on device.");
}

TEST(CsvSeriesTest, ADeletedFolderIsAnError) {
  const TemporaryFolder folder;
  CsvSeries series(folder / "out/a.csv", {"time"});
  series.row({1});
  std::filesystem::remove_all(folder / "out");
  EXPECT_CONTAINS(message_of<IoError>([&] { series.row({2}); }), "out/a.csv: was deleted while this run");
}

TEST(CsvSeriesTest, UnwritablePath) {
  const TemporaryFolder folder;
  write_text(folder / "file", "x");
  EXPECT_CONTAINS(message_of<IoError>([&] { CsvSeries(folder / "file/a.csv", {"time"}); }),
                  "cannot make the folder");
  std::filesystem::create_directories(folder / "a.csv");
  EXPECT_CONTAINS(message_of<IoError>([&] { CsvSeries(folder / "a.csv", {"time"}); }),
                  "cannot open for writing: Is a directory.");
}

}  // namespace
}  // namespace littoral::support
