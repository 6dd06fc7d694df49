#include "coupling/coupling_hooks.hpp"

#include <cmath>

namespace littoral::sph {

template <int D>
CouplingHooks<D>::CouplingHooks(const Layers<D>& layers, const Numerics<D>& numerics, const Exterior& fv,
                                Removal removal, FaceRows rows)
    : layers_(layers),
      fv_(fv),
      eos_(numerics.eos),
      kernel_radius_(numerics.kernel_radius),
      spacing_(numerics.spacing),
      exchange_(layers, numerics.eos, numerics.spacing, removal, rows) {}

template <int D>
void CouplingHooks<D>::after_stage(Particles<D>& particles, double t) {
  count_ = drive_layers(particles, layers_, fv_, eos_, spacing_, t);
}

template <int D>
void CouplingHooks<D>::after_step(Particles<D>& particles, double t, double dt) {
  exchange_.step(particles, fv_, t, dt);
}

template <int D>
void CouplingHooks<D>::adjust_shift(Particles<D>& particles, double /*t*/) {
  for (std::size_t i = 0; i < particles.n_owned; ++i) {
    if (particles.zone[i] == Zone::interior) continue;
    const auto blocked = layers_.blocked_normals(at<D>(particles.x, i), kernel_radius_);
    for (std::size_t d = 0; d < D; ++d)
      if (blocked[d]) particles.shift[d][i] = 0.0;
  }
}

template <int D>
void CouplingHooks<D>::adjust_surface(Particles<D>& particles, double t) {
  for (std::size_t i = 0; i < particles.n_owned; ++i) {
    if (particles.zone[i] == Zone::interior) continue;
    const Point<D> x = at<D>(particles.x, i);
    bool truncated = false;
    for (const bool blocked : layers_.blocked_normals(x, kernel_radius_)) truncated = truncated || blocked;
    if (!truncated) continue;
    particles.surface[i] = SurfaceFlag::none;
    if (!fv_.with_phi()) continue;
    const auto here = fv_.at(to_vec3<D>(x), t, particles.donor_hint[i]);
    // the outer row's centres lie half a spacing under the surface, the next row's one and a half (20)
    if (!here || here->phi < -spacing_) continue;
    Point<D> normal{};
    double length = 0.0;
    for (std::size_t d = 0; d < D; ++d) {
      normal[d] = phi_slope(fv_, to_vec3<D>(x), here->phi, space_axis<D>(d), 0.5 * spacing_, t,
                            particles.donor_hint[i]);
      length += normal[d] * normal[d];
    }
    if (length <= 0.0) continue;
    particles.surface[i] = SurfaceFlag::surface;
    for (std::size_t d = 0; d < D; ++d) particles.normal[d][i] = normal[d] / std::sqrt(length);
  }
}

template class CouplingHooks<2>;
template class CouplingHooks<3>;

}  // namespace littoral::sph
