#pragma once

#include <cstddef>

#include "coupling/exterior.hpp"
#include "coupling/zones.hpp"
#include "particles/particles.hpp"
#include "physics/eos.hpp"

namespace littoral::sph {

/// What one pass over the layers found.
struct LayerCount {
  std::size_t blending = 0;
  std::size_t driven = 0;
  std::size_t unreached = 0;  ///< in a layer, but FV has no state there: spray above its water; left free
};

/// Gives the particles of the layers their state, at every stage and at the end of a step:
/// driven: u and p are FV's at the particle; blending: (17) between SPH's own and FV's. In both the density
/// follows from p and the volume from the particle's constant mass, V = m / rho(p).
/// in    particles.x, .u, .p, .m of the owned part, at `time`
///       spray: height above FV's surface [m] from which on a particle is left free, as where FV has no state
/// out   particles.zone of all owned; .u, .p, .rho, .V and .donor_hint in the layers
/// comm  local
/// throws CouplingError: a particle of a layer without donors in a scene without free surface, or a time past
///        the donors' horizon
template <int D>
LayerCount drive_layers(Particles<D>& particles, const Layers<D>& layers, const Exterior& fv,
                        const LinearEos& eos, double spray, double time);

}  // namespace littoral::sph
