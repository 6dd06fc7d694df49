#pragma once

#include "littoral/coupler/partner.hpp"
#include "littoral/support/scene.hpp"

namespace littoral::support {

/// True if the free surface passes through the SPH region's open faces, so that phi crosses with p and u: the
/// scene has a free surface and, with the two solutions overlapping (forced) or an upright open face, both
/// sides hold a piece of it. Where only faces across gravity are open, as under a wave, one side has it
/// whole.
bool level_set_crosses(const Scene& scene);

/// What both programs tell their partner of the run: the same on both sides, because both read the same
/// scene.
coupler::RunPlan run_plan(const Scene& scene, double start_time = 0.0, std::int64_t start_window = 0);

}  // namespace littoral::support
