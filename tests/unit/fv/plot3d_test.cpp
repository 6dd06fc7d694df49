#include "grid/plot3d.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "littoral/error.hpp"

namespace littoral::fv {
namespace {

std::string place(const std::string& name) {
  return (std::filesystem::temp_directory_path() / ("littoral_plot3d_" + std::to_string(::getpid()) + name))
      .string();
}

Plot3dFile sample(const Plot3dDialect& d) {
  Plot3dFile file;
  file.dialect = d;
  const int n_blocks = d.multi_block ? 3 : 1;
  for (int b = 0; b < n_blocks; ++b) {
    Plot3dBlock block;
    block.n = {3 + b, 4, d.planar ? 1 : 2 + b};
    for (std::size_t k = 0; k < (d.planar ? 2u : 3u); ++k)
      for (std::size_t i = 0; i < block.nodes(); ++i)
        block.x[k].push_back(0.37 * static_cast<double>(i) - 1.0 / 3.0 * static_cast<double>(k) + b);
    if (d.iblank)
      for (std::size_t i = 0; i < block.nodes(); ++i) block.iblank.push_back(i % 5 == 0 ? 0 : 1);
    file.blocks.push_back(block);
  }
  return file;
}

/// Every dialect comes back as what it was written.
TEST(Plot3dTest, EveryDialectIsRecognised) {
  const std::string path = place("grid");
  for (unsigned bits = 0; bits < 128; ++bits) {
    Plot3dDialect d;
    d.formatted = bits & 1u;
    d.records = bits & 2u;
    d.single_precision = bits & 4u;
    d.multi_block = bits & 8u;
    d.iblank = bits & 16u;
    d.planar = bits & 32u;
    d.foreign_bytes = bits & 64u;
    if (d.formatted && (d.records || d.foreign_bytes)) continue;
    const Plot3dFile written = sample(d);
    write_plot3d(path, written);
    const Plot3dFile read = read_plot3d(path);
    ASSERT_EQ(read.blocks.size(), written.blocks.size()) << bits;
    EXPECT_EQ(read.dialect.formatted, d.formatted);
    if (!d.formatted) {
      EXPECT_EQ(read.dialect.records, d.records);
      EXPECT_EQ(read.dialect.single_precision, d.single_precision);
      EXPECT_EQ(read.dialect.foreign_bytes, d.foreign_bytes);
    }
    EXPECT_EQ(read.dialect.multi_block, d.multi_block);
    EXPECT_EQ(read.dialect.iblank, d.iblank);
    EXPECT_EQ(read.dialect.planar, d.planar);
    for (std::size_t b = 0; b < read.blocks.size(); ++b) {
      EXPECT_EQ(read.blocks[b].n, written.blocks[b].n);
      EXPECT_EQ(read.blocks[b].iblank, written.blocks[b].iblank);
      for (std::size_t k = 0; k < 3; ++k) {
        ASSERT_EQ(read.blocks[b].x[k].size(), written.blocks[b].x[k].size());
        for (std::size_t i = 0; i < read.blocks[b].x[k].size(); ++i)
          EXPECT_NEAR(read.blocks[b].x[k][i], written.blocks[b].x[k][i], d.single_precision ? 2e-6 : 0.0);
      }
    }
  }
  std::filesystem::remove(path);
}

TEST(Plot3dTest, FortranNumbersAreRead) {
  const std::string path = place("text");
  std::ofstream(path) << " 2 2\n 0.0, 2*1.0D+00 .5E0\n 3*0 2.5d-1\n";
  const Plot3dFile file = read_plot3d(path);
  ASSERT_EQ(file.blocks.size(), 1u);
  EXPECT_EQ(file.blocks[0].x[0], (std::vector<double>{0.0, 1.0, 1.0, 0.5}));
  EXPECT_EQ(file.blocks[0].x[1], (std::vector<double>{0.0, 0.0, 0.0, 0.25}));
  EXPECT_EQ(describe(file), "formatted, one block without a count in a plane");
  std::filesystem::remove(path);
}

TEST(Plot3dTest, OtherFilesAreRefused) {
  const std::string path = place("other");
  std::ofstream(path) << "title: no grid\n";
  EXPECT_THROW(read_plot3d(path), ConfigError);
  Plot3dFile cut = sample({});
  write_plot3d(path, cut);
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 8);
  EXPECT_THROW(read_plot3d(path), ConfigError);
  for (const char* text : {"2 2\n 9999999999999*1.0\n", "2 2\n 0 1 nan 1 0 0 1 1\n"}) {
    std::ofstream(path) << text;
    EXPECT_THROW(read_plot3d(path), ConfigError) << text;
  }
  write_plot3d(path, sample({}));
  {  // the mark that closes the last record
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(-4, std::ios::end);
    file.write("abcd", 4);
  }
  EXPECT_THROW(read_plot3d(path), ConfigError);
  std::filesystem::remove(path);
  EXPECT_THROW(read_plot3d(path), IoError);
}

}  // namespace
}  // namespace littoral::fv
