// Inner iterations compared on a scene: cycles and processor seconds of the default, of approximate
// factorisation and full approximation storage, and of the paper's plain dual time, on the same steps.
//   fv_methods FV_YAML STEPS [fv.KEY=VALUE | scene.KEY=VALUE] ...
// The first three steps, which are impulsive, are not counted.
#include <omp.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include "dual_time/plain.hpp"
#include "fas.hpp"
#include "implicit/multigrid_solver.hpp"
#include "littoral/error.hpp"
#include "setup.hpp"

namespace {

using namespace littoral::fv;

struct Method {
  std::string name;
  std::unique_ptr<StepSolver<2>> solver;
  const FasSolver* fas = nullptr;  // if it is one
};

std::vector<Method> methods(const FvConfig& config) {
  std::vector<Method> all;
  all.push_back({"linear multigrid (default)", std::make_unique<MultigridSolver<2, float>>(), nullptr});
  const auto fas = [&](const std::string& name, Relaxation relaxation, int levels, int pre, int post,
                       int anderson) {
    FasOptions options;
    options.relaxation = relaxation;
    options.max_levels = levels;
    options.pre = pre;
    options.post = post;
    options.anderson_depth = anderson;
    auto solver = std::make_unique<FasSolver>(options, config.overset);
    const FasSolver* same = solver.get();
    all.push_back({name, std::move(solver), same});
  };
  constexpr int k_levels = 6;
  fas("ADI", Relaxation::adi, 1, 1, 0, 0);
  fas("ADI, Anderson", Relaxation::adi, 1, 1, 0, 2);
  fas("FAS V(2,1), ADI", Relaxation::adi, k_levels, 2, 1, 0);
  fas("FAS V(2,1), ADI, Anderson", Relaxation::adi, k_levels, 2, 1, 2);
  fas("FAS V(1,1), lines", Relaxation::lines, k_levels, 1, 1, 0);
  fas("FAS V(1,1), lines, Anderson", Relaxation::lines, k_levels, 1, 1, 2);
  all.push_back(
      {"plain dual time", std::make_unique<PlainDualTime<2>>(config.dual_time.pseudo_cfl), nullptr});
  return all;
}

void compare(const FvConfig& config, const littoral::support::Scene& scene, int steps) {
  constexpr int k_start = 3, k_most = 300;
  if (!config.time.dt) throw littoral::ConfigError("fv_methods needs time.dt in fv.yaml");
  for (Method& method : methods(config)) {
    Stepper<2> stepper = make_stepper<2>(config, scene);
    stepper.tolerance().max_cycles = k_most;
    stepper.set_inner(std::move(method.solver));
    std::printf("  %-30s", method.name.c_str());
    std::fflush(stdout);
    double cells = 0.0, seconds = 0.0;
    for (const Block<2>& block : stepper.blocks()) cells += static_cast<double>(block.extent.cells());
    int cycles = 0, most = 0;
    bool converged = true;
    try {
      for (int step = 0; step < k_start + steps; ++step) {
        const std::clock_t begin = std::clock();
        const StepReport report = stepper.advance(*config.time.dt);
        if (step < k_start) continue;
        seconds += static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
        cycles += report.cycles;
        most = std::max(most, report.cycles);
        converged = converged && report.converged;
      }
      std::printf(" %6.1f cycles, most %3d%s   %8.2f s a step and million cells",
                  static_cast<double>(cycles) / steps, most, converged ? "" : " (not converged)",
                  1e6 * seconds / (steps * cells));
      if (method.fas != nullptr) std::printf(", %d levels", method.fas->n_levels());
      std::printf("\n");
    } catch (const littoral::StabilityError& lost) {
      std::printf(" diverges (%.60s)\n", lost.what());
    }
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "fv_methods FV_YAML STEPS [fv.KEY=VALUE | scene.KEY=VALUE] ...\n");
    return 2;
  }
  omp_set_num_threads(1);
  std::vector<std::string> of_fv, of_scene;
  for (int i = 3; i < argc; ++i) {
    const std::string setting = argv[i];
    if (setting.rfind("scene.", 0) == 0)
      of_scene.push_back(setting.substr(6));
    else
      of_fv.push_back(setting.rfind("fv.", 0) == 0 ? setting.substr(3) : setting);
  }
  try {
    littoral::support::Scene scene;
    const FvConfig config = FvConfig::from_file(argv[1], of_fv, of_scene, scene);
    compare(config, scene, std::atoi(argv[2]));
  } catch (const std::exception& problem) {
    std::fprintf(stderr, "fv_methods: %s\n", problem.what());
    return 1;
  }
  return 0;
}
