#pragma once

#include "particles/particles.hpp"

namespace littoral::sph {

/// What someone outside does to the particles during a step: the coupling drives its layers and lets
/// particles in and out. Only owned particles are touched; whoever appends or removes has dropped the copies
/// by that.
template <int D>
struct StepHooks {
  virtual ~StepHooks() = default;
  /// At time t, before anything else. May append, remove.
  virtual void before_step(Particles<D>&, double /*t*/, double /*dt*/) {}
  /// After surface particles were found, before those near them are: may correct flags and normals.
  virtual void adjust_surface(Particles<D>&, double /*t*/) {}
  /// After the shift was computed: may take components away.
  virtual void adjust_shift(Particles<D>&, double /*t*/) {}
  /// After each update, positions and states of time t (rk4: t + dt/2, t + dt/2, t + dt, t + dt).
  virtual void after_stage(Particles<D>&, double /*t*/) {}
  /// At the end, positions and states of t + dt. May append, remove.
  virtual void after_step(Particles<D>&, double /*t*/, double /*dt*/) {}
};

}  // namespace littoral::sph
