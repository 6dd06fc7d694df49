#pragma once

#include <memory>

#include "coupling/coupling_config.hpp"
#include "littoral/coupler/analytic.hpp"
#include "littoral/coupler/partner.hpp"
#include "littoral/support/scene.hpp"

namespace littoral::coupler {
class Job;
}

namespace littoral::sph {

/// The grid side of this run; null if nobody plays it.
/// throws ConfigError: `mpi` without a partner in the job, a partner in the job that the scene or sph.yaml
/// does not want, an analytic partner in a scene without regions
std::unique_ptr<coupler::FvPartner> choose_partner(const coupler::Job& job, const support::Scene& scene,
                                                   const CouplingConfig& config, const coupler::RunPlan& plan,
                                                   double particle_spacing);

/// The flow of the analytic partner. pure
coupler::Flow analytic_flow(const support::Scene& scene, const CouplingConfig::Analytic& analytic);

}  // namespace littoral::sph
