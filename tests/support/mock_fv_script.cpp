#include <cmath>
#include <cstdio>

#include "clip.hpp"
#include "littoral/error.hpp"
#include "mock.hpp"

namespace littoral::mock {

using namespace coupler;

namespace {

Targets targets_of(const Box& part, const Script& script) {
  Targets targets;
  const DonorPatch cells = lattice(part, script.spacing, script.dimension);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Vec3 x{cells.x[i], cells.y[i], cells.z[i]};
    if (!script.region.contains(x)) continue;
    targets.x.push_back(x[0]);
    targets.y.push_back(x[1]);
    targets.z.push_back(x[2]);
    targets.wants.push_back(
        static_cast<std::uint8_t>(script.with_phi ? wants_state | wants_phi : wants_state));
  }
  return targets;
}

void fill(const DonorGeometry& geometry, const Window& window, const Script& script, DonorValues& donors) {
  donors.resize(geometry.size(), script.with_phi);
  donors.time = donors.horizon_begin = window.t_begin;
  donors.horizon_end = window.t_end;
  std::size_t c = 0;
  for (const auto& patch : geometry.patches)
    for (std::size_t i = 0; i < patch.size(); ++i, ++c) {
      const Vec3 x{patch.x[i], patch.y[i], patch.z[i]};
      const FlowState now = flow(script, x, window.t_begin), later = flow(script, x, window.t_begin + 1.0);
      donors.p[c] = now.p;
      donors.u[c] = now.u[0];
      donors.v[c] = now.u[1];
      donors.w[c] = now.u[2];
      donors.dp_dt[c] = later.p - now.p;
      donors.du_dt[c] = later.u[0] - now.u[0];
      donors.dv_dt[c] = later.u[1] - now.u[1];
      donors.dw_dt[c] = later.u[2] - now.u[2];
      if (!script.with_phi) continue;
      donors.phi[c] = now.phi;
      donors.dphi_dt[c] = later.phi - now.phi;
    }
}

/// The first cell that the region needs.
std::size_t first_inside(const DonorGeometry& geometry, const Box& region) {
  std::size_t c = 0;
  for (const auto& patch : geometry.patches)
    for (std::size_t i = 0; i < patch.size(); ++i, ++c)
      if (region.contains({patch.x[i], patch.y[i], patch.z[i]})) return c;
  return 0;
}

void check_samples(const Targets& targets, const Samples& samples, const Window& window,
                   const Script& script) {
  const auto differs = [&](double a, double b) { return !(std::abs(a - b) <= script.tolerance); };
  std::size_t uncovered = 0;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    if (samples.status[i] != SampleStatus::ok) {
      ++uncovered;
      continue;
    }
    // a mock evaluates the same formula at the same point: equal to the bit
    const FlowState exact = flow(script, {targets.x[i], targets.y[i], targets.z[i]}, window.t_end);
    if (differs(samples.p[i], exact.p) || differs(samples.u[i], exact.u[0]) ||
        differs(samples.w[i], exact.u[2]) || (!samples.phi.empty() && differs(samples.phi[i], exact.phi)))
      throw CouplingError("a sample differs from the flow");
  }
  if (uncovered > 0) throw CouplingError(std::to_string(uncovered) + " samples are not covered");
}

/// Of particles of a uniform state, in the region and its layers.
double mass_of_particles(const Script& script) {
  const auto& fluid = script.scene->fluid;
  double mass =
      fluid.density + flow(script, script.layers.lower, 0.0).p / (fluid.sound_speed * fluid.sound_speed);
  for (std::size_t d = 0; d < 3; ++d)
    if (script.scene->active(d)) mass *= script.region.upper[d] - script.layers.lower[d];
  return mass;
}

}  // namespace

int play_fv(Job& job, const Script& script) {
  job.compare(contract_of(script), script.deadline);
  const RunPlan plan = plan_of(script);
  auto partner = job.sph_partner(plan);
  const Box part = part_of(script.grid, job.rank(), job.size(), script);
  DonorGeometry geometry;
  Targets targets;
  if (script.misbehave != "zero-points") {
    // one ghost layer on each side, so that no dual cell is missing between two ranks
    if (!part.empty())
      geometry.patches.push_back(lattice(part.grown(script.spacing), script.spacing, script.dimension));
    targets = targets_of(part, script);
  }
  partner->offer(geometry, targets);
  // donors that the partner's first rank awaits
  const Box first = part_of(script.layers, 0, job.partner_size(), script);
  const std::size_t n_first = clipped(geometry, clip(geometry, first)).size();
  Proposal proposal;
  proposal.dt_stable = 1e30;
  proposal.wants_particles = script.wants_particles;
  std::int64_t windows = 0;
  DonorValues donors;
  Samples samples;
  ParticleStates states;
  const auto renew = [&] { partner->offer(geometry, targets); };
  while (const auto agreement = begin_window(*partner, script, "mock_fv", proposal, windows, renew)) {
    const Window& window = agreement->window;
    for (int pass = 0; pass < plan.schedule.sph_passes(); ++pass) {
      if (!misbehave_in_message(script, job, true, window, n_first)) {
        fill(geometry, window, script, donors);
        if (script.misbehave == "nan" && window.index == script.at)
          for (std::size_t i = 0; i < 3; ++i)
            donors.p[first_inside(geometry, script.layers) + i] = std::nan("");
        if (script.misbehave == "short-horizon" && window.index == script.at)
          donors.horizon_end = 0.5 * (window.t_begin + window.t_end);
        partner->send(window, donors);
        if (script.misbehave == "twice" && window.index == script.at) partner->send(window, donors);
      }
      partner->receive(window, samples);
      check_samples(targets, samples, window, script);
    }
    if (agreement->wants_particles) {
      partner->receive_particles(window, states);
      for (std::size_t i = 0; i < states.size(); ++i)
        if (states.p[i] != flow(script, {states.x[i], states.y[i], states.z[i]}, window.t_end).p ||
            states.V[i] != 1e-3)
          throw CouplingError("a particle differs from the flow");
      if (job.size() == 1 && states.size() == 0) throw CouplingError("no particles came");
    }
    Ledger ledger;
    ledger.fv_mass_flux = 0.5;
    const Ledger both = partner->exchange(window, ledger);
    // a real partner keeps its mass: nothing crosses the faces of a flow along them
    const double mass = script.scene ? mass_of_particles(script) : job.partner_size();
    if (both.fv_mass_flux != 0.5 * job.size() || !(std::abs(both.mass_inside - mass) <= 1e-12 * mass))
      throw CouplingError("the ledger does not add up");
    ++windows;
  }
  if (job.rank() == 0)
    std::printf("mock_fv: %lld windows with %s, waited %.3f s\n", static_cast<long long>(windows),
                partner->description().c_str(), partner->waited());
  return 0;
}

}  // namespace littoral::mock
