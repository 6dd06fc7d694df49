#include "coupling/partner_choice.hpp"

#include <cmath>

#include "littoral/coupler/job.hpp"
#include "littoral/coupler/record.hpp"
#include "littoral/error.hpp"

namespace littoral::fv {

coupler::Flow analytic_flow(const support::Scene& scene, const PartnerConfig::Analytic& analytic) {
  const double rho0 = scene.fluid.density;
  const double g = std::hypot(scene.gravity[0], scene.gravity[1], scene.gravity[2]);
  const double wavenumber = 2.0 * std::acos(-1.0) / analytic.wavelength;
  switch (analytic.flow) {
    case AnalyticFlow::uniform_stream:
      return coupler::uniform_stream(analytic.velocity, analytic.pressure);
    case AnalyticFlow::hydrostatic:
      return coupler::hydrostatic(rho0, g, analytic.level, scene.fluid.reference_pressure);
    case AnalyticFlow::taylor_vortex:
      return coupler::taylor_vortex(rho0, analytic.speed, analytic.wavelength, scene.fluid.viscosity,
                                    analytic.velocity);
    case AnalyticFlow::standing_wave:
      return coupler::standing_wave(rho0, g, analytic.depth, wavenumber, analytic.amplitude);
    case AnalyticFlow::initial:
      break;
  }
  const support::Scene::Initial initial = scene.initial;
  return [initial](const coupler::Vec3& x, double t) {
    coupler::FlowState state;
    state.p = initial.p(x[0], x[1], x[2], t);
    state.u = {initial.u(x[0], x[1], x[2], t), initial.v(x[0], x[1], x[2], t),
               initial.w(x[0], x[1], x[2], t)};
    if (initial.surface) state.phi = (*initial.surface)(x[0], x[1], x[2], t);
    return state;
  };
}

coupler::RunPlan run_plan(const support::Scene& scene, double start_time, std::int64_t start_window) {
  coupler::RunPlan plan;
  plan.schedule = scene.coupling.schedule;
  plan.window = scene.coupling.window;
  plan.start_time = start_time;
  plan.start_window = start_window;
  plan.end_time = scene.time.end;
  plan.max_windows = scene.time.max_windows;
  plan.deadline = scene.coupling.deadline;
  return plan;
}

namespace {

std::unique_ptr<coupler::SphPartner> live_partner(const coupler::Job& job, const support::Scene& scene,
                                                  const PartnerConfig& config, const coupler::RunPlan& plan) {
  const bool coupled = scene.has_region();
  PartnerKind kind = config.kind;
  if (kind == PartnerKind::automatic) kind = coupled ? PartnerKind::mpi : PartnerKind::none;
  if (job.has_partner() && kind != PartnerKind::mpi)
    throw ConfigError(std::string("sph_solver runs in this job, but ") +
                      (coupled ? "fv.yaml's partner is not mpi" : "the scene's coupling.kind is none") +
                      ": start fv_solver alone, or couple the two");
  switch (kind) {
    case PartnerKind::mpi:
      if (!job.has_partner())
        throw ConfigError(
            "the scene couples particles and grid, but no sph_solver runs in this job: start both in one "
            "mpirun line, as littoral run does; or set partner: analytic (fv.yaml); or run the grid alone "
            "with "
            "--set scene.coupling.kind=none");
      job.compare(scene.contract());
      return job.sph_partner(plan);
    case PartnerKind::analytic:
      if (!coupled) throw ConfigError("partner: analytic needs a scene with regions and a coupling.kind");
      return coupler::analytic_sph_partner(analytic_flow(scene, config.analytic), plan, job.comm());
    case PartnerKind::none:
    case PartnerKind::automatic:
      break;
  }
  if (coupled)
    throw ConfigError(
        "partner: none, but the scene's coupling.kind asks for one; set scene.coupling.kind=none");
  return nullptr;
}

}  // namespace

std::unique_ptr<coupler::SphPartner> choose_partner(const coupler::Job& job, const support::Scene& scene,
                                                    const PartnerConfig& config, const coupler::RunPlan& plan,
                                                    const std::string& record, const std::string& replay) {
  if (!replay.empty()) {
    if (job.has_partner()) throw ConfigError("--replay plays the partner, but sph_solver runs in this job");
    return coupler::replayed_sph_partner(replay);
  }
  auto partner = live_partner(job, scene, config, plan);
  if (record.empty()) return partner;
  if (!partner) throw ConfigError("--record: there is no partner to record");
  return coupler::recording(std::move(partner), record);
}

}  // namespace littoral::fv
