#include "grid/metrics.hpp"

#include <gtest/gtest.h>

#include "grids.hpp"
#include "littoral/error.hpp"

namespace littoral::fv {
namespace {

template <int D>
double worst_opening(const Block<D>& b) {
  double worst = 0.0;
  for_each_index<D>({}, b.extent.n, [&](const std::array<int, D>& index) {
    const std::ptrdiff_t c = b.extent.at(index);
    double sum[D] = {}, measure = 0.0;
    for (std::size_t d = 0; d < D; ++d)
      for (std::size_t k = 0; k < D; ++k) {
        const double low = b.area[d][k][static_cast<std::size_t>(c)];
        const double up = b.area[d][k][static_cast<std::size_t>(c + b.extent.stride[d])];
        sum[k] += up - low;
        measure += std::abs(low);
      }
    for (double s : sum) worst = std::max(worst, std::abs(s) / measure);
  });
  return worst;
}

template <int D>
double total_volume(const Block<D>& b) {
  double v = 0.0;
  for_each_index<D>({}, b.extent.n, [&](const std::array<int, D>& index) {
    v += b.volume[static_cast<std::size_t>(b.extent.at(index))];
  });
  return v;
}

TEST(MetricsTest, CellsAreClosedOnADeformedGrid) {
  EXPECT_LT(worst_opening(deformed_box<2>(9)), 1e-14);
  EXPECT_LT(worst_opening(deformed_box<3>(6)), 1e-14);
}

TEST(MetricsTest, VolumesFillTheSkewedBoxExactly) {
  // shear and inner waves leave the unit box's volume as it is; trilinear volumes of neighbours share faces
  EXPECT_NEAR(total_volume(deformed_box<2>(9)), 1.0, 1e-14);
  EXPECT_NEAR(total_volume(deformed_box<3>(6)), 1.0, 1e-14);
}

TEST(MetricsTest, GhostsMirrorOrRepeatTheSpacing) {
  Block<2> open = deformed_box<2>(5, 0.0, 0.0, 1.5);
  EXPECT_NEAR(open.volume[static_cast<std::size_t>(open.extent.at({-1, 2}))],
              open.volume[static_cast<std::size_t>(open.extent.at({0, 2}))], 1e-15);
  EXPECT_NEAR(open.centre[0][static_cast<std::size_t>(open.extent.at({-2, 2}))],
              -open.centre[0][static_cast<std::size_t>(open.extent.at({1, 2}))], 1e-15);
  const auto position = [](const std::array<int, 2>& i) {
    const double s[] = {0.0, 0.1, 0.4, 1.0};
    return std::array<double, 2>{s[i[0]], 0.25 * i[1]};
  };
  Block<2> closed = make_block<2>("ring", {3, 4}, {true, false}, position);
  EXPECT_NEAR(closed.centre[0][static_cast<std::size_t>(closed.extent.at({-1, 0}))], 0.7 - 1.0, 1e-15);
  EXPECT_NEAR(closed.centre[0][static_cast<std::size_t>(closed.extent.at({4, 0}))], 0.25 + 1.0, 1e-15);
}

TEST(MetricsTest, AFoldedCellIsNamed) {
  const auto position = [](const std::array<int, 2>& i) {
    return std::array<double, 2>{i[0] == 2 ? 0.5 : 1.0 * i[0], 1.0 * i[1]};
  };
  try {
    make_block<2>("hull", {3, 2}, {}, position);
    FAIL() << "a folded grid was accepted";
  } catch (const ConfigError& e) {
    const std::string text = e.what();
    EXPECT_NE(text.find("'hull'"), std::string::npos) << text;
    EXPECT_NE(text.find("(1, 0)"), std::string::npos) << text;
  }
}

TEST(ExtentTest, IndexInvertsAt) {
  const Extent<3> e({4, 3, 5});
  for (const std::array<int, 3> index : {std::array<int, 3>{-2, -2, -2}, {0, 0, 0}, {5, 4, 6}, {3, -1, 2}})
    EXPECT_EQ(e.index(e.at(index)), index);
}

}  // namespace
}  // namespace littoral::fv
