#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "coupling/partner_choice.hpp"
#include "coupling/window_driver.hpp"
#include "coupling_support.hpp"
#include "littoral/coupler/analytic.hpp"
#include "littoral/support/run_plan.hpp"

namespace littoral::sph {
namespace {

constexpr double k_dx = 0.0625;

/// A box open on all sides in a larger domain of water, c = 10.
template <int D>
struct OpenBox {
  support::Scene scene;
  Numerics<D> numerics;
  DomainBox<D> domain;
  CouplingConfig config;
  std::unique_ptr<coupler::FvPartner> partner;
  std::unique_ptr<WindowDriver<D>> driver;
  std::unique_ptr<Dynamics<D>> dynamics;
  Particles<D> particles;

  OpenBox(const coupler::Flow& flow, coupler::Schedule schedule, int substeps) {
    const double R = (D == 2 ? 4.0 : 2.7) * k_dx;
    const double layer = (D == 2 ? 4.0 : 3.0) * k_dx;
    scene.dimension = D;
    scene.fluid.density = 1.0;
    scene.fluid.sound_speed = 10.0;
    scene.domain.lower = {-2.0, -2.0, -2.0};
    scene.domain.upper = {3.0, 3.0, 3.0};
    scene.coupling.kind = support::Scene::CouplingKind::imposed;
    scene.coupling.blending_width = layer;
    scene.coupling.driven_width = layer;
    scene.coupling.schedule.schedule = schedule;
    scene.coupling.window.substeps = substeps;
    scene.time.end = 100.0;
    support::Scene::Region region;
    region.lower = {0.0, 0.0, 0.0};
    const double inner = (D == 2 ? 8.0 : 3.0) * k_dx;
    region.upper = {inner, inner, inner};
    scene.regions = {region};

    numerics.eos = {1.0, 10.0, 0.0};
    numerics.spacing = k_dx;
    numerics.kernel_radius = R;
    numerics.skin = 0.1 * R;
    numerics.reference_velocity = 1.0;
    domain.lower.fill(-2.0);
    domain.upper.fill(3.0);
    for (auto& side : domain.sides) side = {support::Scene::Side::open, support::Scene::Side::open};

    partner = coupler::analytic_fv_partner(flow, support::run_plan(scene), k_dx, D);
    driver = std::make_unique<WindowDriver<D>>(scene, config, numerics, *partner);
    dynamics = std::make_unique<Dynamics<D>>(numerics, domain);
    const test::FormulaExterior exact([flow](const coupler::Vec3& x, double t) {
      const auto state = flow(x, t);
      return coupler::DonorState{state.p, state.u, state.phi};
    });
    const auto& box = driver->layers().boxes()[0];
    particles = test::lattice<D>(box.outer_lower, box.outer_upper, k_dx, numerics.eos, exact);
    driver->begin(particles);
    driver->announce(particles);
  }

  double run(int windows) {
    double t = 0.0;
    for (int k = 0; k < windows; ++k) {
      coupler::Proposal proposal;
      proposal.dt_stable = dynamics->stable_time_step();
      const auto agreement = partner->agree(proposal);
      driver->advance(agreement, particles, *dynamics);
      t = agreement.window.t_end;
    }
    return t;
  }
};

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
