// Stands on the particles' side for a scene of still water that it reads as sph_solver does; it knows the
// water by formula, so what the foreign solver offers and receives can be checked to round-off.
#include <cmath>
#include <cstdio>

#include "littoral/coupler/donor_search.hpp"
#include "littoral/coupler/job.hpp"
#include "littoral/error.hpp"
#include "littoral/support/run_plan.hpp"
#include "littoral/support/scene.hpp"

namespace {

using namespace littoral;
using namespace littoral::coupler;

double pressure(const support::Scene& scene, double z) { return scene.fluid.density * scene.gravity[2] * z; }

/// Donors are linear in z: the weights give them back to round-off.
void check(const FvPartner& grid, const DonorValues& donors, const support::Scene& scene, const Box& needs,
           double time) {
  const DonorSearch search(grid.donor_geometry(), scene.dimension);
  std::int64_t hint = -1;
  for (int k = 0; k <= 100; ++k) {
    const double a = 0.01 * k;
    const Vec3 x = {needs.lower[0] + a * (needs.upper[0] - needs.lower[0]), 0.0,
                    needs.lower[2] + a * (needs.upper[2] - needs.lower[2])};
    const Donor donor = search.find(x, hint);
    if (!donor.found) throw CouplingError("no donor around z = " + std::to_string(x[2]));
    const DonorState state = interpolate(donors, donor, time);
    if (!(std::abs(state.p - pressure(scene, x[2])) < 1e-8))
      throw CouplingError("the donors do not know the water at z = " + std::to_string(x[2]));
  }
}

int run(Job& job, int argc, char** argv) {
  if (argc < 2) throw ConfigError("usage: scene_particles scene.yaml [key=value ...]");
  const auto scene = support::Scene::from_file(argv[1], {argv + 2, argv + argc});
  job.compare(scene.contract());
  const auto grid = job.fv_partner(support::run_plan(scene));
  const auto& region = scene.regions.at(0);
  const Box needs = {region.lower, region.upper};
  grid->announce(needs, needs.grown(scene.coupling.driven_width));
  Proposal proposal;
  proposal.dt_stable = 0.004;
  DonorValues donors;
  Samples samples;
  for (;;) {
    const Agreement agreement = grid->agree(proposal);
    if (agreement.stop) return grid->goodbye(agreement.reason), 0;
    const Window& window = agreement.window;
    grid->receive(window, donors);
    check(*grid, donors, scene, needs, window.t_end);
    const Targets& targets = grid->targets();
    samples.resize(targets.size(), false);
    samples.time = window.t_end;
    for (std::size_t i = 0; i < targets.size(); ++i) {
      samples.p[i] = pressure(scene, targets.z[i]);
      samples.coverage[i] = 1.0;
      samples.status[i] = SampleStatus::ok;
    }
    grid->send(window, samples);
    grid->exchange(window, {});
  }
}

}  // namespace

int main(int argc, char** argv) { return run_program(argc, argv, Role::sph, "test", run); }
