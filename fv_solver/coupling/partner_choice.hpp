#pragma once

#include <memory>
#include <string>

#include "coupling/partner_config.hpp"
#include "littoral/coupler/analytic.hpp"
#include "littoral/coupler/partner.hpp"
#include "littoral/support/scene.hpp"

namespace littoral::coupler {
class Job;
}

namespace littoral::fv {

/// The flow of the analytic partner. pure
coupler::Flow analytic_flow(const support::Scene& scene, const PartnerConfig::Analytic& analytic);

/// What the partner has to know of this run, from the scene.
coupler::RunPlan run_plan(const support::Scene& scene, double start_time, std::int64_t start_window);

/// The particle side of this run; null if nobody plays it. `record`: file to record it in, `replay`: record
/// to play in its place; or empty. Compares the scene with a partner in the job. comm: collective over both
/// programs throws ConfigError: `mpi` without a partner in the job, a partner in the job that the scene or
/// fv.yaml does not want, an analytic partner in a scene without regions; CouplingError: see Job::compare
std::unique_ptr<coupler::SphPartner> choose_partner(const coupler::Job& job, const support::Scene& scene,
                                                    const PartnerConfig& config, const coupler::RunPlan& plan,
                                                    const std::string& record, const std::string& replay);

}  // namespace littoral::fv
