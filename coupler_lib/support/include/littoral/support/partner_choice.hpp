#pragma once

#include <memory>

#include "littoral/coupler/partner.hpp"
#include "littoral/support/options.hpp"
#include "littoral/support/partner_config.hpp"

namespace littoral::coupler {
class Job;
}

namespace littoral::support {

/// Who plays the partner in this run.
enum class PartnerPlayer : std::uint8_t { nobody, program, formula, record };

/// The rule, the same for both programs, as far as scene, file and command line decide: what --check can say
/// without a partner in the job. pure
/// throws ConfigError: a partner that the scene has no use for, or none where it needs one; --record without
/// a partner, or together with --replay
PartnerPlayer planned_partner(coupler::Role role, const Scene& scene, const PartnerConfig& config,
                              const ProgramOptions& options);
/// The same, with the job known.
/// throws ConfigError also: `mpi` without a partner in the job, a partner in the job that is not wanted, be
/// it that a record or a formula plays it
PartnerPlayer decide_partner(coupler::Role role, bool job_has_partner, const Scene& scene,
                             const PartnerConfig& config, const ProgramOptions& options);

/// The grid side of this run for the particles' program; null if nobody plays it. A partner in the job must
/// have read the same scene (Job::compare). `spacing` [m]: of the lattice of a formula, where the file leaves
/// it open. comm: collective over both programs. throws as decide_partner; CouplingError, IoError
std::unique_ptr<coupler::FvPartner> choose_fv_partner(const coupler::Job& job, const Scene& scene,
                                                      const PartnerConfig& config,
                                                      const ProgramOptions& options,
                                                      const coupler::RunPlan& plan, double spacing);
/// The particle side of this run for the grid's program, likewise.
std::unique_ptr<coupler::SphPartner> choose_sph_partner(const coupler::Job& job, const Scene& scene,
                                                        const PartnerConfig& config,
                                                        const ProgramOptions& options,
                                                        const coupler::RunPlan& plan);

}  // namespace littoral::support
