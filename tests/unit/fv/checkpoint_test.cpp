#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "grids.hpp"
#include "implicit/multigrid_solver.hpp"
#include "io/checkpoint.hpp"
#include "littoral/error.hpp"
#include "overset/assembly.hpp"

// A checkpoint goes on only over the grid it was written on.
namespace littoral::fv {
namespace {

Stepper<2> patch_over_box(double stretching, int overlap) {
  std::vector<Block<2>> blocks;
  blocks.push_back(make_block<2>("box", {16, 16}, {}, [=](const std::array<int, 2>& i) {
    return std::array<double, 2>{std::pow(i[0] / 16.0, stretching), i[1] / 16.0};
  }));
  blocks.push_back(make_block<2>("patch", {10, 10}, {}, [](const std::array<int, 2>& i) {
    return std::array<double, 2>{0.22 + i[0] / 17.0, 0.23 + i[1] / 17.0};
  }));
  close_with<2>(blocks[0], Condition::slip);
  close_with<2>(blocks[1], Condition::overset);
  OversetOptions options;
  options.overlap = overlap;
  OversetAssembly<2> assembly = assemble_overset<2>(blocks, options);
  Stepper<2> stepper(std::move(blocks), Equations<2>{}, std::make_unique<MultigridSolver<2>>(), {},
                     std::move(assembly.links));
  stepper.initialise([](const std::array<double, 2>&, double) { return PointState<2>{}; }, 0.0);
  return stepper;
}

std::string refusal(const std::string& path, Stepper<2> stepper) {
  try {
    read_checkpoint<2>(path, stepper, support::Scene{});
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(FvCheckpointTest, AnotherGridOrOverlapIsRefused) {
  const auto path = (std::filesystem::temp_directory_path() / "littoral_fv_checkpoint.h5").string();
  write_checkpoint<2>(path, patch_over_box(1.0, 1), 7, support::Scene{});
  Stepper<2> same = patch_over_box(1.0, 1);
  EXPECT_EQ(read_checkpoint<2>(path, same, support::Scene{}), 7);
  EXPECT_NE(refusal(path, patch_over_box(1.01, 1)).find("another grid"), std::string::npos);
  EXPECT_NE(refusal(path, patch_over_box(1.0, 0)).find("another overlap"), std::string::npos);

  // a region of particles takes cells of the overlap: the file has them as fringe, the grid as assembled
  Stepper<2> carved = patch_over_box(1.0, 1);
  for (Block<2>& block : carved.blocks())
    for (CellStatus& status : block.status)
      if (status == CellStatus::interpolated) status = CellStatus::fringe;
  write_checkpoint<2>(path, carved, 9, support::Scene{});
  EXPECT_EQ(read_checkpoint<2>(path, same, support::Scene{}), 9);
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace littoral::fv
