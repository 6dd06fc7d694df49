#include <gtest/gtest.h>

#include <cmath>

#include "coupling_open_box.hpp"

namespace littoral::sph {
namespace {

using test::OpenBox;

/// (C6 with an exact partner) Nothing changes in a uniform stream, however many particles come and go.
template <int D>
void stream_stays_uniform(int windows, coupler::Schedule schedule, int substeps) {
  const coupler::Vec3 u = {0.8, 0.0, 0.6};
  OpenBox<D> box(coupler::uniform_stream(u, 0.0), schedule, substeps);
  const double n_start = static_cast<double>(box.particles.n_owned);
  const double t = box.run(windows);
  EXPECT_GT(box.driver->ledger().n_injected, 0.0);
  EXPECT_GT(box.driver->ledger().n_removed, 0.0);
  EXPECT_LT(std::fabs(box.driver->ledger().defect), 1e-14 * box.driver->ledger().mass_inside);
  double u_rms = 0.0, p_rms = 0.0;
  for (std::size_t i = 0; i < box.particles.n_owned; ++i) {
    for (std::size_t d = 0; d < D; ++d) u_rms += std::pow(box.particles.u[d][i] - u[space_axis<D>(d)], 2);
    p_rms += std::pow(box.particles.p[i], 2);
  }
  const double n = static_cast<double>(box.particles.n_owned);
  EXPECT_LT(std::sqrt(u_rms / n), 1e-3) << "at t = " << t;
  EXPECT_LT(std::sqrt(p_rms / n), 0.005);
  // a row of the two faces that the stream enters may be due or just come
  EXPECT_LT(std::fabs(n - n_start), 2.5 * std::pow(n_start, (D - 1.0) / D));
}

TEST(WindowDriverTest, StreamStaysUniformInThePlane) {
  stream_stays_uniform<2>(80, coupler::Schedule::serial, 1);
}
TEST(WindowDriverTest, StreamStaysUniformInSpace) {
  stream_stays_uniform<3>(16, coupler::Schedule::serial, 1);
}
TEST(WindowDriverTest, StreamStaysUniformInLongIteratedWindows) {
  stream_stays_uniform<2>(8, coupler::Schedule::iterated, 5);
}

TEST(WindowDriverTest, AParticleFarOutsideIsTakenOutAndCounted) {
  OpenBox<2> box(coupler::uniform_stream({0.8, 0.0, 0.6}, 0.0), coupler::Schedule::serial, 1);
  box.run(2);
  const auto before = box.driver->hooks().exchange().counts().removed_through[1];
  std::size_t furthest = 0;
  for (std::size_t i = 0; i < box.particles.n_owned; ++i)
    if (box.particles.x[0][i] > box.particles.x[0][furthest]) furthest = i;
  box.particles.x[0][furthest] += 1.9 * box.dx;  // through the outer face, as a wild shift or splash would
  box.dynamics->forget_lists();
  box.run(1);
  EXPECT_GT(box.driver->hooks().exchange().counts().removed_through[1], before);
  EXPECT_LT(std::fabs(box.driver->ledger().defect), 1e-14 * box.driver->ledger().mass_inside);
}

TEST(WindowDriverTest, StreamStaysUniformAtAnyPressure) {
  constexpr double level = 5.0;  // 10 rho U^2
  OpenBox<2> box(coupler::uniform_stream({0.8, 0.0, 0.6}, level), coupler::Schedule::serial, 1);
  box.run(40);
  ASSERT_GT(box.driver->ledger().n_injected, 0.0);
  for (std::size_t i = 0; i < box.particles.n_owned; ++i) {
    ASSERT_NEAR(box.particles.u[0][i], 0.8, 1e-12);
    ASSERT_NEAR(box.particles.p[i], level, 1e-11);
  }
}

TEST(WindowDriverTest, AnIteratedWindowEndsAsASerialOneOnEqualDonors) {
  // A steady flow has the same donors in every pass: what the first pass did must be undone completely.
  const auto flow = coupler::taylor_vortex(1.0, 0.5, 0.8, 0.0, {1.0, 0.0, 0.0});
  const auto frozen = [flow](const coupler::Vec3& x, double) { return flow(x, 0.0); };
  OpenBox<2> serial(frozen, coupler::Schedule::serial, 3), iterated(frozen, coupler::Schedule::iterated, 3);
  serial.run(12);
  iterated.run(12);
  ASSERT_GT(serial.driver->ledger().n_injected, 0.0);
  ASSERT_EQ(serial.particles.n_owned, iterated.particles.n_owned);
  EXPECT_EQ(serial.driver->ledger().mass_flux, iterated.driver->ledger().mass_flux);
  // the same particles, in another order: sums differ by round-off
  std::vector<double> of_id(static_cast<std::size_t>(serial.particles.next_id), std::nan(""));
  for (std::size_t i = 0; i < serial.particles.n_owned; ++i)
    of_id[static_cast<std::size_t>(serial.particles.id[i])] = serial.particles.p[i];
  for (std::size_t i = 0; i < iterated.particles.n_owned; ++i)
    EXPECT_NEAR(iterated.particles.p[i], of_id[static_cast<std::size_t>(iterated.particles.id[i])], 1e-10);
}

}  // namespace
}  // namespace littoral::sph
