#include "io/output.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "clouds.hpp"

namespace littoral::sph {
namespace {

class OutputTest : public ::testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove_all(folder_); }

  static std::vector<std::string> cells(const std::string& line) {
    std::vector<std::string> found;
    std::istringstream in(line);
    for (std::string cell; std::getline(in, cell, ',');) found.push_back(cell);
    return found;
  }
  /// The last row of scalars.csv by column.
  std::map<std::string, double> last_row() const {
    std::ifstream file(folder_ + "/scalars.csv");
    std::vector<std::string> names, values;
    for (std::string line; std::getline(file, line);) {
      if (line.empty() || line[0] == '#') continue;
      (names.empty() ? names : values) = cells(line);
    }
    EXPECT_EQ(names.size(), values.size());
    std::map<std::string, double> row;
    for (std::size_t k = 0; k < std::min(names.size(), values.size()); ++k)
      row[names[k]] = std::stod(values[k]);
    return row;
  }

  const std::string folder_ =
      std::string("output_") + ::testing::UnitTest::GetInstance()->current_test_info()->name();
};

TEST_F(OutputTest, TellsWhatTheLayersAndTheOuterFacesDid) {
  std::filesystem::create_directories(folder_);
  RunConfig config;
  config.scene.fluid.sound_speed = 10.0;
  config.scene.coupling.kind = support::Scene::CouplingKind::imposed;
  config.scene.domain.upper = {20.0, 0.0, 20.0};
  for (auto& side : config.scene.domain.sides)
    side = {support::Scene::Side::open, support::Scene::Side::open};
  config.sph.spacing = 1.0;
  auto particles = test::cloud<2>({4, 4}, 1.0);
  const Dynamics<2> dynamics(numerics_of<2>(config), domain_of<2>(config));
  Output<2> output(folder_, config);
  Output<2>::Moment now;
  now.exchanged.removed_crossing = 3;
  now.exchanged.removed_nearest = 2;
  now.exchanged.injected_through = {1, 2, 0, 0, 5, 6};
  now.exchanged.removed_through = {7, 8, 0, 0, 11, 12};
  now.layers = {11, 12, 13};
  output.write_rows(now, particles, dynamics, Layers<2>::from_scene(config.scene, 4.0));
  auto row = last_row();
  EXPECT_EQ(row["n_removed_crossing"], 3.0);
  EXPECT_EQ(row["n_removed_nearest"], 2.0);
  EXPECT_EQ(row["n_injected_x_lower"], 1.0);
  EXPECT_EQ(row["n_injected_z_upper"], 6.0);
  EXPECT_EQ(row["n_removed_x_upper"], 8.0);
  EXPECT_EQ(row["n_removed_z_lower"], 11.0);
  EXPECT_EQ(row["n_blending"], 11.0);
  EXPECT_EQ(row["n_driven"], 12.0);
  EXPECT_EQ(row["n_without_donors"], 13.0);
}

}  // namespace
}  // namespace littoral::sph
