#include <regex>

#include "littoral/support/checkpoint.hpp"
#include "littoral/support/series.hpp"
#include "support_test.hpp"

namespace littoral::support {
namespace {

/// Empty if every element is closed in order and no stray markup remains; else what is wrong.
std::string xml_problem(const std::string& text) {
  std::vector<std::string> open;
  const std::regex tag(R"(<(/?)([A-Za-z]\w*)((?:\s+\w+="[^"<]*")*)\s*(/?)>)");
  std::string rest;
  std::size_t end = 0;
  for (std::sregex_iterator it(text.begin(), text.end(), tag), last; it != last; ++it) {
    rest += text.substr(end, static_cast<std::size_t>(it->position()) - end);
    end = static_cast<std::size_t>(it->position() + it->length());
    const std::string name = (*it)[2];
    if ((*it)[1].length() > 0) {
      if (open.empty() || open.back() != name) return "closes " + name;
      open.pop_back();
    } else if ((*it)[4].length() == 0) {
      open.push_back(name);
    }
  }
  rest += text.substr(end);
  rest = std::regex_replace(rest, std::regex(R"(^<\?xml version="1\.0"\?>)"), "");
  if (rest.find_first_of("<>") != std::string::npos) return "stray markup";
  return open.empty() ? "" : "leaves " + open.back() + " open";
}

struct Item {
  std::size_t size = 1;
  std::string file, dataset;
};

std::vector<Item> data_items(const std::string& xdmf) {
  std::vector<Item> items;
  const std::regex pattern(R"re(Dimensions="([0-9 ]+)">([^<:]+):/([^<]+)</DataItem>)re");
  for (std::sregex_iterator it(xdmf.begin(), xdmf.end(), pattern), last; it != last; ++it) {
    Item item{1, (*it)[2], (*it)[3]};
    std::istringstream extents((*it)[1]);
    for (std::size_t extent; extents >> extent;) item.size *= extent;
    items.push_back(item);
  }
  return items;
}

std::vector<double> times(const std::string& xdmf) {
  std::vector<double> out;
  const std::regex pattern("<Time Value=\"([^\"]+)\"");
  for (std::sregex_iterator it(xdmf.begin(), xdmf.end(), pattern), last; it != last; ++it)
    out.push_back(std::stod((*it)[1]));
  return out;
}

void expect_consistent(const TemporaryFolder& folder, const std::string& name, std::size_t n_items) {
  const std::string xdmf = content(folder / (name + ".xdmf"));
  EXPECT_EQ(xml_problem(xdmf), "") << xdmf;
  const auto items = data_items(xdmf);
  EXPECT_EQ(items.size(), n_items);
  for (const auto& item : items)
    EXPECT_TRUE(CheckpointReader(folder / item.file).has(item.dataset)) << item.dataset;
}

FieldSeries::Block block(const std::string& name, std::array<int, 3> cells) {
  FieldSeries::Block b{name, cells, {}, {}};
  for (int k = 0; k <= cells[2]; ++k)
    for (int j = 0; j <= cells[1]; ++j)
      for (int i = 0; i <= cells[0]; ++i) b.nodes.insert(b.nodes.end(), {1.0 * i, 1.0 * j, 1.0 * k});
  const auto n = static_cast<std::size_t>(cells[0] * cells[1] * cells[2]);
  b.cell_fields.push_back({"p", 1, std::vector<double>(n, 2.0)});
  b.cell_fields.push_back({"u", 3, std::vector<double>(3 * n, 3.0)});
  return b;
}

TEST(FieldSeriesTest, PointsAreReadableAfterEveryStep) {
  const TemporaryFolder folder;
  FieldSeries series(folder / "", "particles", false, 0.0);
  expect_consistent(folder, "particles", 0);
  series.write_points(0.0, {0, 0, 0, 1, 2, 3}, {{"p", 1, {1.5, 2.5}}, {"u", 3, {1, 2, 3, 4, 5, 6}}});
  expect_consistent(folder, "particles", 3);
  series.write_points(0.1, {0, 0, 0}, {{"p", 1, {7.5}}});
  expect_consistent(folder, "particles", 5);
  series.write_points(0.2, {}, {{"p", 1, {}}});  // all particles gone
  expect_consistent(folder, "particles", 7);
  EXPECT_EQ(times(content(folder / "particles.xdmf")), (std::vector<double>{0.0, 0.1, 0.2}));
  EXPECT_EQ(CheckpointReader(folder / "particles_000001.h5").doubles("p"), std::vector<double>{7.5});
}

TEST(FieldSeriesTest, BlocksKeepTheirShape) {
  const TemporaryFolder folder;
  FieldSeries series(folder / "", "grid", false, 0.0);
  series.write_blocks(0.5, {block("bed", {4, 1, 3}), block("ring", {2, 2, 2})});
  expect_consistent(folder, "grid", 6);
  const std::string xdmf = content(folder / "grid.xdmf");
  EXPECT_CONTAINS(xdmf, "<Topology TopologyType=\"3DSMesh\" Dimensions=\"4 2 5\"/>");
  EXPECT_EQ(data_items(xdmf)[0].size, 4U * 2 * 5 * 3);
  EXPECT_EQ(data_items(xdmf)[1].size, 4U * 3);
  EXPECT_EQ(data_items(xdmf)[1].dataset, "bed/p");
}

TEST(FieldSeriesTest, RestartCutsLaterStepsAndGoesOn) {
  const TemporaryFolder folder;
  {
    FieldSeries series(folder / "", "f", false, 0.0);
    for (const double t : {0.0, 0.1, 0.2, 0.3}) series.write_points(t, {0, 0, 0}, {{"p", 1, {t}}});
  }
  FieldSeries series(folder / "", "f", true, 0.1);
  EXPECT_FALSE(std::filesystem::exists(folder / "f_000003.h5"));
  series.write_points(0.15, {0, 0, 0}, {{"p", 1, {9}}});
  expect_consistent(folder, "f", 6);
  EXPECT_EQ(times(content(folder / "f.xdmf")), (std::vector<double>{0.0, 0.1, 0.15}));
  EXPECT_EQ(CheckpointReader(folder / "f_000002.h5").doubles("p"), std::vector<double>{9});
  FieldSeries fresh(folder / "", "none", true, 0.1);  // nothing there to continue
  expect_consistent(folder, "none", 0);
}

TEST(FieldSeriesTest, NamesAreEscaped) {
  const TemporaryFolder folder;
  FieldSeries series(folder / "", "a&b", false, 0.0);
  series.write_points(0.0, {0, 0, 0}, {{"d<p>\"", 1, {1}}});
  EXPECT_EQ(xml_problem(content(folder / "a&b.xdmf")), "");
}

TEST(FieldSeriesTest, WrongSizesAreNamed) {
  const TemporaryFolder folder;
  FieldSeries series(folder / "", "f", false, 0.0);
  EXPECT_CONTAINS(message_of<IoError>([&] {
                    series.write_points(0, {0, 0, 0}, {{"p", 1, {1, 2}}});
                  }),
                  "field 'p' has 2 values; expected 1.");
  EXPECT_CONTAINS(message_of<IoError>([&] {
                    series.write_points(0, {0, 0}, {});
                  }),
                  "xyz has 2 values; expected 0.");
  auto bad = block("b", {2, 1, 2});
  bad.nodes.pop_back();
  EXPECT_CONTAINS(message_of<IoError>([&] { series.write_blocks(0, {bad}); }),
                  "nodes of block 'b' has 53 values; expected 54.");
  expect_consistent(folder, "f", 0);
}

TEST(FieldSeriesTest, DiskFullKeepsWhatWasThere) {
  const TemporaryFolder folder;
  FieldSeries series(folder / "", "f", false, 0.0);
  series.write_points(0.0, {0, 0, 0}, {});
  const std::string before = content(folder / "f.xdmf");
  std::filesystem::create_symlink("/dev/full", folder / "f_000001.h5.part");
  EXPECT_CONTAINS(message_of<IoError>([&] {
                    series.write_points(0.1, {0, 0, 0}, {});
                  }),
                  "f_000001.h5.part: cannot write: No space left on device.");
  EXPECT_EQ(content(folder / "f.xdmf"), before);
  series.write_points(0.1, {0, 0, 0}, {});  // space again: the same step, complete
  expect_consistent(folder, "f", 2);
}

TEST(FieldSeriesTest, UnwritableFolder) {
  const TemporaryFolder folder;
  write_text(folder / "file", "x");
  EXPECT_CONTAINS(message_of<IoError>([&] { FieldSeries(folder / "file/sub", "f", false, 0.0); }),
                  "cannot make the folder");
}

}  // namespace
}  // namespace littoral::support
