#pragma once

#include <cstddef>
#include <string>

#include "config.hpp"
#include "coupling/zones.hpp"
#include "particles/lattice.hpp"
#include "particles/particles.hpp"

namespace littoral::sph {

/// The region of the particles: with a partner the scene's boxes and layers, alone the whole domain.
/// throws ConfigError: layers that do not fit, or thinner than the kernel needs
template <int D>
Layers<D> region_of(const RunConfig& config, bool coupled);

/// The particles at the start, or one rank's share of them, none inside a body (walls: null without bodies).
template <int D>
void place_particles(const RunConfig& config, const Layers<D>& layers, const Walls<D>* walls,
                     Particles<D>& particles, const LatticeShare& share = {});

/// Said when it does.
constexpr const char* k_starts_empty =
    "the region holds no particle at the start; it fills where the partner's water comes through its faces";

/// Whether the region starts without particles and may: the partner's surface goes on through it.
/// throws ConfigError: there is no particle, and none can come
template <int D>
bool starts_empty(const RunConfig& config, const Particles<D>& particles, bool coupled);

/// What a run will be, before it is one.
struct Prediction {
  std::size_t particles = 0;  // at the start
  double dt = 0.0;            // [s] the particles' limit at rest; forces or a partner may ask for less
  double steps = 0.0;         // of this dt, to the scene's end
  double memory = 0.0;        // [bytes] of particles, stages and lists, copies apart

  std::string text() const;  ///< a line each
};

/// Builds what the run builds at its start, and so finds what it would refuse.
/// throws ConfigError as region_of, place_particles, domain_of
Prediction predict(const RunConfig& config, bool coupled);

}  // namespace littoral::sph
