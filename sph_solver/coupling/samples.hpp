#pragma once

#include "bodies/walls.hpp"
#include "boundary/ghosts.hpp"
#include "coupling/zones.hpp"
#include "littoral/coupler/fields.hpp"
#include "particles/particles.hpp"

namespace littoral::sph {

/// How values at FV's points are made from particles.
///   shepard    sum(W V q) / sum(W V): exact for constants only; below a flat surface it reads a hydrostatic
///              field 0.21 R too deep. Fit for complete supports
///   corrected  moving least squares with a linear basis, weights W V: exact for linear fields on any support
enum class SampleMethod { shepard, corrected };

struct SampleRules {
  SampleMethod method = SampleMethod::corrected;
  double kernel_radius = 0.0;  // R [m]
  bool free_surface = false;   // a target without particles is dry, not uncovered
};

/// p and u at the targets from the free and the blending particles; driven ones only repeat FV's own values.
/// Where the linear basis cannot be fitted (too few particles, or all on a line) Shepard's value serves;
/// where the coverage sum(V W) is below a quarter, less than the corner of a body of water has, there is no
/// value: the point is dry in a scene with a free surface, else uncovered. Points outside the nominal box and
/// its blending layers are uncovered. Of a kernel that bodies cut, the coverage is that of the part they
/// leave.
///
/// in    particles, owned and copies, with positions and states of `time`; walls: null without bodies
///
/// out   samples: all but phi; the same on any number of threads
///
/// comm  local. throws nothing
template <int D>
void sample_states(const Particles<D>& particles, const Layers<D>& layers, const SampleRules& rules,
                   const coupler::Targets& targets, coupler::Samples& samples,
                   const Walls<D>* walls = nullptr);

/// phi at the targets that want it, from the surface particles: (20), averaged with the kernel over the
/// surface particles around the nearest one (a single particle's position is noise of .03 dx). Beyond `band`
/// from the surface phi is +-band, its sign from the coverage.
/// in    particles.surface, .normal of the owned, and their copies; samples.coverage from sample_states
template <int D>
void sample_level_set(const Particles<D>& particles, const Ghosts<D>& ghosts, const SampleRules& rules,
                      double spacing, double band, const coupler::Targets& targets,
                      coupler::Samples& samples);

}  // namespace littoral::sph
