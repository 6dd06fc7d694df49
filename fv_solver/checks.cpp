#include "checks.hpp"

#include "littoral/error.hpp"
#include "littoral/support/run_plan.hpp"

namespace littoral::fv {

void check_scene(const support::Scene& scene) {
  if (support::level_set_crosses(scene))
    throw ConfigError(
        "the free surface passes through the SPH region's open faces, or the region overlaps the grid, so "
        "that "
        "the level set would have to cross; fv_solver computes water only: let the region reach from side to "
        "side of the domain, as under a wave, with coupling.kind: imposed");
}

}  // namespace littoral::fv
