#include "pairs/pair_rows.hpp"

#include <gtest/gtest.h>

#include "clouds.hpp"
#include "physics/riemann_fluxes.hpp"

namespace littoral::sph {
namespace {

constexpr LinearEos k_eos{1000.0, 10.0, 50.0};

/// A cloud with free sides, far from the origin by `away`, with smooth velocities and pressures.
template <int D>
Particles<D> flow(double away) {
  std::array<int, D> cells;
  cells.fill(D == 2 ? 16 : 9);
  auto particles = test::cloud<D>(cells, 1.0, 0.2);
  for (std::size_t i = 0; i < particles.n_owned; ++i) {
    const double x = particles.x[0][i], z = particles.x[D - 1][i];
    for (std::size_t d = 0; d < D; ++d)
      particles.u[d][i] = std::sin(0.4 * x + 0.3 * z + static_cast<double>(d));
    particles.p[i] = k_eos.p0 + 1000.0 * std::cos(0.3 * x - 0.2 * z);
    particles.rho[i] = k_eos.density(particles.p[i]);
    particles.m[i] = particles.rho[i] * particles.V[i];
    particles.x[0][i] += away;
  }
  return particles;
}

template <int D, class Real>
Rate<D> rates(const Particles<D>& particles, Reconstruction reconstruction) {
  NeighborList<D> neighbors(D == 2 ? 4.0 : 2.7, 0.3);
  neighbors.build(particles);
  PairRows<D, Real> rows;
  rows.pack_states(particles, Kernel<D>(neighbors.kernel_radius()), k_eos.p0);
  compute_gradients(rows, neighbors);
  Rate<D> rate;
  riemann_fluxes(particles, rows, neighbors, k_eos, reconstruction, RiemannSolver::linearised, rate);
  return rate;
}

/// Largest difference, of the largest value.
double apart(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0.0, largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    most = std::max(most, std::fabs(a[i] - b[i]));
    largest = std::max(largest, std::fabs(b[i]));
  }
  return most / largest;
}

template <int D>
void expect_float_follows(Reconstruction reconstruction, double bound) {
  const auto particles = flow<D>(0.0);
  const auto fine = rates<D, double>(particles, reconstruction);
  const auto mixed = rates<D, float>(particles, reconstruction);
  EXPECT_LT(apart(mixed.volume, fine.volume), bound);
  for (std::size_t d = 0; d < D; ++d) EXPECT_LT(apart(mixed.acceleration[d], fine.acceleration[d]), bound);
}

TEST(PairRowsTest, RatesFromFloatPairsAgreeToTheirRounding) {
  // 100 terms of relative rounding 6e-8, which cancel to about a tenth
  expect_float_follows<2>(Reconstruction::unlimited, 2e-5);
  expect_float_follows<3>(Reconstruction::unlimited, 2e-5);
  expect_float_follows<2>(Reconstruction::first_order, 2e-5);
  expect_float_follows<3>(Reconstruction::first_order, 2e-5);
}

TEST(PairRowsTest, RatesFromFloatPairsDoNotDependOnThePlace) {
  // A float position a million spacings away would resolve .06 of a spacing.
  const auto near = rates<3, float>(flow<3>(0.0), Reconstruction::unlimited);
  const auto far = rates<3, float>(flow<3>(1048576.0), Reconstruction::unlimited);
  EXPECT_LT(apart(far.volume, near.volume), 1e-5);
  EXPECT_LT(apart(far.acceleration[0], near.acceleration[0]), 1e-5);
}

TEST(PairRowsTest, AReusedTableKeepsNothingOfTheLastCall) {
  auto particles = flow<2>(0.0);
  PairRows<2, double> rows, fresh;
  const Kernel<2> kernel(4.0);
  NeighborList<2> neighbors(4.0, 0.3);
  neighbors.build(particles);
  rows.pack_states(particles, kernel, 0.0);
  compute_gradients(rows, neighbors);
  for (double& u : particles.u[0]) u *= 2.0;
  for (auto* table : {&rows, &fresh}) {
    table->pack_states(particles, kernel, 0.0);
    compute_gradients(*table, neighbors);
  }
  for (std::size_t i = 0; i < particles.n_owned; ++i)
    for (std::size_t a = 0; a < PairRows<2, double>::k_face_stride; ++a)
      ASSERT_EQ(rows.face(i).q[a], fresh.face(i).q[a]);
}

}  // namespace
}  // namespace littoral::sph
