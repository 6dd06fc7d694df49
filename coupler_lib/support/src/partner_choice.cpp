#include "littoral/support/partner_choice.hpp"

#include <string>

#include "littoral/coupler/job.hpp"
#include "littoral/coupler/record.hpp"
#include "littoral/error.hpp"

namespace littoral::support {
namespace {

/// The words in which messages speak of one side and the other.
struct Words {
  const char* mine;
  const char* other;
  const char* file;
};

Words words(coupler::Role role) {
  if (role == coupler::Role::sph) return {"sph_solver", "fv_solver", "sph.yaml"};
  return {"fv_solver", "sph_solver", "fv.yaml"};
}

/// Each rank hears something else, and has a record of its own.
std::string of_rank(const std::string& path, const coupler::Job& job) {
  if (job.size() == 1) return path;
  return path + ".rank" + std::to_string(job.rank()) + "of" + std::to_string(job.size());
}

/// Records what `partner` says, where that is wanted.
template <class Partner>
std::unique_ptr<Partner> recorded(std::unique_ptr<Partner> partner, const ProgramOptions& options,
                                  const Scene& scene, const coupler::Job& job) {
  if (options.record.empty()) return partner;
  return coupler::recording(std::move(partner), of_rank(options.record, job), scene.restart_digest);
}

}  // namespace

PartnerPlayer planned_partner(coupler::Role role, const Scene& scene, const PartnerConfig& config,
                              const ProgramOptions& options) {
  const std::string file = words(role).file;
  const bool coupled = scene.has_region();
  if (!options.replay.empty()) {
    if (!options.record.empty())
      throw ConfigError("--record and --replay together: what is replayed has been recorded already");
    if (!coupled)
      throw ConfigError("--replay: the scene's coupling.kind is none, there is no partner to play");
    return PartnerPlayer::record;
  }
  PartnerKind kind = config.kind;
  if (kind == PartnerKind::automatic) kind = coupled ? PartnerKind::mpi : PartnerKind::none;
  if (kind == PartnerKind::none) {
    if (coupled)
      throw ConfigError(file +
                        ": partner: none, but the scene's coupling.kind asks for one; set "
                        "--set scene.coupling.kind=none");
    if (!options.record.empty()) throw ConfigError("--record: there is no partner to record");
    return PartnerPlayer::nobody;
  }
  if (!coupled)
    throw ConfigError(file + ": a partner needs a scene with regions and a coupling.kind other than none");
  return kind == PartnerKind::mpi ? PartnerPlayer::program : PartnerPlayer::formula;
}

PartnerPlayer decide_partner(coupler::Role role, bool job_has_partner, const Scene& scene,
                             const PartnerConfig& config, const ProgramOptions& options) {
  const Words say = words(role);
  const PartnerPlayer player = planned_partner(role, scene, config, options);
  if (player == PartnerPlayer::program && !job_has_partner)
    throw ConfigError(
        std::string("the scene couples particles and grid, but no ") + say.other +
        " runs in this job: start both in one mpirun line, as littoral run does; or set partner: "
        "analytic (" +
        say.file + "); or run " + say.mine + " alone with --set scene.coupling.kind=none");
  if (player != PartnerPlayer::program && job_has_partner) {
    const std::string why = player == PartnerPlayer::record ? "--replay plays it"
                            : player == PartnerPlayer::formula
                                ? std::string(say.file) + " has partner: analytic"
                                : "the scene's coupling.kind is none";
    throw ConfigError(std::string(say.other) + " runs in this job, but " + why + ": start " + say.mine +
                      " alone, or couple the two");
  }
  return player;
}

std::unique_ptr<coupler::FvPartner> choose_fv_partner(const coupler::Job& job, const Scene& scene,
                                                      const PartnerConfig& config,
                                                      const ProgramOptions& options,
                                                      const coupler::RunPlan& plan, double spacing) {
  switch (decide_partner(coupler::Role::sph, job.has_partner(), scene, config, options)) {
    case PartnerPlayer::program:
      job.compare(scene.contract(), plan.deadline);
      return recorded(job.fv_partner(plan), options, scene, job);
    case PartnerPlayer::formula:
      return recorded(
          coupler::analytic_fv_partner(analytic_flow(scene, config.analytic), plan,
                                       config.analytic.spacing > 0.0 ? config.analytic.spacing : spacing,
                                       scene.dimension, job.comm()),
          options, scene, job);
    case PartnerPlayer::record:
      return coupler::replayed_fv_partner(of_rank(options.replay, job), scene.restart_digest);
    case PartnerPlayer::nobody:
      break;
  }
  return nullptr;
}

std::unique_ptr<coupler::SphPartner> choose_sph_partner(const coupler::Job& job, const Scene& scene,
                                                        const PartnerConfig& config,
                                                        const ProgramOptions& options,
                                                        const coupler::RunPlan& plan) {
  switch (decide_partner(coupler::Role::fv, job.has_partner(), scene, config, options)) {
    case PartnerPlayer::program:
      job.compare(scene.contract(), plan.deadline);
      return recorded(job.sph_partner(plan), options, scene, job);
    case PartnerPlayer::formula:
      return recorded(coupler::analytic_sph_partner(analytic_flow(scene, config.analytic), plan, job.comm()),
                      options, scene, job);
    case PartnerPlayer::record:
      return coupler::replayed_sph_partner(of_rank(options.replay, job), scene.restart_digest);
    case PartnerPlayer::nobody:
      break;
  }
  return nullptr;
}

}  // namespace littoral::support
