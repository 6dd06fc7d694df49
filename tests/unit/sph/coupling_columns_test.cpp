#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "coupling/face_columns.hpp"
#include "coupling/particle_exchange.hpp"
#include "coupling_support.hpp"

namespace littoral::sph {
namespace {

const LinearEos k_eos{1000.0, 10.0, 0.0};
constexpr double k_dx = 0.125;

/// Open to the left, its face eight spacings high.
template <int D>
Layers<D> open_to_the_left() {
  std::array<std::array<bool, 2>, D> open{};
  open[0][0] = true;
  return test::unit_box<D>(open, 2 * k_dx, 2 * k_dx);
}

/// A stream of speed 1 under a level that moves by formula; in the air FV knows nothing.
test::FormulaExterior under(std::function<double(const coupler::Vec3&, double)> level) {
  return test::FormulaExterior(
      [level](const coupler::Vec3& x, double t) -> std::optional<coupler::DonorState> {
        const double phi = x[2] - level(x, t);
        if (phi > 1.5 * k_dx) return std::nullopt;
        return coupler::DonorState{0.0, {1.0, 0.0, 0.0}, phi};
      },
      true);
}

double area(const FaceElements<2>& faces) {
  double sum = 0.0;
  for (std::size_t e = 0; e < faces.size(); ++e) sum += faces[e].area;
  return sum;
}

TEST(FaceColumnsTest, RowsDivideTheDepthEvenlyAndCarryItsFlux) {
  FaceElements<2> faces(open_to_the_left<2>(), k_dx, FaceRows::level);
  const double level = 0.66;  // 5.3 spacings: five rows
  faces.integrate(under([&](const auto&, double) { return level; }), k_eos, 0.0, 0.1);
  EXPECT_NEAR(area(faces), level, 1e-12);
  EXPECT_NEAR(faces.flux(), 1000.0 * level * 0.1, 1e-9) << "(19), whatever the rows";
  for (std::size_t e = 0; e < 5; ++e) {
    EXPECT_NEAR(faces[e].centre[1], level * (0.2 * static_cast<double>(e) + 0.1), 1e-12);
    EXPECT_NEAR(faces[e].share, level / 5 / k_dx, 1e-12) << "a particle has the mass of its row";
  }
  for (std::size_t e = 5; e < 8; ++e) EXPECT_EQ(faces.mass(e), 0.0);
  EXPECT_EQ(faces.crossed({-0.6, 0.01}), 0u);
  EXPECT_EQ(faces.crossed({-0.6, level - 0.01}), 4u);
  EXPECT_EQ(faces.crossed({-0.6, 0.9}), 4u) << "spray: through the row on top";
}

TEST(FaceColumnsTest, NumberOfRowsStaysWhileTheLevelMovesLittle) {
  EXPECT_EQ(rows_in(5.3, 0), 5u);
  EXPECT_EQ(rows_in(5.74, 5), 5u);
  EXPECT_EQ(rows_in(5.76, 5), 6u);
  EXPECT_EQ(rows_in(5.3, 6), 6u);
  EXPECT_EQ(rows_in(41.1, 40), 40u) << "by a tenth of the rows that move";
  EXPECT_EQ(rows_in(41.3, 40), 41u);
  EXPECT_EQ(rows_in(0.1, 0), 1u);
}

TEST(FaceColumnsTest, MassOfARowThatEndsStaysInTheColumn) {
  FaceElements<2> faces(open_to_the_left<2>(), k_dx, FaceRows::level);
  double level = 0.9;
  const auto fv = under([&](const auto&, double) { return level; });
  faces.integrate(fv, k_eos, 0.0, 0.1);
  const double before = faces.total_mass();
  level = 0.3;
  faces.integrate(fv, k_eos, 0.1, 0.1);
  EXPECT_NEAR(faces.total_mass(), before + 30.0, 1e-9);
  for (std::size_t e = 2; e < 8; ++e) EXPECT_EQ(faces.mass(e), 0.0);
}

TEST(FaceColumnsTest, TilesStandWhereWaterDoesNotLieUnderAir) {
  FaceElements<2> fixed(open_to_the_left<2>(), k_dx, FaceRows::fixed),
      faces(open_to_the_left<2>(), k_dx, FaceRows::level);
  const auto same_as_tiles = [&](const Exterior& fv, const char* what) {
    faces.integrate(fv, k_eos, 0.0, 0.1);
    fixed.integrate(fv, k_eos, 0.0, 0.1);
    for (std::size_t e = 0; e < faces.size(); ++e) {
      EXPECT_EQ(faces[e].centre, fixed[e].centre) << what;
      EXPECT_EQ(faces[e].area, fixed[e].area) << what;
    }
  };
  faces.integrate(under([](const auto&, double) { return 0.6; }), k_eos, 0.0, 0.0);
  same_as_tiles(under([](const auto&, double) { return 2.0; }), "full");
  same_as_tiles(under([](const auto&, double) { return 0.03; }), "dry at its foot");
  const test::FormulaExterior jet(
      [](const coupler::Vec3& x, double) {
        return coupler::DonorState{0.0, {1.0, 0.0, 0.0}, std::fabs(x[2] - 0.5) < 0.2 ? 0.1 : -0.1};
      },
      true);
  same_as_tiles(jet, "overturning");
}

/// What enters under a level that rises and sinks, seen from the last particle of each column that entered.
template <int D>
void rows_follow(FaceRows rows, double& worst, double& number) {
  const auto level = [](const coupler::Vec3&, double t) { return 0.75 + 0.06 * std::sin(3.0 * t); };
  const auto fv = under(level);
  ParticleExchange<D> exchange(open_to_the_left<D>(), k_eos, k_dx, Removal::crossing, rows);
  Particles<D> particles;
  exchange.start(particles);
  worst = 0.0;
  std::set<std::size_t> rows_born;
  const double dt = 0.1 * k_dx;
  for (int k = 0; k < 400; ++k) {
    const std::size_t before = particles.n_owned;
    for (std::size_t i = 0; i < particles.n_owned; ++i) particles.x[0][i] += dt;
    exchange.step(particles, fv, k * dt, dt);
    const auto ledger = exchange.ledger(particles);
    ASSERT_LT(std::fabs(ledger.defect), 1e-13 * (1.0 + ledger.mass_inside));
    if (particles.n_owned == before) continue;
    double top = 0.0, V = 0.0;
    for (std::size_t i = before; i < particles.n_owned; ++i)
      if (particles.x[D - 1][i] > top) top = particles.x[D - 1][i], V = particles.V[i];
    rows_born.insert((particles.n_owned - before));
    const double height = V / std::pow(k_dx, D - 1);
    worst = std::max(worst, std::fabs(top + 0.5 * height - level({}, (k + 0.5) * dt)) / k_dx);
  }
  number = static_cast<double>(rows_born.size());
}

TEST(FaceColumnsTest, ParticlesEnterUnderTheLevelOfTheMoment) {
  double worst = 0.0, number = 0.0;
  rows_follow<2>(FaceRows::level, worst, number);
  EXPECT_LT(worst, 0.01);
  EXPECT_EQ(number, 1.0) << "as many in every column";
  rows_follow<3>(FaceRows::level, worst, number);
  EXPECT_LT(worst, 0.01);
  rows_follow<2>(FaceRows::fixed, worst, number);
  EXPECT_GT(worst, 0.3);
  EXPECT_GT(number, 1.0);
}

TEST(FaceColumnsTest, ContinueFromTheirRecord) {
  // the level has come from where its depth is six rows to where it would be seven from a fresh start
  const auto fv = under([](const auto&, double t) { return std::min(0.75 + 0.02 * t, 0.82); });
  FaceElements<2> whole(open_to_the_left<2>(), k_dx, FaceRows::level);
  for (int k = 0; k < 40; ++k) whole.integrate(fv, k_eos, 0.1 * k, 0.1);
  FaceElements<2> half(open_to_the_left<2>(), k_dx, FaceRows::level), fresh = half;
  half.unpack(whole.pack());
  for (auto* faces : {&whole, &half, &fresh}) faces->integrate(fv, k_eos, 4.0, 0.1);
  EXPECT_EQ(whole.pack(), half.pack());
  EXPECT_EQ(whole[5].centre, half[5].centre);
  EXPECT_NE(whole[5].centre, fresh[5].centre) << "their number of rows is part of the record";
}

}  // namespace
}  // namespace littoral::sph
