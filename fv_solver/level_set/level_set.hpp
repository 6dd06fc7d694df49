#pragma once

#include <cstdint>
#include <vector>

#include "boundary/window.hpp"
#include "level_set/band.hpp"
#include "level_set/extend.hpp"
#include "level_set/patches.hpp"
#include "level_set/reinitialise.hpp"
#include "level_set/transport.hpp"
#include "level_set/volume.hpp"
#include "level_set/water_bodies.hpp"

namespace littoral::fv {

struct LevelSetOptions {
  int layers = 8;            // of the band in which phi is a distance, on each side
  int extension_layers = 4;  // of air cells that hold a velocity
  int sweeps = 3;            // of the transport of phi in one inner iteration
  enum class VolumeCorrection : std::uint8_t { none, local };
  VolumeCorrection volume_correction = VolumeCorrection::none;
};

/// What a scene with a free surface holds beside p and u; nothing of it exists in other scenes. The functions
/// of this folder say what is done with it, FreeSurface in which order.
template <int D>
struct LevelSet {
  LevelSetOptions options;
  std::vector<Field> phi;                        // [block] [m] < 0 in water; ghosts included
  std::vector<VectorField<D>> surface_velocity;  // [block] [m/s] in the band
  std::vector<SurfaceForcing> forcing;           // [block]
  Band<D> band;
  SurfacePatches<D> patches;
  VelocityExtension<D> extension;
  SurfaceVelocity<D> follower;  // fills surface_velocity

  /// phi from a function that is negative in water and zero on the surface, at time t: the signed distance in
  /// the band. pre evaluate_surface_windows. throws ConfigError naming the place where it is not finite
  void initialise(const std::vector<Block<D>>& blocks, const Exchange<D>& exchange, const Prescribed& surface,
                  double t);
};

}  // namespace littoral::fv
