#include "littoral/support/run_plan.hpp"

#include <cmath>

namespace littoral::support {

bool level_set_crosses(const Scene& scene) {
  if (!scene.has_free_surface() || scene.coupling.kind == Scene::CouplingKind::none) return false;
  if (scene.coupling.kind == Scene::CouplingKind::forced) return true;
  for (const auto& region : scene.regions)
    for (std::size_t d = 0; d < 3; ++d) {
      if ((scene.dimension == 2 && d == 1) || std::fabs(scene.gravity[d]) > 0.0) continue;
      const double tolerance = 1e-9 * (scene.domain.upper[d] - scene.domain.lower[d]);
      if (region.lower[d] > scene.domain.lower[d] + tolerance) return true;
      if (region.upper[d] < scene.domain.upper[d] - tolerance) return true;
    }
  return false;
}

coupler::RunPlan run_plan(const Scene& scene, double start_time, std::int64_t start_window) {
  coupler::RunPlan plan;
  plan.schedule = scene.coupling.schedule;
  plan.window = scene.coupling.window;
  plan.start_time = start_time;
  plan.start_window = start_window;
  plan.end_time = scene.time.end;
  plan.max_windows = scene.time.max_windows;
  plan.deadline = scene.coupling.deadline;
  plan.with_phi = level_set_crosses(scene);
  return plan;
}

}  // namespace littoral::support
