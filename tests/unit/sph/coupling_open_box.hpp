#pragma once

#include <memory>

#include "coupling/window_driver.hpp"
#include "coupling_support.hpp"
#include "littoral/coupler/analytic.hpp"
#include "littoral/support/run_plan.hpp"

namespace littoral::sph::test {

/// A box open on all sides in a larger domain of water, c = 10.
template <int D>
struct OpenBox {
  double dx = 0.0625;
  support::Scene scene;
  Numerics<D> numerics;
  DomainBox<D> domain;
  CouplingConfig config;
  std::unique_ptr<coupler::FvPartner> partner;
  std::unique_ptr<WindowDriver<D>> driver;
  std::unique_ptr<Dynamics<D>> dynamics;
  Particles<D> particles;

  OpenBox(const coupler::Flow& flow, coupler::Schedule schedule, int substeps, double start_time = 0.0) {
    const double R = (D == 2 ? 4.0 : 2.7) * dx;
    const double layer = (D == 2 ? 4.0 : 3.0) * dx;
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
    const double inner = (D == 2 ? 8.0 : 3.0) * dx;
    region.upper = {inner, inner, inner};
    scene.regions = {region};

    numerics.eos = {1.0, 10.0, 0.0};
    numerics.spacing = dx;
    numerics.kernel_radius = R;
    numerics.skin = 0.1 * R;
    numerics.reference_velocity = 1.0;
    domain.lower.fill(-2.0);
    domain.upper.fill(3.0);
    for (auto& side : domain.sides) side = {support::Scene::Side::open, support::Scene::Side::open};

    partner = coupler::analytic_fv_partner(flow, support::run_plan(scene, start_time), dx, D);
    driver = std::make_unique<WindowDriver<D>>(scene, config, numerics, *partner);
    dynamics = std::make_unique<Dynamics<D>>(numerics, domain);
    const FormulaExterior exact([flow](const coupler::Vec3& x, double t) {
      const auto state = flow(x, t);
      return coupler::DonorState{state.p, state.u, state.phi};
    });
    const auto& box = driver->layers().boxes()[0];
    particles = lattice<D>(box.outer_lower, box.outer_upper, dx, numerics.eos, exact);
    driver->begin(particles);
    driver->announce(particles);
  }

  /// Returns the time reached.
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

}  // namespace littoral::sph::test
