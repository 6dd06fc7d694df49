#include "littoral/coupler/analytic.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "littoral/coupler/donor_search.hpp"
#include "littoral/error.hpp"

namespace littoral::coupler {
namespace {

RunPlan plan_of(Schedule schedule, double dt = 0.01) {
  RunPlan plan;
  plan.schedule.schedule = schedule;
  plan.window.dt = dt;
  plan.end_time = 1.0;
  plan.with_phi = true;
  return plan;
}

Proposal stable(double dt) {
  Proposal proposal;
  proposal.dt_stable = dt;
  return proposal;
}

/// Divergence of u and residual of the momentum equation with gravity g by central differences.
void expect_solves_navier_stokes(const Flow& flow, double density, double viscosity, double gravity,
                                 double tolerance) {
  const double h = 1e-3;
  for (const Vec3 x : {Vec3{0.13, 0, -0.31}, Vec3{0.71, 0, -0.05}}) {
    const double t = 0.27;
    const auto at = [&](double dx, double dz, double dt) {
      return flow({x[0] + dx, x[1], x[2] + dz}, t + dt);
    };
    const FlowState c = at(0, 0, 0), e = at(h, 0, 0), w = at(-h, 0, 0), n = at(0, h, 0), s = at(0, -h, 0);
    const FlowState later = at(0, 0, h), earlier = at(0, 0, -h);
    EXPECT_NEAR((e.u[0] - w.u[0] + n.u[2] - s.u[2]) / (2 * h), 0.0, tolerance);
    for (std::size_t i : {0, 2}) {
      const double rate = (later.u[i] - earlier.u[i]) / (2 * h);
      const double advection = c.u[0] * (e.u[i] - w.u[i]) / (2 * h) + c.u[2] * (n.u[i] - s.u[i]) / (2 * h);
      const double pressure = (i == 0 ? e.p - w.p : n.p - s.p) / (2 * h * density);
      const double viscous = viscosity * (e.u[i] + w.u[i] + n.u[i] + s.u[i] - 4 * c.u[i]) / (h * h);
      EXPECT_NEAR(rate + advection + pressure - viscous + (i == 2 ? gravity : 0.0), 0.0, tolerance);
    }
  }
}

// The tolerance is the truncation of the differences: h^2 k^3 U with h = 1e-3, k = 2 pi.
TEST(FlowTest, TaylorVortexSolvesNavierStokes) {
  expect_solves_navier_stokes(taylor_vortex(1000.0, 1.0, 1.0, 0.01, {0.5, 0.0, 0.2}), 1000.0, 0.01, 0.0,
                              1e-3);
}
TEST(FlowTest, HydrostaticIsAtRest) {
  expect_solves_navier_stokes(hydrostatic(1000.0, 9.81, 0.2, 5.0), 1000.0, 0.0, 9.81, 1e-9);
  EXPECT_DOUBLE_EQ(hydrostatic(1000.0, 9.81, 0.2, 5.0)({0, 0, 0.2}, 0).p, 5.0);
}
// First order in the amplitude: the residual is its square.
TEST(FlowTest, StandingWaveSolvesTheLinearEquations) {
  const double a = 1e-5;
  const Flow wave = standing_wave(1000.0, 9.81, 1.0, 3.14159, a);
  expect_solves_navier_stokes(wave, 1000.0, 0.0, 9.81, 1e-7);
  EXPECT_NEAR(wave({0.3, 0, -1.0}, 0.4).u[2], 0.0, 1e-18);                   // bottom
  const double eta = -wave({0.3, 0, 0.0}, 0.4).phi;                          // phi = z - eta
  EXPECT_NEAR(wave({0.3, 0, eta}, 0.4).p, 0.0, 1000.0 * 9.81 * 10 * a * a);  // surface
}

TEST(AnalyticFvTest, DonorsCoverWhatIsNeededAndEpochsGrow) {
  auto partner = analytic_fv_partner(uniform_stream({1, 0, 2}, 3.0), plan_of(Schedule::serial), 0.1, 3);
  partner->announce({{0, 0, 0}, {1, 1, 1}}, Box::nothing());
  const auto first = partner->donor_geometry().epoch;
  EXPECT_EQ(partner->targets().size(), 0u);
  const DonorSearch search(partner->donor_geometry(), 3);
  std::int64_t hint = -1;
  EXPECT_TRUE(search.find({0, 0, 0}, hint).found && search.find({1, 1, 1}, hint).found);
  partner->announce(Box::nothing(), {{0, 0, 0}, {1, 1, 1}});
  EXPECT_EQ(partner->donor_geometry().size(), 0u);
  EXPECT_GT(partner->donor_geometry().epoch, first);
  EXPECT_EQ(partner->targets().size(), 10u * 10u * 10u - 6u * 6u * 6u);
}

/// Error of a donor state at the end of a window of length dt.
double error_at_end(Schedule schedule, double dt) {
  const Flow flow = taylor_vortex(1000.0, 1.0, 1.0, 0.01, {0.3, 0, 0});
  auto partner = analytic_fv_partner(flow, plan_of(schedule, dt), 0.1, 2);
  partner->announce({{0, 0, 0}, {1, 0, 1}}, Box::nothing());
  const auto window = partner->agree(stable(1.0)).window;
  DonorValues values;
  partner->receive(window, values);
  const auto& patch = partner->donor_geometry().patches.at(0);
  Donor donor{};
  donor.cell.fill(37);
  donor.weight = {1, 0, 0, 0, 0, 0, 0, 0};
  donor.found = true;
  const Vec3 x{patch.x[37], patch.y[37], patch.z[37]};
  return std::abs(interpolate(values, donor, window.t_end).p - flow(x, window.t_end).p);
}

TEST(AnalyticFvTest, ExtrapolatesWithSecondOrderOrInterpolates) {
  EXPECT_NEAR(std::log2(error_at_end(Schedule::serial, 2e-3) / error_at_end(Schedule::serial, 1e-3)), 2.0,
              0.05);
  EXPECT_LT(error_at_end(Schedule::predicted, 2e-3), 1e-9);
}

TEST(AnalyticFvTest, RunsWindowsToTheEnd) {
  RunPlan plan = plan_of(Schedule::serial, 0.3);
  auto partner = analytic_fv_partner(uniform_stream({1, 0, 0}, 0.0), plan, 0.1, 2);
  int windows = 0;
  for (; !partner->agree(stable(0.1)).stop; ++windows) ASSERT_LT(windows, 10);
  EXPECT_EQ(windows, 4);
  plan.max_windows = 2;
  auto limited = analytic_fv_partner(uniform_stream({1, 0, 0}, 0.0), plan, 0.1, 2);
  for (windows = 0; !limited->agree(stable(0.1)).stop; ++windows) ASSERT_LT(windows, 10);
  EXPECT_EQ(windows, 2);
}

TEST(AnalyticFvTest, RefusesSamplesThatDoNotFit) {
  auto partner = analytic_fv_partner(uniform_stream({1, 0, 0}, 0.0), plan_of(Schedule::serial), 0.25, 2);
  partner->announce(Box::nothing(), {{0, 0, 0}, {1, 0, 1}});
  const auto window = partner->agree(stable(0.1)).window;
  Samples samples;
  samples.resize(partner->targets().size(), true);
  samples.time = window.t_end;
  samples.p[3] = std::nan("");  // uncovered: does not matter
  EXPECT_NO_THROW(partner->send(window, samples));
  samples.status[3] = SampleStatus::ok;
  EXPECT_THROW(partner->send(window, samples), CouplingError);
  samples.p[3] = 0.0;
  samples.time = window.t_begin;
  EXPECT_THROW(partner->send(window, samples), CouplingError);
  samples.time = window.t_end;
  samples.u.pop_back();
  EXPECT_THROW(partner->send(window, samples), CouplingError);
}

TEST(AnalyticSphTest, SamplesAreExactAndDryAboveTheSurface) {
  const Flow flow = hydrostatic(1000.0, 9.81, 0.0, 0.0);
  auto partner = analytic_sph_partner(flow, plan_of(Schedule::serial));
  Targets targets;
  targets.x = {0.0, 0.0};
  targets.y = {0.0, 0.0};
  targets.z = {-1.0, 1.0};
  targets.wants = {wants_state | wants_phi, wants_state | wants_phi};
  partner->offer({}, targets);
  Samples samples;
  partner->receive(partner->agree(stable(0.1)).window, samples);
  EXPECT_EQ(samples.status[0], SampleStatus::ok);
  EXPECT_EQ(samples.status[1], SampleStatus::dry);
  EXPECT_DOUBLE_EQ(samples.p[0], 9810.0);
  EXPECT_DOUBLE_EQ(samples.phi[1], 1.0);
}

}  // namespace
}  // namespace littoral::coupler
