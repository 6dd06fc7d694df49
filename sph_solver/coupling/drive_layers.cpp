#include "coupling/drive_layers.hpp"

#include <exception>
#include <optional>
#include <sstream>

#include "littoral/error.hpp"

namespace littoral::sph {

namespace {

template <int D>
[[noreturn]] void no_donor(const Particles<D>& particles, std::size_t i, double time) {
  const auto x = to_vec3<D>(at<D>(particles.x, i));
  std::ostringstream text;
  text
      << "t = " << time << " s: particle " << particles.id[i] << " in the coupling layer at (" << x[0] << ", "
      << x[1] << ", " << x[2]
      << ") lies outside the partner's donor cells. Enlarge the grid beyond the SPH region's outer faces, or "
         "move the region inwards.";
  throw CouplingError(text.str());
}

}  // namespace

template <int D>
LayerCount drive_layers(Particles<D>& particles, const Layers<D>& layers, const Exterior& fv,
                        const LinearEos& eos, double spray, double time) {
  if (!layers.any_open()) return {};
  const auto n = static_cast<std::ptrdiff_t>(particles.n_owned);
  std::size_t blending = 0, driven = 0, unreached = 0;
  std::ptrdiff_t first_unreached = n;
  std::exception_ptr failure;  // nothing may leave the parallel region by itself
#pragma omp parallel for schedule(static) reduction(+ : blending, driven, unreached) \
    reduction(min : first_unreached)
  for (std::ptrdiff_t k = 0; k < n; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const Point<D> x = at<D>(particles.x, i);
    const double excess = layers.excess(x);
    const Zone zone = layers.zone(excess);
    particles.zone[i] = zone;
    if (zone == Zone::interior) continue;
    try {
      const auto state = fv.at(to_vec3<D>(x), time, particles.donor_hint[i]);
      if (!state || (fv.with_phi() && state->phi > spray)) {
        ++unreached;
        first_unreached = k < first_unreached ? k : first_unreached;
        continue;
      }
      const double w_sph = layers.sph_weight(excess);  // (17)
      const double w_fv = 1.0 - w_sph;
      particles.p[i] = w_fv * state->p + w_sph * particles.p[i];
      for (std::size_t d = 0; d < D; ++d)
        particles.u[d][i] = w_fv * state->u[space_axis<D>(d)] + w_sph * particles.u[d][i];
      particles.rho[i] = eos.density(particles.p[i]);
      particles.V[i] = particles.m[i] / particles.rho[i];
      ++(zone == Zone::blending ? blending : driven);
    } catch (...) {
#pragma omp critical(littoral_drive_layers)
      failure = std::current_exception();
    }
  }
  if (failure) std::rethrow_exception(failure);
  if (unreached > 0 && !fv.with_phi()) no_donor(particles, static_cast<std::size_t>(first_unreached), time);
  return {blending, driven, unreached};
}

template LayerCount drive_layers<2>(Particles<2>&, const Layers<2>&, const Exterior&, const LinearEos&,
                                    double, double);
template LayerCount drive_layers<3>(Particles<3>&, const Layers<3>&, const Exterior&, const LinearEos&,
                                    double, double);

}  // namespace littoral::sph
