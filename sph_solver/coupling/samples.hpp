#pragma once

#include "bodies/walls.hpp"
#include "boundary/ghosts.hpp"
#include "coupling/surface_distance.hpp"
#include "coupling/zones.hpp"
#include "littoral/coupler/fields.hpp"
#include "particles/particles.hpp"

namespace littoral::sph {

/// How values at FV's points are made from particles.
///   shepard    sum(W V q) / sum(W V): exact for constants only; below a flat surface it reads a hydrostatic
///              field 0.21 R too deep. Fit for complete supports
///   corrected  moving least squares with a linear basis, weights W V: exact for linear fields on any support
///   quadratic  the same with a parabolic basis where the support is whole, corrected elsewhere: of a vortex,
///              corrected takes the part .55 dx^2 lap(u) of its velocity (R = 4 dx in 2-D) at each crossing
enum class SampleMethod { shepard, corrected, quadratic };

struct SampleRules {
  SampleMethod method = SampleMethod::corrected;
  double kernel_radius = 0.0;      // R [m]
  bool free_surface = false;       // a target without particles is dry, not uncovered
  std::array<double, 3> weight{};  // rho0 g [N/m^3], x y z
};

/// p and u at the targets from the free and the blending particles; driven ones only repeat FV's own values.
/// Where the linear basis cannot be fitted (too few particles, or all on a line) Shepard's value serves;
/// where the coverage sum(V W) is below a quarter, less than the corner of a body of water has, there is no
/// value: the point is dry in a scene with a free surface, else uncovered. Points outside the nominal box and
/// its blending layers are uncovered. Of a kernel that bodies cut, the coverage is that of the part they
/// leave.
///
/// Corrected samples are of p beyond the weight of still water, which is added again: behind a symmetry plane
/// stands the mirror image of that, not of p, whose slope changes its sign there (the grid read p .3 rho g dx
/// too low above a floor, and flowed that way).
///
/// in    particles, owned and copies, with positions and states of `time`; walls: null without bodies;
///       ghosts: of the copies, null where there are none
///
/// out   samples: all but phi; the same on any number of threads
///
/// comm  local. throws nothing
template <int D>
void sample_states(const Particles<D>& particles, const Layers<D>& layers, const SampleRules& rules,
                   const coupler::Targets& targets, coupler::Samples& samples,
                   const Walls<D>* walls = nullptr, const Ghosts<D>* ghosts = nullptr);

/// phi at the targets that want it. Beyond `band` [m] from the surface phi is +-band, its sign from the
/// coverage.
/// in    samples.coverage from sample_states
template <int D>
void sample_level_set(const SurfaceDistance<D>& surface, double band, const coupler::Targets& targets,
                      coupler::Samples& samples);

/// p at the targets near the surface anew, so that it is p0 [Pa] there:
///   p = p0 + phi sum W V phi_j (p_j - p0) / sum W V phi_j^2,  W of radius k_surface_kernel
/// whole down to k_surface_depth under it, none a spacing deeper, in between the mean of both. What
/// sample_states makes of one side of a surface is biased by a part of a spacing's weight, and the grid,
/// forced to it, answers with currents (experiment: 1.7e-2 instead of 6e-3 m/s in still water H/dx = 32).
/// in/out samples, phi known. pre surface reaches k_surface_depth + 1 + k_surface_kernel spacings deep
template <int D>
void constrain_pressure(const Particles<D>& particles, const Layers<D>& layers,
                        const SurfaceDistance<D>& surface, double spacing, double p0,
                        const coupler::Targets& targets, coupler::Samples& samples);
constexpr double k_surface_depth = 2.0, k_surface_kernel = 3.0;  // [spacings]

}  // namespace littoral::sph
