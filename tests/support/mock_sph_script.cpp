#include <cmath>
#include <cstdio>
#include <random>

#include "littoral/coupler/donor_search.hpp"
#include "littoral/error.hpp"
#include "mock.hpp"

namespace littoral::mock {

using namespace coupler;

namespace {

// Trilinear weights and (24) are exact for the flow; values are about 10 (in a scene: 1000, and the
// tolerance).
constexpr double k_round_off = 1e-11;

/// Interpolates at random points of `needs` and compares with the flow; returns the worst error.
double check_donors(const DonorGeometry& geometry, const DonorValues& values, const Box& needs,
                    const Window& window, const Script& script) {
  const DonorSearch search(geometry, script.dimension);
  std::mt19937 random(static_cast<unsigned>(window.index));
  std::int64_t hint = -1;
  double worst = 0.0;
  for (int i = 0; i < 50; ++i) {
    Vec3 x;
    for (std::size_t d = 0; d < 3; ++d)
      x[d] = std::uniform_real_distribution(needs.lower[d], needs.upper[d])(random);
    if (script.dimension == 2) x[1] = 0.0;
    const Donor donor = search.find(x, hint);
    if (!donor.found) throw CouplingError("a point of the layers has no donor");
    const double t = std::uniform_real_distribution(window.t_begin, window.t_end)(random);
    const DonorState state = interpolate(values, donor, t);
    const FlowState exact = flow(script, x, t);
    for (const double error : {state.p - exact.p, state.u[0] - exact.u[0], state.u[1] - exact.u[1],
                               state.u[2] - exact.u[2], script.with_phi ? state.phi - exact.phi : 0.0})
      worst = std::max(worst, std::abs(error));
  }
  if (!(worst < k_round_off + script.tolerance))
    throw CouplingError("donors differ from the flow by " + std::to_string(worst));
  return worst;
}

ParticleStates particles_of(const Script& script, const Box& covers, double t) {
  ParticleStates states;
  states.time = t;
  if (covers.empty()) return states;
  for (int i = 0; i < 10; ++i) {
    const double a = (i + 0.5) / 10.0;
    const Vec3 x{covers.lower[0] + a * (covers.upper[0] - covers.lower[0]), 0.0,
                 covers.lower[2] + a * (covers.upper[2] - covers.lower[2])};
    const FlowState state = flow(script, x, t);
    const std::array<double, 8> values{x[0], x[1], x[2], state.u[0], state.u[1], state.u[2], state.p, 1e-3};
    std::size_t c = 0;
    for (auto* column :
         {&states.x, &states.y, &states.z, &states.u, &states.v, &states.w, &states.p, &states.V})
      column->push_back(values[c++]);
    states.on_surface.push_back(static_cast<std::uint8_t>(i % 2));
    states.nx.push_back(0.0);
    states.ny.push_back(0.0);
    states.nz.push_back(1.0);
  }
  return states;
}

}  // namespace

int play_sph(Job& job, const Script& script) {
  job.compare(contract_of(script), script.deadline);
  const RunPlan plan = plan_of(script);
  auto partner = job.fv_partner(plan);
  Box part = part_of(script.layers, job.rank(), job.size(), script);
  if (script.misbehave == "zero-points") part = Box::nothing();
  const auto announce = [&] {
    partner->announce(part, script.scene ? script.region : part.grown(script.spacing));
  };
  announce();
  Proposal proposal;
  proposal.dt_stable = script.dt_stable;
  double worst = 0.0;
  std::int64_t windows = 0;
  DonorValues donors;
  Samples samples;
  const auto renew = [&] {
    part.lower[2] += 0.01;
    announce();
  };
  while (const auto agreement = begin_window(*partner, script, "mock_sph", proposal, windows, renew)) {
    const Window& window = agreement->window;
    for (int pass = 0; pass < plan.schedule.sph_passes(); ++pass) {
      partner->receive(window, donors);
      if (!part.empty())
        worst = std::max(worst, check_donors(partner->donor_geometry(), donors, part, window, script));
      const Targets& targets = partner->targets();
      if (misbehave_in_message(script, job, false, window, targets.size())) continue;
      samples.resize(targets.size(), script.with_phi);
      samples.time = window.t_end;
      for (std::size_t i = 0; i < targets.size(); ++i) {
        const FlowState state = flow(script, {targets.x[i], targets.y[i], targets.z[i]}, window.t_end);
        samples.p[i] = state.p;
        samples.u[i] = state.u[0];
        samples.v[i] = state.u[1];
        samples.w[i] = state.u[2];
        if (script.with_phi) samples.phi[i] = state.phi;
        samples.coverage[i] = 1.0;
        samples.status[i] = SampleStatus::ok;
      }
      if (script.misbehave == "nan" && window.index == script.at && !samples.u.empty())
        samples.u[0] = std::nan("");
      partner->send(window, samples);
      if (script.misbehave == "twice" && window.index == script.at) partner->send(window, samples);
    }
    if (agreement->wants_particles) partner->send_particles(window, particles_of(script, part, window.t_end));
    Ledger ledger;
    ledger.mass_inside = 1.0;
    const Ledger both = partner->exchange(window, ledger);
    // a real grid lets nothing through the face of a flow along it
    const bool flux_is_wrong = script.scene ? !(std::abs(both.fv_mass_flux) <= script.tolerance)
                                            : both.fv_mass_flux != 0.5 * job.partner_size();
    if (both.mass_inside != job.size() || flux_is_wrong) throw CouplingError("the ledger does not add up");
    ++windows;
  }
  if (job.rank() == 0)
    std::printf("mock_sph: %lld windows with %s, worst donor error %.1e, waited %.3f s\n",
                static_cast<long long>(windows), partner->description().c_str(), worst, partner->waited());
  return 0;
}

}  // namespace littoral::mock
