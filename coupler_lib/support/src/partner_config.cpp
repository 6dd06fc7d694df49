#include "littoral/support/partner_config.hpp"

#include <cmath>

namespace littoral::support {

void PartnerConfig::bind(Binder& b, coupler::Role role) {
  const bool particles = role == coupler::Role::sph;
  b.choice<PartnerKind>("partner", kind,
                        {{"auto", PartnerKind::automatic},
                         {"mpi", PartnerKind::mpi},
                         {"none", PartnerKind::none},
                         {"analytic", PartnerKind::analytic}})
      .doc(std::string("Who plays the ") + (particles ? "grid" : "particles") +
           ": the other program of the job (mpi), nobody, or a formula (analytic). auto: mpi in a scene with "
           "coupling, else none.");
  b.section("analytic", "The flow of an analytic partner; each flow uses the keys it needs.", [&] {
    b.choice<AnalyticFlow>("flow", analytic.flow,
                           {{"initial", AnalyticFlow::initial},
                            {"uniform_stream", AnalyticFlow::uniform_stream},
                            {"hydrostatic", AnalyticFlow::hydrostatic},
                            {"taylor_vortex", AnalyticFlow::taylor_vortex},
                            {"standing_wave", AnalyticFlow::standing_wave}})
        .doc("initial: the scene's initial formulas, evaluated at the time asked for.");
    if (particles)
      b.key("spacing", analytic.spacing).unit("m").min(0.0).doc("Donor cells; 0: the particle spacing.");
    b.key("velocity", analytic.velocity).unit("m/s").doc("Of the stream (uniform_stream, taylor_vortex).");
    b.key("pressure", analytic.pressure).unit("Pa").doc("Of a uniform_stream.");
    b.key("level", analytic.level).unit("m").doc("z of the still surface (hydrostatic).");
    b.key("speed", analytic.speed).unit("m/s").doc("Of a taylor_vortex.");
    b.key("wavelength", analytic.wavelength)
        .unit("m")
        .exclusive_min(0.0)
        .doc("taylor_vortex, standing_wave.");
    b.key("depth", analytic.depth).unit("m").exclusive_min(0.0).doc("Still-water depth (standing_wave).");
    b.key("amplitude", analytic.amplitude).unit("m").doc("Of the elevation (standing_wave).");
  });
}

coupler::Flow analytic_flow(const Scene& scene, const PartnerConfig::Analytic& analytic) {
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
  const Scene::Initial initial = scene.initial;
  return [initial](const coupler::Vec3& x, double t) {
    coupler::FlowState state;
    state.p = initial.p(x[0], x[1], x[2], t);
    state.u = {initial.u(x[0], x[1], x[2], t), initial.v(x[0], x[1], x[2], t),
               initial.w(x[0], x[1], x[2], t)};
    if (initial.surface) state.phi = (*initial.surface)(x[0], x[1], x[2], t);
    return state;
  };
}

}  // namespace littoral::support
