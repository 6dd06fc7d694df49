#include "littoral/coupler/donor_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "littoral/error.hpp"

namespace littoral::coupler {
namespace {

using Shape = std::function<Vec3(double, double, double)>;

DonorPatch patch_of(std::array<int, 3> n, const Shape& shape) {
  DonorPatch patch;
  patch.n = n;
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i) {
        const auto at = [](int index, int count) { return count > 1 ? index / (count - 1.0) : 0.0; };
        const Vec3 x = shape(at(i, n[0]), at(j, n[1]), at(k, n[2]));
        patch.x.push_back(x[0]);
        patch.y.push_back(x[1]);
        patch.z.push_back(x[2]);
      }
  patch.usable.assign(patch.x.size(), 1);
  return patch;
}

Shape box(const Vec3& lower, const Vec3& upper) {
  return [=](double a, double b, double c) {
    return Vec3{lower[0] + a * (upper[0] - lower[0]), lower[1] + b * (upper[1] - lower[1]),
                lower[2] + c * (upper[2] - lower[2])};
  };
}

/// First cell 1000 times smaller than the last, sheared by 40 degrees, bent along the other direction.
Vec3 skewed_and_stretched(double a, double b, double c) {
  const double growth = std::log(1000.0);
  const double z = (std::exp(growth * c) - 1.0) / 999.0;
  return {a + 0.84 * z, b + 0.3 * a * a, z + 0.05 * std::sin(3.0 * a) + 0.2 * b};
}

DonorGeometry geometry_of(std::vector<DonorPatch> patches) {
  DonorGeometry geometry;
  geometry.patches = std::move(patches);
  return geometry;
}

DonorValues values_of(const DonorGeometry& geometry, const std::function<double(const Vec3&)>& p) {
  DonorValues values;
  values.horizon_end = 1.0;
  values.resize(geometry.size(), false);
  std::size_t c = 0;
  for (const auto& patch : geometry.patches)
    for (std::size_t i = 0; i < patch.size(); ++i, ++c)
      values.p[c] = patch.usable[i] ? p({patch.x[i], patch.y[i], patch.z[i]}) : std::nan("");
  return values;
}

double linear(const Vec3& x) { return 3.0 - 1.5 * x[0] + 0.7 * x[1] + 2.2 * x[2]; }

/// Random points inside dual cells.
std::vector<Vec3> points_inside(const DonorPatch& patch, int count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<Vec3> points;
  const std::array<const std::vector<double>*, 3> coordinate{&patch.x, &patch.y, &patch.z};
  for (int m = 0; m < count; ++m) {
    std::array<int, 3> index{}, span{};
    Vec3 xi{};
    for (std::size_t d = 0; d < 3; ++d) {
      span[d] = patch.n[d] > 1;
      if (span[d]) index[d] = std::uniform_int_distribution<int>(0, patch.n[d] - 2)(random);
      xi[d] = span[d] ? unit(random) : 0.0;
    }
    Vec3 x{};
    for (int k = 0; k < 8; ++k) {
      double weight = 1.0;
      std::array<int, 3> corner = index;
      for (std::size_t d = 0; d < 3; ++d) {
        const bool high = k >> d & 1;
        weight *= high ? xi[d] : 1.0 - xi[d];
        corner[d] += high ? span[d] : 0;
      }
      const auto c = static_cast<std::size_t>(corner[0] + patch.n[0] * (corner[1] + patch.n[1] * corner[2]));
      for (std::size_t d = 0; d < 3; ++d) x[d] += weight * (*coordinate[d])[c];
    }
    points.push_back(x);
  }
  return points;
}

#ifdef __SANITIZE_ADDRESS__
constexpr int k_points = 4'000;  // the sanitizers make the walk twenty times as long
#else
constexpr int k_points = 100'000;
#endif

// Case C1. The bound: the position is found to round-off of the cell's size, the gradient is about 3.
TEST(DonorSearchTest, LinearFieldsAreExactOnASkewedBlockOfStretching1000) {
  const auto geometry = geometry_of({patch_of({21, 13, 41}, skewed_and_stretched)});
  const DonorSearch search(geometry, 3);
  const auto values = values_of(geometry, linear);
  std::int64_t hint = -1;
  for (const auto& x : points_inside(geometry.patches[0], k_points)) {
    const Donor donor = search.find(x, hint);
    ASSERT_TRUE(donor.found);
    ASSERT_NEAR(interpolate(values, donor, 0.5).p, linear(x), 1e-12 * 8);
  }
}

TEST(DonorSearchTest, FindsWithoutHintWhatItFindsWithOne) {
  const auto geometry = geometry_of({patch_of({9, 8, 17}, skewed_and_stretched)});
  const DonorSearch search(geometry, 3);
  std::int64_t hint = 0;
  for (const auto& x : points_inside(geometry.patches[0], k_points / 20)) {
    std::int64_t none = -1, absurd = 123'456'789;
    const Donor fresh = search.find(x, none);
    for (auto* start : {&hint, &absurd}) {
      const Donor again = search.find(x, *start);
      ASSERT_TRUE(fresh.found && again.found);
      ASSERT_EQ(fresh.cell, again.cell);
      ASSERT_EQ(fresh.weight, again.weight);  // to the bit: a restart loses the hints
    }
  }
}

TEST(DonorSearchTest, PointsOnFacesHaveTheSameDonorsFromEverySide) {
  const auto geometry = geometry_of({patch_of({6, 1, 5}, box({0, 0, 0}, {5, 0, 4}))});
  const DonorSearch search(geometry, 2);
  for (double x = 0.0; x <= 5.0; x += 0.5)
    for (double z = 0.0; z <= 4.0; z += 0.5) {
      std::int64_t none = -1;
      const Donor fresh = search.find({x, 0, z}, none);
      ASSERT_TRUE(fresh.found);
      for (std::int64_t start = 0; start < 24; ++start) {
        std::int64_t hint = start;
        ASSERT_EQ(search.find({x, 0, z}, hint).cell, fresh.cell) << x << " " << z << " from " << start;
      }
    }
}

TEST(DonorSearchTest, PlanarPatchesMayBeThinInAnyIndexDirection) {
  for (int thin = 0; thin < 3; ++thin) {
    std::array<int, 3> n{7, 7, 7};
    n[static_cast<std::size_t>(thin)] = 1;
    const auto shape = [thin](double a, double b, double c) {
      const double first = thin == 0 ? b : a, second = thin == 2 ? b : c;
      return Vec3{first + 0.3 * second, 0.0, second * second + second};
    };
    const auto geometry = geometry_of({patch_of(n, shape)});
    const DonorSearch search(geometry, 2);
    const auto values = values_of(geometry, linear);
    std::int64_t hint = -1;
    for (auto x : points_inside(geometry.patches[0], 2000)) {
      const Donor donor = search.find(x, hint);
      ASSERT_TRUE(donor.found);
      for (std::size_t k = 4; k < 8; ++k) ASSERT_EQ(donor.weight[k], 0.0);
      ASSERT_NEAR(interpolate(values, donor, 0.0).p, linear(x), 1e-12);
    }
  }
}

TEST(DonorSearchTest, ExtrapolatesHalfACellAndNoFurther) {
  const auto geometry = geometry_of({patch_of({5, 5, 5}, box({0, 0, 0}, {4, 4, 4}))});
  const DonorSearch search(geometry, 3);
  const auto values = values_of(geometry, linear);
  for (const Vec3 x : {Vec3{-0.49, 2.2, 1.3}, Vec3{4.49, 4.49, 4.49}, Vec3{1.1, -0.3, 4.3}}) {
    std::int64_t hint = -1;
    const Donor donor = search.find(x, hint);
    ASSERT_TRUE(donor.found);
    EXPECT_NEAR(interpolate(values, donor, 0.0).p, linear(x), 1e-12);
  }
  for (const Vec3 x : {Vec3{-0.51, 2, 2}, Vec3{2, 4.51, 2}, Vec3{100, 0, 0}, Vec3{std::nan(""), 1, 1}}) {
    for (std::int64_t start : {-1, 0, 31}) {
      std::int64_t hint = start;
      EXPECT_FALSE(search.find(x, hint).found);
    }
  }
}

TEST(DonorSearchTest, BlankedCellsAreNeverUsed) {
  auto patch = patch_of({12, 12, 12}, box({0, 0, 0}, {11, 11, 11}));
  std::mt19937 random(3);
  for (auto& usable : patch.usable) usable = random() % 8 != 0;
  const auto geometry = geometry_of({patch});
  const DonorSearch search(geometry, 3);
  const auto values = values_of(geometry, linear);  // NaN where blanked
  int found = 0;
  std::int64_t hint = -1;
  for (const auto& x : points_inside(patch, 5000)) {
    const Donor donor = search.find(x, hint);
    if (!donor.found) continue;
    ++found;
    ASSERT_NEAR(interpolate(values, donor, 0.0).p, linear(x), 1e-10);  // fits have weights up to about ten
  }
  EXPECT_GT(found, 4900);
}

TEST(DonorSearchTest, HalfACellBeyondABlankedRegionStillFindsDonors) {
  auto patch = patch_of({8, 1, 8}, box({0, 0, 0}, {7, 0, 7}));
  for (std::size_t c = 0; c < patch.size(); ++c) patch.usable[c] = patch.z[c] < 3.5;
  const auto geometry = geometry_of({patch});
  const DonorSearch search(geometry, 2);
  const auto values = values_of(geometry, linear);
  std::int64_t hint = -1;
  const Vec3 near{2.7, 0, 3.4}, far{2.7, 0, 3.6};
  const Donor donor = search.find(near, hint);
  ASSERT_TRUE(donor.found);
  EXPECT_NEAR(interpolate(values, donor, 0.0).p, linear(near), 1e-12);
  EXPECT_FALSE(search.find(far, hint).found);
}

TEST(DonorSearchTest, WherePatchesOverlapTheFinerUsableOneWins) {
  auto coarse = patch_of({5, 5, 5}, box({0, 0, 0}, {4, 4, 4}));
  auto fine = patch_of({9, 9, 9}, box({1, 1, 1}, {3, 3, 3}));
  auto geometry = geometry_of({coarse, fine});
  std::int64_t hint = 31;  // in the coarse patch
  EXPECT_GE(DonorSearch(geometry, 3).find({2.1, 2.1, 2.1}, hint).cell[0], 125);
  for (auto& usable : geometry.patches[1].usable) usable = 0;
  EXPECT_LT(DonorSearch(geometry, 3).find({2.1, 2.1, 2.1}, hint).cell[0], 125);
}

TEST(DonorSearchTest, EmptyGeometryAndSingleRowsFindNothing) {
  std::int64_t hint = -1;
  EXPECT_FALSE(DonorSearch(DonorGeometry{}, 3).find({0, 0, 0}, hint).found);
  const auto row = geometry_of({patch_of({5, 1, 1}, box({0, 0, 0}, {4, 0, 0})), DonorPatch{}});
  EXPECT_FALSE(DonorSearch(row, 2).find({1, 0, 0}, hint).found);
}

TEST(InterpolateTest, RefusesTimesOutsideTheHorizon) {
  const auto geometry = geometry_of({patch_of({3, 1, 3}, box({0, 0, 0}, {2, 0, 2}))});
  auto values = values_of(geometry, linear);
  values.horizon_begin = values.time = 1.0;
  values.horizon_end = 1.1;
  std::int64_t hint = -1;
  const Donor donor = DonorSearch(geometry, 2).find({1, 0, 1}, hint);
  EXPECT_NO_THROW(interpolate(values, donor, 1.0 + 0.1));
  EXPECT_NO_THROW(interpolate(values, donor, 1.1 * (1 + 1e-15)));
  for (const double t : {0.99, 1.11, std::nan("")})
    EXPECT_THROW(interpolate(values, donor, t), CouplingError);
  EXPECT_THROW(interpolate(values, Donor{}, 1.05), CouplingError);
}

// Case C5: backward differences over one window, extrapolated over the next, (24).
TEST(InterpolateTest, ExtrapolationInTimeIsOfSecondOrder) {
  const auto geometry = geometry_of({patch_of({3, 1, 3}, box({0, 0, 0}, {2, 0, 2}))});
  std::int64_t hint = -1;
  const Donor donor = DonorSearch(geometry, 2).find({0.4, 0, 1.3}, hint);
  const auto signal = [](double t) { return std::sin(3.0 * t + 0.2); };
  const auto error = [&](double dt) {
    auto values = values_of(geometry, [&](const Vec3&) { return signal(1.0); });
    values.time = values.horizon_begin = 1.0;
    values.horizon_end = 1.0 + dt;
    std::fill(values.dp_dt.begin(), values.dp_dt.end(), (signal(1.0) - signal(1.0 - dt)) / dt);
    return std::abs(interpolate(values, donor, 1.0 + dt).p - signal(1.0 + dt));
  };
  EXPECT_NEAR(std::log2(error(2e-3) / error(1e-3)), 2.0, 0.02);  // the next term is O(dt) of the first
}

}  // namespace
}  // namespace littoral::coupler
