#include "bodies/wall_fluxes.hpp"

#include <type_traits>

#include "bodies/wall_state.hpp"
#include "physics/kernel.hpp"

namespace littoral::sph {
namespace {

template <Reconstruction variant>
using Variant = std::integral_constant<Reconstruction, variant>;

/// One-sided problems: the wall's answer depends on the particle alone.
template <int D, Reconstruction variant>
struct OneSided {
  double c;
  WallFace<D> operator()(const PairSide<D>& i, WallView<D>& view, std::size_t e, const Vector<D>& dx,
                         const Vector<D>& f) const {
    return wall_face<D, variant>(i, view.plane(e), dx, f, c);
  }
};

/// Two-sided problems with the dummies' states.
template <int D, Reconstruction variant>
struct TwoSided {
  const Dummies<D>& dummies;
  const DummyStates<D>& states;
  LinearEos eos;
  double kernel_radius;
  WallFace<D> operator()(const PairSide<D>& i, WallView<D>&, std::size_t e, const Vector<D>& dx,
                         const Vector<D>& f) const {
    const double p = states.pressure(e);
    const DummySide<D> dummy{states.velocity(e), dummies[e].a, p, eos.density(p)};
    return dummy_face<D, variant>(i, dummy, dx, f, eos.c, kernel_radius);
  }
};

template <int D, bool gradients_count, class Face>
void loop(const Particles<D>& particles, const Gradients<D>& gradients, const std::vector<Body>& bodies,
          const Dummies<D>& dummies, const WallList<D>& list, const RowAccelerations<D>& mass_force,
          const Numerics<D>& numerics, double level, std::size_t n_bodies, const Face& face_of, Rate<D>& rate,
          RowForces<D>& forces) {
  const Kernel<D> kernel(numerics.kernel_radius);
  const double R2 = kernel.R * kernel.R;
  const double V = dummies.volume();
  const auto n = static_cast<std::ptrdiff_t>(list.n_rows());
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t k = 0; k < n; ++k) {
    const auto row = static_cast<std::size_t>(k);
    const std::size_t i = list.particle(row);
    const auto x = at<D>(particles.x, i);
    PairSide<D> side{at<D>(particles.u, i), particles.p[i], particles.rho[i], {}, {}};
    if constexpr (gradients_count) {
      side.grad_p = at<D>(gradients.p, row);
      for (std::size_t d = 0; d < D; ++d) side.grad_u[d] = at<D>(gradients.u[d], row);
    }
    WallView<D> view(bodies, dummies, list, row, x);
    double volume = 0.0;
    Vector<D> total{};
    for (std::size_t pair = list.begin(row); pair < list.end(row); ++pair) {
      const std::size_t e = list.dummy(pair);
      Vector<D> dx = dummies[e].x;
      for (std::size_t d = 0; d < D; ++d) dx[d] -= x[d];
      const double r2 = dot_of<D>(dx, dx);
      if (r2 >= R2) continue;                                    // most pairs of the skin
      const double f = -V * kernel.slope_over_r(std::sqrt(r2));  // V grad W = f dx
      const WallFace<D> face = face_of(side, view, e, dx, mass_force[row]);
      volume += f * dot_of<D>(face.jump, dx);
      auto& force = forces[row * n_bodies + static_cast<std::size_t>(dummies[e].body)];
      for (std::size_t d = 0; d < D; ++d) {
        const double push = 2.0 * particles.V[i] * f * (face.p - level) * dx[d];
        force[d] += push;
        total[d] += push;
      }
    }
    rate.volume[i] += 2.0 * particles.V[i] * volume;
    for (std::size_t d = 0; d < D; ++d) rate.acceleration[d][i] -= total[d] / particles.m[i];
  }
}

}  // namespace

template <int D>
void add_wall_fluxes(const Particles<D>& particles, const Gradients<D>& gradients,
                     const std::vector<Body>& bodies, const Dummies<D>& dummies, const DummyStates<D>& states,
                     const WallList<D>& list, const RowAccelerations<D>& mass_force,
                     const Numerics<D>& numerics, double level, std::size_t n_bodies, Rate<D>& rate,
                     RowForces<D>& forces) {
  forces.assign(list.n_rows() * n_bodies, {});
  const bool two_sided = numerics.wall_states == WallStates::extrapolated;
  const auto with = [&](auto variant) {
    constexpr Reconstruction v = decltype(variant)::value;
    constexpr bool second_order = v != Reconstruction::first_order;
    const auto run = [&](const auto& face) {
      loop<D, second_order>(particles, gradients, bodies, dummies, list, mass_force, numerics, level,
                            n_bodies, face, rate, forces);
    };
    if (two_sided)
      run(TwoSided<D, v>{dummies, states, numerics.eos, numerics.kernel_radius});
    else
      run(OneSided<D, v>{numerics.eos.c});
  };
  const bool constant = numerics.wall_states == WallStates::constant;
  switch (constant ? Reconstruction::first_order : numerics.reconstruction) {
    case Reconstruction::first_order:
      return with(Variant<Reconstruction::first_order>{});
    case Reconstruction::unlimited:
      return with(Variant<Reconstruction::unlimited>{});
    case Reconstruction::minmod:
      return with(Variant<Reconstruction::minmod>{});
    case Reconstruction::van_leer:
      return with(Variant<Reconstruction::van_leer>{});
  }
}

template void add_wall_fluxes<2>(const Particles<2>&, const Gradients<2>&, const std::vector<Body>&,
                                 const Dummies<2>&, const DummyStates<2>&, const WallList<2>&,
                                 const RowAccelerations<2>&, const Numerics<2>&, double, std::size_t,
                                 Rate<2>&, RowForces<2>&);
template void add_wall_fluxes<3>(const Particles<3>&, const Gradients<3>&, const std::vector<Body>&,
                                 const Dummies<3>&, const DummyStates<3>&, const WallList<3>&,
                                 const RowAccelerations<3>&, const Numerics<3>&, double, std::size_t,
                                 Rate<3>&, RowForces<3>&);

}  // namespace littoral::sph
