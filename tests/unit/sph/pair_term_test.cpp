#include <gtest/gtest.h>

#include "clouds.hpp"
#include "physics/riemann.hpp"
#include "physics/riemann_fluxes.hpp"

namespace littoral::sph {
namespace {

constexpr double k_round_off = 1e-13;
constexpr double k_c = 12.0;

TEST(PairTermTest, EqualStatesGiveThatState) {
  const FaceState face = riemann_state(1.1, 0.3, 7.0, 1.1, 0.3, 7.0, k_c);
  EXPECT_NEAR(face.u, 0.3, k_round_off);
  EXPECT_NEAR(face.p, 7.0, 7.0 * k_round_off);
}

TEST(PairTermTest, MirrorStateIsAWall) {
  const double rho = 1.3, u = 0.4, p = 5.0;
  const FaceState face = riemann_state(rho, u, p, rho, -u, p, k_c);
  EXPECT_NEAR(face.u, 0.0, k_round_off);
  EXPECT_NEAR(face.p, p + rho * k_c * u, 1e2 * k_round_off);
}

TEST(PairTermTest, LowDissipationAnswersSmallJumpsWeaklyAndLargeOnesFully) {
  const auto face_pressure = [](double closing) {
    return riemann_state<RiemannSolver::low_dissipation>(1.0, closing, 5.0, 1.0, 0.0, 5.0, k_c).p;
  };
  EXPECT_NEAR(face_pressure(0.1) - 5.0, 0.5 * 3.0 * 0.1 * 0.1, k_round_off * 1e2);
  EXPECT_NEAR(face_pressure(5.0) - 5.0, 0.5 * k_c * 5.0, k_round_off * 1e2);  // as (12)
  EXPECT_NEAR(face_pressure(-0.1), 5.0, k_round_off * 1e2);
}

TEST(PairTermTest, SwappingSidesMirrorsTheFaceState) {
  const FaceState one = riemann_state(1.3, 0.4, 5.0, 0.9, -0.1, 3.0, k_c);
  const FaceState other = riemann_state(0.9, 0.1, 3.0, 1.3, -0.4, 5.0, k_c);
  EXPECT_NEAR(one.u, -other.u, k_round_off);
  EXPECT_NEAR(one.p, other.p, 1e2 * k_round_off);
}

TEST(PairTermTest, LimitedDifferencesKeepLinearData) {
  EXPECT_DOUBLE_EQ(limited_difference<Reconstruction::unlimited>(0.7, 0.7), 0.7);
  EXPECT_DOUBLE_EQ(limited_difference<Reconstruction::minmod>(0.7, 0.7), 0.7);
  EXPECT_DOUBLE_EQ(limited_difference<Reconstruction::van_leer>(0.7, 0.7), 0.7);
  EXPECT_EQ(limited_difference<Reconstruction::first_order>(0.7, 0.7), 0.0);
}

TEST(PairTermTest, LimitersVanishAtExtremaAndForConstants) {
  EXPECT_EQ(limited_difference<Reconstruction::minmod>(0.0, 0.5), 0.0);  // upwind -.5 across .5
  EXPECT_EQ(limited_difference<Reconstruction::van_leer>(0.0, 0.5), 0.0);
  EXPECT_EQ(limited_difference<Reconstruction::van_leer>(0.0, 0.0), 0.0);
}

/// A free cloud with random states: nothing outside acts on it.
template <int D>
Particles<D> random_states(const std::array<int, D>& n) {
  auto particles = test::cloud<D>(n, 1.0, 0.35);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  for (std::size_t i = 0; i < particles.n_owned; ++i) {
    for (auto& column : particles.u) column[i] = value(random);
    particles.V[i] = 1.0 + 0.1 * value(random);
    particles.rho[i] = particles.m[i] / particles.V[i];
    particles.p[i] = 20.0 * value(random);
  }
  return particles;
}

struct Budget {
  double scale = 0.0;  // sum of |m a| (|x| + 1), what round-off is measured against
  std::array<double, 3> momentum{};
  std::array<double, 3> angular{};
};

template <int D>
Budget budget(const Particles<D>& particles, const Rate<D>& rate) {
  Budget sum;
  for (std::size_t i = 0; i < particles.n_owned; ++i) {
    std::array<double, 3> x{}, f{};
    for (std::size_t d = 0; d < D; ++d) {
      x[d] = particles.x[d][i];
      f[d] = particles.m[i] * rate.acceleration[d][i];
      sum.momentum[d] += f[d];
      sum.scale += std::fabs(f[d]) * (1.0 + std::fabs(x[d]));
    }
    for (std::size_t d = 0; d < 3; ++d)
      sum.angular[d] += x[(d + 1) % 3] * f[(d + 2) % 3] - x[(d + 2) % 3] * f[(d + 1) % 3];
  }
  return sum;
}

template <int D>
void expect_conservation(const std::array<int, D>& n) {
  const auto particles = random_states<D>(n);
  NeighborList<D> neighbors(2.7, 0.2);
  neighbors.build(particles);
  Gradients<D> gradients;
  compute_gradients(particles, neighbors, gradients);
  const LinearEos eos{1.0, k_c, 0.0};
  for (auto solver : {RiemannSolver::linearised, RiemannSolver::low_dissipation})
    for (auto reconstruction : {Reconstruction::first_order, Reconstruction::unlimited,
                                Reconstruction::minmod, Reconstruction::van_leer}) {
      Rate<D> rate;
      riemann_fluxes(particles, neighbors, gradients, eos, reconstruction, solver, rate);
      const Budget sum = budget(particles, rate);
      for (std::size_t d = 0; d < 3; ++d) {
        EXPECT_LE(std::fabs(sum.momentum[d]), k_round_off * sum.scale);
        EXPECT_LE(std::fabs(sum.angular[d]), k_round_off * sum.scale);
      }
    }
}

TEST(RiemannFluxesTest, KeepMomentumAndAngularMomentumIn2D) { expect_conservation<2>({14, 11}); }
TEST(RiemannFluxesTest, KeepMomentumAndAngularMomentumIn3D) { expect_conservation<3>({7, 6, 6}); }

TEST(RiemannFluxesTest, TwoParticlesSeeTheFormula) {
  Particles<2> particles = test::cloud<2>({2, 1}, 1.0);
  particles.u[0] = {0.3, -0.2};
  particles.p = {2.0, 5.0};
  particles.rho = {1.1, 0.9};
  particles.V = {1.0, 1.2};
  NeighborList<2> neighbors(2.7, 0.1);
  neighbors.build(particles);
  const LinearEos eos{1.0, k_c, 0.5};
  Rate<2> rate;
  riemann_fluxes(particles, neighbors, {}, eos, Reconstruction::first_order, RiemannSolver::linearised, rate);
  const FaceState face = riemann_state(1.1, 0.3, 2.0, 0.9, -0.2, 5.0, k_c);
  const double s = 1.0 / 2.7, A = 7.0 / (3.14159265358979323846 * 2.7 * 2.7);
  const double slope = -20.0 * A * s * std::pow(1.0 - s, 3) / 2.7;  // dW/dr at r = 1; grad_i W = -slope e_x
  EXPECT_NEAR(rate.volume[0], 2.0 * 1.0 * 1.2 * (face.u - 0.3) * -slope, k_round_off);
  EXPECT_NEAR(rate.acceleration[0][0], -2.0 * 1.0 * 1.2 * (face.p - 0.5) * -slope / particles.m[0],
              1e1 * k_round_off);
  EXPECT_NEAR(rate.acceleration[1][0], 0.0, k_round_off);
}

TEST(RiemannFluxesTest, UniformStateAwayFromTheEdgeIsAtRest) {
  auto particles = test::cloud<2>({15, 15}, 1.0);  // a lattice: sum V grad W vanishes by symmetry
  for (std::size_t i = 0; i < particles.n_owned; ++i) particles.u[0][i] = 3.0, particles.p[i] = 4.0;
  NeighborList<2> neighbors(4.0, 0.1);
  neighbors.build(particles);
  Gradients<2> gradients;
  compute_gradients(particles, neighbors, gradients);
  Rate<2> rate;
  riemann_fluxes(particles, neighbors, gradients, {1.0, k_c, 0.0}, Reconstruction::unlimited,
                 RiemannSolver::linearised, rate);
  const std::size_t centre = 7 * 15 + 7;
  EXPECT_NEAR(rate.volume[centre], 0.0, k_round_off);
  EXPECT_NEAR(rate.acceleration[0][centre], 0.0, k_round_off);
}

}  // namespace
}  // namespace littoral::sph
