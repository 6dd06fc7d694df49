#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "coupling/check_ledger.hpp"
#include "coupling/particle_exchange.hpp"
#include "coupling_support.hpp"
#include "littoral/error.hpp"

namespace littoral::sph {
namespace {

const LinearEos k_eos{1000.0, 10.0, 0.0};

test::FormulaExterior stream(coupler::Vec3 u) {
  return test::FormulaExterior([u](const coupler::Vec3&, double) {
    return coupler::DonorState{0.0, u, 0.0};
  });
}

template <int D>
double least_spacing(const Particles<D>& particles) {
  double least = 1e30;
  for (std::size_t i = 0; i < particles.n_owned; ++i)
    for (std::size_t j = 0; j < i; ++j) {
      double s = 0.0;
      for (std::size_t d = 0; d < D; ++d) s += std::pow(particles.x[d][i] - particles.x[d][j], 2);
      least = std::min(least, std::sqrt(s));
    }
  return least;
}

template <int D>
void drift(Particles<D>& particles, const Exterior& fv, double t, double dt) {
  for (std::size_t i = 0; i < particles.n_owned; ++i) {
    std::int64_t hint = -1;
    const auto u = from_vec3<D>(fv.at(to_vec3<D>(at<D>(particles.x, i)), t + 0.5 * dt, hint)->u);
    for (std::size_t d = 0; d < D; ++d) particles.x[d][i] += u[d] * dt;
  }
}

/// A stream carries a lattice through the box; what leaves is replaced, the lattice stays a lattice.
template <int D>
void stream_through(Removal removal, double least) {
  const double dx = 0.125;
  const auto layers = test::unit_box<D>(test::all_open<D>(), 0.25, 0.25);
  const auto fv = stream({1.0, 0.0, 0.0});
  Point<D> lower, upper;
  lower.fill(-0.5);
  upper.fill(1.5);
  auto particles = test::lattice<D>(lower, upper, dx, k_eos, fv);
  ParticleExchange<D> exchange(layers, k_eos, dx, removal);
  exchange.start(particles);
  const double row = std::pow(2.0 / dx, D - 1);
  const double n_start = static_cast<double>(particles.n_owned);
  const double dt = 0.15 * dx * 1.01;  // no whole number of steps to a row
  for (int k = 0; k < (D == 2 ? 400 : 100); ++k) {
    drift(particles, fv, 0.0, dt);
    exchange.step(particles, fv, k * dt, dt);
    ASSERT_LE(std::fabs(static_cast<double>(particles.n_owned) - n_start), row);
    const auto ledger = exchange.ledger(particles);
    ASSERT_LT(std::fabs(ledger.defect), 1e-14 * ledger.mass_inside) << "step " << k;
  }
  EXPECT_GT(exchange.counts().injected, row * (D == 2 ? 50 : 10));
  EXPECT_GT(least_spacing(particles), least * dx);
}

TEST(ParticleExchangeTest, StreamKeepsItsLatticeInThePlane) { stream_through<2>(Removal::crossing, 0.99); }
TEST(ParticleExchangeTest, StreamKeepsItsLatticeInSpace) { stream_through<3>(Removal::crossing, 0.99); }
TEST(ParticleExchangeTest, PaperRuleKeepsTheLedgerToo) { stream_through<2>(Removal::nearest, 0.99); }

TEST(ParticleExchangeTest, InjectsWhenTheCentreHasCrossed) {
  const auto layers = test::unit_box<2>({{{true, false}, {false, false}}}, 0.125, 0.375);
  ParticleExchange<2> exchange(layers, k_eos, 0.5, Removal::crossing);
  Particles<2> particles;
  exchange.start(particles);
  const auto fv = stream({1.0, 0.0, 0.0});
  EXPECT_FALSE(exchange.step(particles, fv, 0.0, 0.2)) << "only .4 m0 has entered";
  EXPECT_TRUE(exchange.step(particles, fv, 0.2, 0.2));
  ASSERT_EQ(particles.n_owned, 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(particles.m[i], 250.0);  // rho0 dx^2
    EXPECT_NEAR(particles.x[0][i], -0.5 + 0.15, 1e-12) << "the centre crossed .15 s ago";
    EXPECT_EQ(particles.u[0][i], 1.0);
    EXPECT_EQ(particles.zone[i], Zone::driven);
  }
  EXPECT_NEAR(exchange.elements().mass(0), -50.0, 1e-9);
}

TEST(ParticleExchangeTest, PaperRuleInjectsAtReferenceMass) {
  const auto layers = test::unit_box<2>({{{true, false}, {false, false}}}, 0.125, 0.375);
  ParticleExchange<2> exchange(layers, k_eos, 0.5, Removal::nearest);
  Particles<2> particles;
  exchange.start(particles);
  const auto fv = stream({1.0, 0.0, 0.0});
  EXPECT_FALSE(exchange.step(particles, fv, 0.0, 0.4)) << "only .8 m0 has entered";
  EXPECT_TRUE(exchange.step(particles, fv, 0.4, 0.2));
  ASSERT_EQ(particles.n_owned, 2u);
  EXPECT_NEAR(particles.x[0][0], -0.5 + 0.35, 1e-12);
  EXPECT_NEAR(exchange.elements().mass(0), 50.0, 1e-9);
}

/// Water that moves up and down through a face: particles and water agree to half a row, all the time.
TEST(ParticleExchangeTest, MovingColumnKeepsItsNumberToHalfARow) {
  const double dx = 0.125, amplitude = 3.3 * dx, omega = 1.0;
  const auto layers = test::unit_box<2>({{{true, false}, {false, false}}}, 0.25, 0.25);
  const test::FormulaExterior fv([&](const coupler::Vec3&, double t) {
    return coupler::DonorState{0.0, {-amplitude * omega * std::sin(omega * t), 0.0, 0.0}, 0.0};
  });
  auto particles = test::lattice<2>({-0.5, 0.0}, {1.0, 1.0}, dx, k_eos, fv);
  ParticleExchange<2> exchange(layers, k_eos, dx, Removal::crossing);
  exchange.start(particles);
  const double row = 1.0 / dx, start = static_cast<double>(particles.n_owned);
  const double dt = 0.05;
  for (int k = 0; k < 400; ++k) {
    drift(particles, fv, k * dt, dt);
    exchange.step(particles, fv, k * dt, dt);
    const double water = start + row * amplitude * (std::cos(omega * (k + 1) * dt) - 1.0) / dx;
    // what a step carries may still be on its way
    const double step = amplitude * omega * dt / dx;
    ASSERT_LE(std::fabs(static_cast<double>(particles.n_owned) - water), (0.5 + step) * row) << "step " << k;
  }
  EXPECT_GT(exchange.counts().injected, 15 * static_cast<std::int64_t>(row));
  EXPECT_GT(least_spacing(particles), 0.9 * dx);
}

TEST(ParticleExchangeTest, AvoidsAnOccupiedPlace) {
  const auto layers = test::unit_box<2>({{{true, false}, {false, false}}}, 0.25, 0.25);
  ParticleExchange<2> exchange(layers, k_eos, 0.5, Removal::crossing);
  Particles<2> particles;
  particles.append({{-0.25, 0.25}, {0.0, 0.0}, 0.25, 250.0, 0.0, Zone::driven});
  exchange.start(particles);
  exchange.step(particles, stream({1.0, 0.0, 0.0}), 0.0, 0.5);
  ASSERT_EQ(particles.n_owned, 3u);
  EXPECT_GE(least_spacing(particles), 0.6 * 0.5);
}

TEST(ParticleExchangeTest, WaitsUntilThereIsRoom) {
  const auto layers = test::unit_box<2>({{{true, false}, {false, false}}}, 0.25, 0.25);
  ParticleExchange<2> exchange(layers, k_eos, 1.0, Removal::crossing);
  Particles<2> particles;
  for (double x : {-0.25, 0.25}) particles.append({{x, 0.5}, {0.0, 0.0}, 1.0, 1000.0, 0.0, Zone::driven});
  exchange.start(particles);
  EXPECT_FALSE(exchange.step(particles, stream({1.0, 0.0, 0.0}), 0.0, 1.2));
  EXPECT_DOUBLE_EQ(exchange.elements().mass(0), 1200.0);
  EXPECT_TRUE(exchange.step(particles, stream({1.0, 0.0, 0.0}), 1.2, 1.0)) << "not for more than 2 m0";
}

TEST(ParticleExchangeTest, OutflowDoesNotInjectWhatLeftBesideItsElement) {
  const auto layers = test::unit_box<2>({{{true, false}, {false, false}}}, 0.25, 0.25);
  ParticleExchange<2> exchange(layers, k_eos, 0.25, Removal::crossing);
  Particles<2> particles;  // both leave through the lowest element; the next one's flux counted one of them
  for (double z : {0.1, 0.2}) particles.append({{-0.51, z}, {0.0, 0.0}, 0.0625, 62.5, 0.0, Zone::driven});
  exchange.start(particles);
  exchange.step(particles, stream({-1.0, 0.0, 0.0}), 0.0, 0.25);
  EXPECT_EQ(particles.n_owned, 0u);
  EXPECT_NEAR(exchange.elements().mass(0), 0.0, 1e-12);
  EXPECT_EQ(exchange.counts().injected, 0);
}

TEST(ParticleExchangeTest, CreditsTheElementThatAParticleCrossed) {
  const auto layers = test::unit_box<2>({{{true, false}, {false, false}}}, 0.25, 0.25);
  ParticleExchange<2> exchange(layers, k_eos, 0.5, Removal::crossing);
  Particles<2> particles;
  particles.append({{-0.51, 0.7}, {0.0, 0.0}, 0.1, 100.0, 0.0, Zone::driven});
  particles.append({{-0.49, 0.7}, {0.0, 0.0}, 0.1, 100.0, 0.0, Zone::driven});
  exchange.start(particles);
  EXPECT_TRUE(exchange.step(particles, stream({0.0, 0.0, 0.0}), 0.0, 1.0));
  EXPECT_EQ(particles.n_owned, 1u);
  EXPECT_EQ(exchange.elements().mass(1), 100.0);
  EXPECT_EQ(exchange.elements().mass(0), 0.0);
  EXPECT_EQ(exchange.counts().removed_crossing, 1);
}

TEST(ParticleExchangeTest, PaperRuleTakesTheNearestBelowMinusReferenceMass) {
  const auto layers = test::unit_box<2>({{{true, false}, {false, false}}}, 0.25, 0.25);
  ParticleExchange<2> exchange(layers, k_eos, 1.0, Removal::nearest);
  Particles<2> particles;
  particles.append({{-0.1, 0.25}, {0.0, 0.0}, 0.25, 1000.0, 0.0, Zone::driven});
  particles.append({{-0.4, 0.25}, {0.0, 0.0}, 0.25, 1000.0, 0.0, Zone::driven});
  exchange.start(particles);
  const auto fv = stream({-1.0, 0.0, 0.0});
  EXPECT_FALSE(exchange.step(particles, fv, 0.0, 0.6));
  EXPECT_TRUE(exchange.step(particles, fv, 0.6, 0.6));
  ASSERT_EQ(particles.n_owned, 1u);
  EXPECT_EQ(particles.x[0][0], -0.1);
  EXPECT_EQ(exchange.counts().removed_nearest, 1);
}

TEST(ParticleExchangeTest, LedgerClosesUnderRandomFlow) {
  // Random sheared, unsteady flows in and out through all faces: whatever happens, no mass is made.
  std::mt19937 random(20240229);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  const double dx = 0.125;
  const auto layers = test::unit_box<2>(test::all_open<2>(), 0.25, 0.25);
  for (const Removal removal : {Removal::crossing, Removal::nearest})
    for (int run = 0; run < 5; ++run) {
      std::array<double, 9> a;
      for (double& c : a) c = any(random);
      const test::FormulaExterior fv([a](const coupler::Vec3& x, double t) {
        return coupler::DonorState{
            5.0 * a[0] * x[0],
            {a[1] + a[2] * std::sin(9 * t + 4 * x[2]), 0.0, a[3] + a[4] * x[0] + a[5] * std::cos(7 * t)},
            0.0};
      });
      auto particles = test::lattice<2>({-0.5, -0.5}, {1.5, 1.5}, dx, k_eos, fv);
      ParticleExchange<2> exchange(layers, k_eos, dx, removal);
      exchange.start(particles);
      const double dt = 0.3 * dx;
      for (int k = 0; k < 150; ++k) {
        drift(particles, fv, k * dt, dt);
        exchange.step(particles, fv, k * dt, dt);
      }
      const auto ledger = exchange.ledger(particles);
      // hundreds of masses of order 16 kg added: compensated, so a few units in the last place of the total
      EXPECT_LT(std::fabs(ledger.defect), 1e-15 * 4000.0 * 4);
      EXPECT_GT(ledger.n_injected + ledger.n_removed, 100.0);
      EXPECT_NO_THROW(check_ledger(ledger, 0.0));
    }
}

TEST(ParticleExchangeTest, LedgerNoticesALostParticle) {
  const double dx = 0.125;
  const auto fv = stream({1.0, 0.0, 0.0});
  auto particles = test::lattice<2>({-0.5, -0.5}, {1.5, 1.5}, dx, k_eos, fv);
  ParticleExchange<2> exchange(test::unit_box<2>(test::all_open<2>(), 0.25, 0.25), k_eos, dx,
                               Removal::crossing);
  exchange.start(particles);
  std::vector<char> doomed(particles.n_owned, 0);
  doomed[3] = 1;
  EXPECT_NO_THROW(check_ledger(exchange.ledger(particles), 0.0));
  particles.remove(doomed);
  EXPECT_THROW(check_ledger(exchange.ledger(particles), 0.0), StabilityError);
}

TEST(ParticleExchangeTest, ContinuesFromItsRecord) {
  const double dx = 0.125;
  const auto layers = test::unit_box<2>(test::all_open<2>(), 0.25, 0.25);
  const auto fv = stream({0.7, 0.0, 0.3});
  auto a = test::lattice<2>({-0.5, -0.5}, {1.5, 1.5}, dx, k_eos, fv);
  ParticleExchange<2> one(layers, k_eos, dx, Removal::crossing), two = one;
  one.start(a);
  const double dt = 0.15 * dx;
  const auto go = [&](Particles<2>& particles, ParticleExchange<2>& exchange, int from, int to) {
    for (int k = from; k < to; ++k) {
      drift(particles, fv, 0.0, dt);
      exchange.step(particles, fv, k * dt, dt);
    }
  };
  go(a, one, 0, 40);
  auto b = a;
  two.unpack(one.pack(), one.pack_counts());
  go(a, one, 40, 80);
  go(b, two, 40, 80);
  EXPECT_EQ(a.x, b.x);
  EXPECT_EQ(a.id, b.id);
  EXPECT_EQ(one.pack(), two.pack());
}

}  // namespace
}  // namespace littoral::sph
