#include "level_set/elevation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "grids.hpp"

namespace littoral::fv {
namespace {

/// phi bends between the centres: where a line begins must not show in where it finds the zero.
TEST(ElevationTest, IsTheSameHoweverTheBlockIsCut) {
  const auto of_block = [](int first, int last) {
    Block<2> block = make_block<2>("part", {4, last - first}, {}, [=](const std::array<int, 2>& i) {
      return std::array<double, 2>{0.25 * i[0], 0.1 * (first + i[1])};
    });
    Field phi(block.extent.size);
    for (std::size_t c = 0; c < phi.size(); ++c) phi[c] = std::expm1(3.0 * (block.centre[1][c] - 0.6137));
    return ElevationLine<2>(block, {0.4, 0.0, 0.0}, {0.0, 0.0, 1.0}).read(phi).height;
  };
  const double whole = of_block(0, 10);
  EXPECT_NEAR(whole, 0.6137, 0.01);
  for (const int first : {1, 2, 3, 4, 5}) EXPECT_NEAR(of_block(first, 9), whole, 1e-12) << first;
}

TEST(ElevationTest, OfTheUppermostGridThatSeesTheHighestSurface) {
  EXPECT_EQ(highest({{0.51, 0.1, 0.0}, {0.50, 0.02, 2.0}, {0.49, 0.05, 1.0}}).height, 0.50);
  EXPECT_EQ(highest({{0.51, 0.1, 0.0}, {0.2, 0.02, 2.0}}).height, 0.51);  // another surface
  EXPECT_EQ(highest({{}, {0.3, 0.1, 0.0}, {}}).height, 0.3);
  EXPECT_TRUE(std::isnan(highest({{}}).height));
  EXPECT_TRUE(std::isnan(highest({}).height));
}

}  // namespace
}  // namespace littoral::fv
