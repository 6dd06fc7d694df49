#include <gtest/gtest.h>

#include "clouds.hpp"
#include "physics/term.hpp"

namespace littoral::sph {
namespace {

/// Viscous acceleration in the middle of a lattice with u = z^2 / 2 (laplacian 1) over nu.
template <int D>
double lattice_factor(double radius) {
  std::array<int, D> n;
  n.fill(11);
  auto particles = test::cloud<D>(n, 1.0);
  for (std::size_t i = 0; i < particles.n_owned; ++i)
    particles.u[0][i] = 0.5 * std::pow(particles.x[D - 1][i], 2);
  NeighborList<D> neighbors(radius, 0.1);
  neighbors.build(particles);
  Rate<D> rate;
  rate.resize(particles.n_owned);
  const double nu = 0.3;
  Viscosity<D>(nu).add(particles, neighbors, 0.0, rate);
  return rate.acceleration[0][particles.n_owned / 2] / nu;
}

// Known deficit of this form on Cartesian lattices, computed independently to three decimals.
TEST(ViscosityTest, LatticeFactorsAreThoseOfTheFormula) {
  EXPECT_NEAR(lattice_factor<2>(3.0), 0.886, 6e-4);
  EXPECT_NEAR(lattice_factor<2>(4.0), 0.959, 6e-4);
  EXPECT_NEAR(lattice_factor<3>(2.7), 0.887, 6e-4);
}

TEST(ViscosityTest, KeepsMomentumAndIgnoresRigidRotation) {
  auto particles = test::cloud<2>({12, 10}, 1.0, 0.3);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  for (auto& column : particles.u)
    for (double& u : column) u = value(random);
  NeighborList<2> neighbors(4.0, 0.1);
  neighbors.build(particles);
  Rate<2> rate;
  rate.resize(particles.n_owned);
  const Viscosity<2> viscosity(1.0);
  viscosity.add(particles, neighbors, 0.0, rate);
  double sum = 0.0, scale = 0.0;
  for (std::size_t i = 0; i < particles.n_owned; ++i) {
    sum += particles.m[i] * rate.acceleration[0][i];
    scale += std::fabs(particles.m[i] * rate.acceleration[0][i]);
  }
  EXPECT_LE(std::fabs(sum), 1e-13 * scale);

  for (std::size_t i = 0; i < particles.n_owned; ++i) {
    particles.u[0][i] = -particles.x[1][i];
    particles.u[1][i] = particles.x[0][i];
    rate.acceleration[0][i] = 0.0;
  }
  viscosity.add(particles, neighbors, 0.0, rate);
  for (std::size_t i = 0; i < particles.n_owned; ++i) EXPECT_NEAR(rate.acceleration[0][i], 0.0, 1e-12);
}

}  // namespace
}  // namespace littoral::sph
