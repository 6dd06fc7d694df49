#pragma once

#include "coupling/coupling_config.hpp"
#include "coupling/drive_layers.hpp"
#include "coupling/exterior.hpp"
#include "coupling/particle_exchange.hpp"
#include "coupling/zones.hpp"
#include "physics/numerics.hpp"
#include "physics/step_hooks.hpp"

namespace littoral::sph {

/// What the coupling does inside a step: drives the layers at each stage, lets particles in and out at the
/// end, and keeps shifting and surface detection honest where the outer face cuts their kernels.
template <int D>
class CouplingHooks final : public StepHooks<D> {
 public:
  CouplingHooks(const Layers<D>& layers, const Numerics<D>& numerics, const Exterior& fv, Removal removal,
                FaceRows rows = FaceRows::level);

  /// (17) with FV's state at the stage's time; (24).
  void after_stage(Particles<D>& particles, double t) override;
  /// (18), (19): integrates the faces over the step, removes, injects.
  void after_step(Particles<D>& particles, double t, double dt) override;
  /// Within a kernel radius of an outer face the shift keeps its tangential part only: the full vector on a
  /// truncated kernel pushes particles out.
  void adjust_shift(Particles<D>& particles, double t) override;
  /// Within a kernel radius of an outer face, where a truncated kernel looks like a surface: flag and normal
  /// follow FV's phi; without phi there is no surface there.
  void adjust_surface(Particles<D>& particles, double t) override;

  const Layers<D>& layers() const { return layers_; }
  ParticleExchange<D>& exchange() { return exchange_; }
  const ParticleExchange<D>& exchange() const { return exchange_; }
  const LayerCount& layer_count() const { return count_; }  ///< of the last stage

 private:
  Layers<D> layers_;
  const Exterior& fv_;
  LinearEos eos_;
  double kernel_radius_;
  double spacing_;
  ParticleExchange<D> exchange_;
  LayerCount count_;
};

}  // namespace littoral::sph
