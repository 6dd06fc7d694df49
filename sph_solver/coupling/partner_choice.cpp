#include "coupling/partner_choice.hpp"

#include <cmath>

#include "littoral/coupler/job.hpp"
#include "littoral/error.hpp"

namespace littoral::sph {

coupler::Flow analytic_flow(const support::Scene& scene, const CouplingConfig::Analytic& analytic) {
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

std::unique_ptr<coupler::FvPartner> choose_partner(const coupler::Job& job, const support::Scene& scene,
                                                   const CouplingConfig& config, const coupler::RunPlan& plan,
                                                   double particle_spacing) {
  const bool coupled = scene.coupling.kind != support::Scene::CouplingKind::none;
  PartnerKind kind = config.partner;
  if (kind == PartnerKind::automatic) kind = coupled ? PartnerKind::mpi : PartnerKind::none;
  if (job.has_partner() && kind != PartnerKind::mpi)
    throw ConfigError(std::string("the job holds a grid solver, but ") +
                      (coupled ? "sph.yaml's partner is not mpi." : "the scene's coupling.kind is none.") +
                      " Start sph_solver alone, or couple the two.");
  switch (kind) {
    case PartnerKind::mpi:
      if (!job.has_partner())
        throw ConfigError(
            "no partner in this job: start both programs in one mpirun line, as littoral run does, or set "
            "partner: analytic (sph.yaml) to run the particles alone.");
      return job.fv_partner(plan);
    case PartnerKind::analytic: {
      if (scene.regions.empty() || !coupled)
        throw ConfigError("partner: analytic needs a scene with regions and a coupling.kind.");
      const double spacing = config.analytic.spacing > 0.0 ? config.analytic.spacing : particle_spacing;
      return coupler::analytic_fv_partner(analytic_flow(scene, config.analytic), plan, spacing,
                                          scene.dimension, job.comm());
    }
    case PartnerKind::none:
    case PartnerKind::automatic:
      break;
  }
  if (coupled)
    throw ConfigError("partner: none, but the scene's coupling.kind asks for one; set coupling.kind=none.");
  return nullptr;
}

}  // namespace littoral::sph
