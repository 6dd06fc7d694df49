#include "coupling/partner_config.hpp"

namespace littoral::fv {

void PartnerConfig::bind(support::Binder& b) {
  b.choice<PartnerKind>("partner", kind,
                        {{"auto", PartnerKind::automatic},
                         {"mpi", PartnerKind::mpi},
                         {"none", PartnerKind::none},
                         {"analytic", PartnerKind::analytic}})
      .doc(
          "Who plays the particles: the other program of the job (mpi), nobody, or a formula (analytic). "
          "auto: mpi in a scene with coupling, else none.");
  b.section("analytic", "The flow of an analytic partner; each flow uses the keys it needs.", [&] {
    b.choice<AnalyticFlow>("flow", analytic.flow,
                           {{"initial", AnalyticFlow::initial},
                            {"uniform_stream", AnalyticFlow::uniform_stream},
                            {"hydrostatic", AnalyticFlow::hydrostatic},
                            {"taylor_vortex", AnalyticFlow::taylor_vortex},
                            {"standing_wave", AnalyticFlow::standing_wave}})
        .doc("initial: the scene's initial formulas, evaluated at the time asked for.");
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

}  // namespace littoral::fv
