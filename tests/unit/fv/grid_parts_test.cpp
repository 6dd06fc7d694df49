#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "boundary/ghosts.hpp"
#include "grid/find_joins.hpp"
#include "grid/grid_file.hpp"
#include "grid/plate.hpp"
#include "grid/quality.hpp"
#include "grid/ring.hpp"
#include "littoral/error.hpp"
#include "split_grids.hpp"

// Grids of several blocks from their descriptions: they join up, fill their room and come back from a file.
namespace littoral::fv {
namespace {

FaceConfig closed(Condition condition) {
  FaceConfig face;
  face.condition = static_cast<int>(condition);
  return face;
}

PlateConfig plate_of(double thickness, bool finite) {
  PlateConfig p;
  p.chord = 1.0;
  p.thickness = thickness;
  p.angle = 20.0;
  p.reach = {1.0, 2.0, 1.5, 0.5};
  p.cells = {6, 8, 8, 6};
  p.along = 10;
  p.through = 2;
  p.first_cell = 0.02;
  p.edge_cell = 0.05;
  for (auto& face : p.faces) face = closed(Condition::far_field);
  p.span.lower = -1.0;
  p.span.upper = 1.0;
  p.span.cells = 8;
  for (auto& face : p.span.faces) face = closed(Condition::slip);
  if (finite) p.width = 0.8;
  p.side_cells = 4;
  return p;
}

template <int D>
void check_plate(const PlateConfig& config, std::size_t n_blocks, double volume, double wall) {
  std::vector<Block<D>> blocks = build_plate<D>(config, support::Scene(), {});
  find_joins(blocks);
  ASSERT_EQ(blocks.size(), n_blocks);
  double filled = 0.0, measure = 0.0;
  for (const Block<D>& block : blocks) {
    check_windows(block);
    for_each_index<D>({}, block.extent.n, [&](const std::array<int, D>& i) {
      filled += block.volume[static_cast<std::size_t>(block.extent.at(i))];
    });
    for (const Window<D>& w : block.windows) {
      if (w.name != "plate") continue;
      EXPECT_EQ(w.condition, Condition::wall);
      const auto n = static_cast<std::size_t>(w.direction);
      std::array<int, D> lower = w.lower, upper = w.upper;
      lower[n] = w.side == 0 ? 0 : block.extent.n[n];
      upper[n] = lower[n] + 1;
      for_each_index<D>(lower, upper, [&](const std::array<int, D>& i) {
        double s2 = 0.0;
        for (std::size_t k = 0; k < D; ++k) {
          const double a = block.area[n][k][static_cast<std::size_t>(block.extent.at(i))];
          s2 += a * a;
        }
        measure += std::sqrt(s2);
      });
    }
  }
  EXPECT_NEAR(filled, volume, 1e-12);
  EXPECT_NEAR(measure, wall, 1e-12);
}

TEST(PlateTest, BlocksFillTheRoomAroundIt) {
  check_plate<2>(plate_of(0.0, false), 2, 4.0 * 2.0, 2.0);
  check_plate<2>(plate_of(0.1, false), 4, 4.0 * 2.1 - 0.1, 2.2);
  check_plate<3>(plate_of(0.0, true), 2, 4.0 * 2.0 * 2.0, 2.0 * 0.8);
  check_plate<3>(plate_of(0.1, false), 4, 2.0 * (4.0 * 2.1 - 0.1), 2.0 * 2.2);
  check_plate<3>(plate_of(0.1, true), 6, 4.0 * 2.1 * 2.0 - 0.08, 2.0 * 0.8 + 0.2 * 0.8 + 0.2);
}

std::string temporary(const std::string& name) {
  return (std::filesystem::temp_directory_path() / ("littoral_grid_" + std::to_string(::getpid()) + name))
      .string();
}

/// Turned blocks written and read join as before; a mirrored block is turned right.
template <int D>
void round_trip(const std::string& ending) {
  const auto close = [](int, int) {
    Window<D> w;
    w.condition = Condition::wall;
    return w;
  };
  const std::array<std::vector<int>, 3> cuts = {std::vector<int>{4, 3}, {3, 2}, {2, 4}};
  std::array<std::vector<int>, D> parts;
  for (std::size_t d = 0; d < D; ++d) parts[d] = cuts[d];
  const auto s = split_grid<D>(parts, {}, skewed<D>, close, 3);
  GridFileConfig config;
  config.file = temporary(ending);
  write_grid<D>(config.file, s.parts);
  const auto add = [&](std::size_t b, int face) {
    GridFileConfig::Face f;
    f.block = static_cast<int>(b) + 1;
    f.face = face;
    f.condition = closed(Condition::wall);
    config.faces.push_back(f);
  };
  for (std::size_t b = 0; b < s.parts.size(); ++b)
    for (const Window<D>& w : s.parts[b].windows)
      if (w.condition == Condition::wall) add(b, 2 * w.direction + w.side);
  std::vector<std::string> notes;
  Neighbourhood others;
  others.alone = false;
  std::vector<Block<D>> read = build_grid_file<D>(config, support::Scene(), others, notes);
  ASSERT_EQ(notes.size(), 1u);
  find_joins(read);
  ASSERT_EQ(read.size(), s.parts.size());
  for (std::size_t b = 0; b < read.size(); ++b) {
    ASSERT_EQ(read[b].windows.size(), s.parts[b].windows.size());
    for (std::size_t w = 0; w < read[b].windows.size(); ++w)
      EXPECT_EQ(read[b].windows[w].condition, s.parts[b].windows[w].condition);
    EXPECT_EQ(read[b].volume, s.parts[b].volume);
  }
  std::filesystem::remove(config.file);
}

TEST(GridFileTest, BlocksComeBackAsTheyWereWritten) {
  round_trip<2>(".p3d");
  round_trip<3>(".p3d");
  round_trip<3>(".fmt");
}

TEST(GridFileTest, ALeftHandedBlockKeepsTheNamesOfItsFaces) {
  Block<2> box = deformed_box<2>(4);
  for (auto& x : box.node[1]) x = -x;
  GridFileConfig config;
  config.file = temporary("left.fmt");
  write_grid<2>(config.file, {box});
  GridFileConfig::Face inflow;
  inflow.face = 0;  // i_lower of the file
  inflow.condition = closed(Condition::inflow);
  inflow.condition.name = "in";
  inflow.condition.u = support::Formula("1", {});
  config.faces.push_back(inflow);
  for (const int face : {1, 2, 3}) {
    inflow.face = face;
    inflow.condition = closed(Condition::wall);
    config.faces.push_back(inflow);
  }
  std::vector<std::string> notes;
  const auto blocks = build_grid_file<2>(config, support::Scene(), {}, notes);
  ASSERT_EQ(notes.size(), 2u);
  EXPECT_NE(notes[1].find("left-handed"), std::string::npos);
  for (const auto& w : blocks[0].windows)
    if (w.name == "in") {
      EXPECT_EQ(w.direction, 0);
      EXPECT_EQ(w.side, 1);
      EXPECT_EQ(face_name(blocks[0], 0, 1), "i_lower");
    }
  std::filesystem::remove(config.file);
}

TEST(QualityTest, SkewStretchingAndAspectAreThoseOfTheCells) {
  const auto block = make_block<2>("skew", {4, 3}, {}, [](const std::array<int, 2>& i) {
    const double x = i[0] < 3 ? i[0] : 2.0 + 2.0 * (i[0] - 2);  // the last two cells are twice as wide
    return std::array<double, 2>{x + std::sqrt(3.0) * 0.1 * i[1], 0.1 * i[1]};
  });
  const Quality<2> q = quality(block);
  EXPECT_NEAR(q.skewness.value, 60.0, 1e-9);
  EXPECT_NEAR(q.stretching.value, 2.0, 1e-9);
  EXPECT_NEAR(q.aspect.value, 2.0 * std::cos(M_PI / 3.0) / 0.1, 1e-9);
  EXPECT_NEAR(q.largest, 0.2, 1e-12);
}

}  // namespace
}  // namespace littoral::fv
