#include "program.hpp"

#include <cstdio>
#include <memory>
#include <string>

#include "checks.hpp"
#include "companion.hpp"
#include "coupling/carve.hpp"
#include "coupling/coupled.hpp"
#include "grid/grid_file.hpp"
#include "io/checkpoint.hpp"
#include "io/gauges.hpp"
#include "littoral/error.hpp"
#include "littoral/support/options.hpp"
#include "littoral/support/partner_choice.hpp"
#include "littoral/support/run_plan.hpp"
#include "littoral/support/scene_warnings.hpp"
#include "setup.hpp"
#include "solver.hpp"
#include "version.hpp"

namespace littoral::fv {
namespace {

using support::ProgramOptions;

template <int D>
std::unique_ptr<Companion<D>> companion_of(coupler::Job& job, const ProgramOptions& options,
                                           const FvConfig& config, const support::Scene& scene,
                                           const Solver<D>& solver) {
  const auto plan = support::run_plan(scene, solver.start_time(), solver.start_window());
  auto partner = support::choose_sph_partner(job, scene, config.partner, options, plan);
  if (partner) return std::make_unique<Coupled<D>>(scene, config.forcing_constant, std::move(partner));
  return std::make_unique<Alone<D>>(solver.start_time(), scene.time.end, scene.time.max_windows,
                                    solver.start_window());
}

/// A run alone takes its steps from this program's file.
void need_step(const ProgramOptions& options, const FvConfig& config, const support::Scene& scene) {
  if (!scene.has_region() && !config.time.dt && !config.time.cfl)
    throw ConfigError(options.config + ": a run without partner needs a step: give time.dt or time.cfl");
}

Ranks ranks_of(const coupler::Job& job) { return job.size() > 1 ? Ranks(job.comm()) : Ranks(); }

/// What --check finds beyond reading: everything a run would refuse before its first window.
template <int D>
double check_run(const coupler::Job& job, const ProgramOptions& options, const FvConfig& config,
                 const support::Scene& scene, std::vector<std::string>& notes) {
  Stepper<D> stepper = make_stepper<D>(config, scene, &notes, ranks_of(job));
  if (!options.restart.empty()) read_checkpoint<D>(options.restart, stepper, scene);
  if (scene.has_region()) {
    carve<D>(stepper.blocks(), stepper.exchange(), scene);
    stepper.seek_donors();
    check_layers_covered<D>(DonorOffer<D>(stepper.blocks(), stepper.exchange()).geometry(), scene,
                            stepper.exchange().ranks());
  }
  check_blocks<D>(stepper.blocks(), scene, stepper.surface() != nullptr);
  const Gauges<D> gauges(config.gauges, stepper);
  double cells = 0.0;
  for (const auto& shape : stepper.exchange().layout().shape)
    cells += static_cast<double>(shape.extent.cells());
  return cells;
}

template <int D>
void run_scene(coupler::Job& job, const ProgramOptions& options, const FvConfig& config,
               const support::Scene& scene) {
  Solver<D> solver(config, scene, options.out, options.restart, ranks_of(job));
  solver.run(*companion_of<D>(job, options, config, scene, solver));
}

}  // namespace

int run(coupler::Job& job, int argc, char** argv) {
  std::string grid_path;
  const support::ParsedOptions parsed = support::parse_options(
      argc, argv, "fv_solver", k_version, "Finite volumes on structured blocks.",
      {{"--write-grid", "write the grid as PLOT3D into this file and stop", &grid_path}});
  const bool speaks = job.rank() == 0;
  if (parsed.exit_status) {
    if (speaks) std::fputs(parsed.text.c_str(), *parsed.exit_status == 0 ? stdout : stderr);
    return *parsed.exit_status;
  }
  const ProgramOptions& options = parsed.options;
  if (options.help_config) {
    if (speaks) {
      support::Binder help(support::Binder::Mode::help);
      FvConfig().bind(help);
      std::printf("# fv.yaml\n%s\n# scene.yaml\n%s", help.text().c_str(), support::Scene::help().c_str());
    }
    return 0;
  }
  support::Scene scene;
  const FvConfig config =
      FvConfig::from_file(options.config, options.settings, options.scene_settings, scene);
  if (options.print_config) {
    if (speaks) std::printf("# scene\n%s# fv\n%s", scene.resolved().c_str(), config.resolved().c_str());
    return 0;
  }
  if (!grid_path.empty()) {
    if (!speaks) return 0;
    if (scene.dimension == 2)
      write_grid<2>(grid_path, build_grid<2>(config, scene).blocks);
    else
      write_grid<3>(grid_path, build_grid<3>(config, scene).blocks);
    return 0;
  }
  need_step(options, config, scene);
  support::planned_partner(coupler::Role::fv, scene, config.partner, options);
  if (options.check) {
    std::vector<std::string> notes;
    const double cells = scene.dimension == 2 ? check_run<2>(job, options, config, scene, notes)
                                              : check_run<3>(job, options, config, scene, notes);
    if (!speaks) return 0;
    for (const std::string& note : notes) std::printf("fv_solver: %s\n", note.c_str());
    for (const std::string& warning : support::scene_warnings(scene))
      std::printf("fv_solver: warning: %s\n", warning.c_str());
    std::printf("fv_solver: %s: no problem found; %.0f cells\n", options.config.c_str(), cells);
    return 0;
  }
  if (scene.dimension == 2)
    run_scene<2>(job, options, config, scene);
  else
    run_scene<3>(job, options, config, scene);
  return 0;
}

}  // namespace littoral::fv
