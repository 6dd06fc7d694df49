#include "program.hpp"

#include <filesystem>
#include <fstream>
#include <iostream>

#include "config.hpp"
#include "io/checkpoint.hpp"
#include "littoral/coupler/job.hpp"
#include "littoral/error.hpp"
#include "littoral/support/log.hpp"
#include "littoral/support/options.hpp"
#include "littoral/support/partner_choice.hpp"
#include "littoral/support/run_plan.hpp"
#include "littoral/support/scene_warnings.hpp"
#include "prediction.hpp"
#include "solver.hpp"

namespace littoral::sph {
namespace {

constexpr const char* k_description =
    "Smoothed particle hydrodynamics of free-surface flow, alone or with a grid partner.";

void write_text(const std::string& path, const std::string& text) {
  std::ofstream file(path);
  file << text << std::flush;
  if (!file) throw IoError(path + ": cannot be written (is the disk full, the folder writable?)");
}

/// The grid side of this run: the job's other program, an analytic one, a record, or nobody.
std::unique_ptr<coupler::FvPartner> partner_of(coupler::Job& job, const support::ProgramOptions& options,
                                               const RunConfig& config) {
  double time = 0.0;
  std::int64_t window = 0;
  if (!options.restart.empty()) {
    const RunState run = read_run_state(options.restart, config.scene);
    time = run.time;
    window = run.window;
  }
  const auto plan = support::run_plan(config.scene, time, window);
  return support::choose_fv_partner(job, config.scene, config.sph.coupling.partner, options, plan,
                                    config.sph.spacing);
}

template <int D>
void run(coupler::Job& job, const support::ProgramOptions& options, const RunConfig& config,
         const std::string& folder, support::Log& log) {
  Solver<D> solver(config, folder, log, partner_of(job, options, config), options.restart, job.comm());
  solver.run();
}

/// What can be found without placing particles.
template <int D>
void check(const RunConfig& config, bool coupled) {
  (void)domain_of<D>(config);
  (void)region_of<D>(config, coupled);
}

}  // namespace

int run_program(coupler::Job& job, int argc, char** argv) {
  const auto parsed = support::parse_options(argc, argv, "sph_solver", LITTORAL_VERSION, k_description);
  const bool speaks = job.rank() == 0;
  if (parsed.exit_status) {
    if (speaks) (*parsed.exit_status == 0 ? std::cout : std::cerr) << parsed.text;
    return *parsed.exit_status;
  }
  const auto& options = parsed.options;
  if (options.help_config) {
    if (speaks) std::cout << help_text();
    return 0;
  }
  const RunConfig config = read_config(options.config, options.settings, options.scene_settings);
  const auto player =
      support::planned_partner(coupler::Role::sph, config.scene, config.sph.coupling.partner, options);
  const bool coupled = player != support::PartnerPlayer::nobody;
  config.scene.dimension == 2 ? check<2>(config, coupled) : check<3>(config, coupled);
  if (options.print_config) {
    if (speaks) std::cout << resolved_text(config);
    return 0;
  }
  if (options.check) {
    const Prediction prediction = predict(config, coupled);
    if (!speaks) return 0;
    for (const std::string& warning : support::scene_warnings(config.scene))
      std::cout << "sph_solver: warning: " << warning << "\n";
    if (prediction.particles == 0) std::cout << "sph_solver: warning: " << k_starts_empty << "\n";
    std::cout << options.config << ": no problem found\n" << prediction.text();
    return 0;
  }
  const std::string folder = options.out + "/sph";
  if (speaks) {
    std::error_code failure;
    std::filesystem::create_directories(folder, failure);
    if (failure) throw IoError(folder + ": cannot be made: " + failure.message());
    write_text(folder + "/config.yaml", resolved_text(config));
  }
  support::Log log("sph", job.rank(), speaks ? folder + "/log.txt" : "");
  for (const std::string& warning : support::scene_warnings(config.scene)) log.warn(warning);
  config.scene.dimension == 2 ? run<2>(job, options, config, folder, log)
                              : run<3>(job, options, config, folder, log);
  return 0;
}

}  // namespace littoral::sph
