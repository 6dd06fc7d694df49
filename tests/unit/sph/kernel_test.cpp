#include "physics/kernel.hpp"

#include <gtest/gtest.h>

#include <array>

namespace littoral::sph {
namespace {

struct LatticeSums {
  int neighbors = 0;
  double volume = 0.0;  // sum V W
  double slope = 0.0;   // -sum V x dW/dx
};

template <int D>
LatticeSums lattice_sums(double radius) {
  const Kernel<D> kernel(radius);
  LatticeSums sums;
  for (int i = -5; i <= 5; ++i)
    for (int j = -5; j <= 5; ++j)
      for (int k = D == 3 ? -5 : 0; k <= (D == 3 ? 5 : 0); ++k) {
        const double r = std::sqrt(i * i + j * j + k * k);
        if (r >= radius) continue;
        ++sums.neighbors;
        sums.volume += kernel.value(r);
        sums.slope -= i * i * kernel.slope_over_r(r);
      }
  return sums;
}

// Values on a unit lattice, computed independently to five decimals.
struct Row {
  int dimension;
  double radius;
  int neighbors;
  double volume, slope;
};
constexpr std::array<Row, 4> k_table = {{{2, 3.0, 25, 1.00514, 0.99740},
                                         {2, 4.0, 45, 1.00121, 0.99920},
                                         {3, 2.7, 81, 1.00647, 0.98410},
                                         {3, 3.0, 93, 1.00314, 1.00062}}};

TEST(KernelTest, LatticeSumsAgreeWithTable) {
  for (const Row& row : k_table) {
    const LatticeSums sums = row.dimension == 2 ? lattice_sums<2>(row.radius) : lattice_sums<3>(row.radius);
    EXPECT_EQ(sums.neighbors, row.neighbors);
    EXPECT_NEAR(sums.volume, row.volume, 6e-6);
    EXPECT_NEAR(sums.slope, row.slope, 6e-6);
  }
}

TEST(KernelTest, IntegratesToOne) {
  constexpr int k_shells = 20000;
  double disc = 0.0, ball = 0.0;
  const Kernel<2> plane(1.7);
  const Kernel<3> space(1.7);
  for (int k = 0; k < k_shells; ++k) {
    const double dr = 1.7 / k_shells, r = (k + 0.5) * dr;
    disc += 2.0 * k_pi * r * dr * plane.value(r);
    ball += 4.0 * k_pi * r * r * dr * space.value(r);
  }
  EXPECT_NEAR(disc, 1.0, 1e-8);  // midpoint rule: error of order dr^2
  EXPECT_NEAR(ball, 1.0, 1e-8);
}

TEST(KernelTest, SlopeIsTheDerivative) {
  const Kernel<3> kernel(2.0);
  for (double r : {0.1, 0.7, 1.3, 1.9}) {
    const double h = 1e-5;
    const double derivative = (kernel.value(r + h) - kernel.value(r - h)) / (2 * h);
    EXPECT_NEAR(kernel.slope_over_r(r) * r, derivative, 1e-8);
  }
}

TEST(KernelTest, VanishesOutsideItsRadius) {
  const Kernel<2> kernel(2.0);
  EXPECT_EQ(kernel.value(2.0), 0.0);
  EXPECT_EQ(kernel.value(3.0), 0.0);
  EXPECT_EQ(kernel.slope_over_r(2.5), 0.0);
}

}  // namespace
}  // namespace littoral::sph
