#include <algorithm>
#include <sstream>

#include "littoral/support/checkpoint.hpp"
#include "littoral/support/series.hpp"
#include "support_test.hpp"

namespace littoral::support {
namespace {

/// The text between two marks, from `at` on, which moves behind it; empty if there is none.
std::string between(const std::string& text, const std::string& left, const std::string& right,
                    std::size_t& at) {
  const std::size_t begin = text.find(left, at);
  const std::size_t end = begin == std::string::npos ? begin : text.find(right, begin + left.size());
  if (end == std::string::npos) {
    at = end;
    return "";
  }
  at = end + right.size();
  return text.substr(begin + left.size(), end - begin - left.size());
}

/// Empty if every element is closed in order and nothing but text lies between; else what is wrong.
std::string xml_problem(const std::string& text) {
  std::vector<std::string> open;
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t begin = text.find('<', at);
    if (text.substr(at, begin == std::string::npos ? begin : begin - at).find('>') != std::string::npos)
      return "stray >";
    if (begin == std::string::npos) break;
    const std::string tag = between(text, "<", ">", at);
    if (tag.empty() || tag.find('<') != std::string::npos) return "stray <";
    if (std::count(tag.begin(), tag.end(), '"') % 2 != 0) return "open quote in " + tag;
    const std::string name = tag.substr(0, tag.find(' '));
    if (name[0] == '?' || tag.back() == '/') continue;
    if (name[0] != '/') {
      open.push_back(name);
    } else {
      if (open.empty() || "/" + open.back() != name) return "closes " + name;
      open.pop_back();
    }
  }
  return open.empty() ? "" : "leaves " + open.back() + " open";
}

struct Item {
  std::size_t size = 1;
  std::string file, dataset;
};

std::vector<Item> data_items(const std::string& xdmf) {
  std::vector<Item> items;
  for (std::size_t at = 0; at < xdmf.size();) {
    const std::string text = between(xdmf, "<DataItem ", "</DataItem>", at);
    if (text.empty()) break;
    Item item;
    std::size_t inside = 0;
    std::istringstream extents(between(text, "Dimensions=\"", "\">", inside));
    for (std::size_t extent = 0; extents >> extent;) item.size *= extent;
    const std::size_t colon = text.find(":/", inside);
    item.file = text.substr(inside, colon - inside);
    item.dataset = text.substr(colon + 2);
    items.push_back(item);
  }
  return items;
}

std::vector<double> times(const std::string& xdmf) {
  std::vector<double> out;
  for (std::size_t at = 0; at < xdmf.size();) {
    const std::string time = between(xdmf, "<Time Value=\"", "\"", at);
    if (!time.empty()) out.push_back(std::stod(time));
  }
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

TEST(FieldSeriesTest, TheXmlCheckSeesFaults) {
  EXPECT_EQ(xml_problem("<a x=\"1\"><b/></a>"), "");
  for (const char* bad :
       {"<a>", "</a>", "<a></b>", "<a><b></a></b>", "<a x=\"1></a>", "<a> > </a>", "<a> < </a>"})
    EXPECT_NE(xml_problem(bad), "") << bad;
}

TEST(FieldSeriesTest, PointsAreReadableAfterEveryStep) {
  const TemporaryFolder folder;
  FieldSeries series(folder / "", "particles", false, 0.0);
  expect_consistent(folder, "particles", 0);
  series.write_points(0.0, {0, 0, 0, 1, 2, 3}, {{"p", 1, {1.5, 2.5}}, {"u", 3, {1, 2, 3, 4, 5, 6}}});
  expect_consistent(folder, "particles", 4);
  series.write_points(0.1, {0, 0, 0}, {{"p", 1, {7.5}}});
  expect_consistent(folder, "particles", 7);
  series.write_points(0.2, {}, {{"p", 1, {}}});  // all particles gone
  expect_consistent(folder, "particles", 10);
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
  expect_consistent(folder, "f", 9);
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
  EXPECT_CONTAINS(content(folder / "a&b.xdmf"), "Name=\"d&lt;p&gt;&quot;\"");
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
  expect_consistent(folder, "f", 4);
}

TEST(FieldSeriesTest, UnwritableFolder) {
  const TemporaryFolder folder;
  write_text(folder / "file", "x");
  EXPECT_CONTAINS(message_of<IoError>([&] { FieldSeries(folder / "file/sub", "f", false, 0.0); }),
                  "cannot make the folder");
}

}  // namespace
}  // namespace littoral::support
