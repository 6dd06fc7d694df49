#include "physics/riemann_fluxes.hpp"

#include "physics/kernel.hpp"

namespace littoral::sph {
namespace {

/// Sums over the neighbours of one particle: sum V_j F r (u_E - u_i) and sum V_j F (p_E - p0) x_ij.
template <int D>
struct Sums {
  double volume = 0.0;
  std::array<double, D> force{};
};

/// What one particle sees of the faces towards its neighbours. Velocities along the pair and their
/// differences are those times the distance r, which saves a division; the limiters do not mind a factor.
template <int D, class Real, Reconstruction variant, RiemannSolver solver>
Sums<D> sum_pairs(const PairRows<D, Real>& rows, Real R, const LinearEos& eos, std::size_t i,
                  const std::int32_t* list, std::size_t count) {
  using Rows = PairRows<D, Real>;
  using Vector = Lanes<Real>;
  constexpr bool k_second_order = variant != Reconstruction::first_order;
  constexpr std::size_t k_read = Rows::whole_units(Rows::k_n_state);
  constexpr std::size_t k_read_face = k_second_order ? Rows::k_face_stride : Rows::whole_units(1);
  const Real *states = rows.states(), *faces = rows.faces();
  const Real *own = rows.state(i).q, *own_face = rows.face(i).q;
  const Real p_i = own[Rows::k_p], rho_i = own_face[Rows::k_rho];
  const Real inv_R = 1 / R, c = static_cast<Real>(eos.c), inv_c = 1 / c;
  const Vector least = broadcast<Real>(static_cast<Real>(k_least_distance * k_least_distance) * R * R);
  Vector volume = {}, force[D] = {};
  for_each_group<Real>(list, count, i, [&](const std::int32_t* j) {
    Vector q[k_read], face[k_read_face], x[D];
    load_rows<k_read, Rows::k_state_stride>(states, j, q);
    load_rows<k_read_face, Rows::k_face_stride>(faces, j, face);
    separations(q, rows, i, x);
    Vector r2 = x[0] * x[0], u_i = own[Rows::k_u] * x[0], u_j = q[Rows::k_u] * x[0];
    for (std::size_t d = 1; d < D; ++d) {
      r2 += x[d] * x[d];
      u_i += own[Rows::k_u + d] * x[d];
      u_j += q[Rows::k_u + d] * x[d];
    }
    const Vector r = sqrt(largest(r2, least));
    const Vector rho_j = face[Rows::k_rho], rho_sum = rho_i + rho_j;
    const Vector inverse = Real(1) / (r * rho_sum);  // one division for 1/r and the weight of (12)
    const Vector inv_r = rho_sum * inverse, weight = r * inverse;
    const Vector s = largest(Real(1) - r * inv_R, Vector{});
    const Vector f = q[Rows::k_V] * (s * s * s);  // -V_j W'/r
    const Vector p_j = q[Rows::k_p];
    Vector u_l = u_i, u_r = u_j, p_l = broadcast(p_i), p_r = p_j;
    if constexpr (k_second_order) {
      Vector dp_i = {}, dp_j = {}, du_i = {}, du_j = {};
      std::size_t next = Rows::k_strain;
      for (std::size_t a = 0; a < D; ++a) {
        dp_i += own_face[Rows::k_grad_p + a] * x[a];
        dp_j += face[Rows::k_grad_p + a] * x[a];
        for (std::size_t b = a; b < D; ++b, ++next) {
          const Vector xx = x[a] * x[b];
          du_i += own_face[next] * xx;
          du_j += face[next] * xx;
        }
      }
      const Vector du = u_j - u_i, dp = p_j - p_i;
      p_l += Real(0.5) * limited_difference<variant>(dp_i, dp);
      p_r -= Real(0.5) * limited_difference<variant>(dp_j, dp);
      u_l += Real(0.5) * limited_difference<variant>(du_i, du);
      u_r -= Real(0.5) * limited_difference<variant>(du_j, du);
    }
    const Vector closing = (u_l - u_r) * inv_r;
    const Vector u_face = weight * (rho_i * u_l + rho_j * u_r + inv_c * (p_l - p_r) * r);  // (12)
    const Vector p_face = weight * (rho_j * p_l + rho_i * p_r +
                                    dissipation_speed<solver>(closing, c) * rho_i * rho_j * closing);
    volume += f * (u_face - u_i);
    const Vector pressure = f * p_face;
    for (std::size_t d = 0; d < D; ++d) force[d] += pressure * x[d];
  });
  Sums<D> sums;
  sums.volume = sum(volume);
  for (std::size_t d = 0; d < D; ++d) sums.force[d] = sum(force[d]);
  return sums;
}

template <int D, class Real, Reconstruction variant, RiemannSolver solver>
void loop(const Particles<D>& particles, const PairRows<D, Real>& rows, const NeighborList<D>& neighbors,
          const LinearEos& eos, Rate<D>& rate) {
  const auto R = static_cast<Real>(neighbors.kernel_radius());
  const auto n = static_cast<std::ptrdiff_t>(particles.n_owned);
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t row = 0; row < n; ++row) {
    const auto i = static_cast<std::size_t>(row);
    const std::size_t begin = neighbors.start()[i];
    const auto sums = sum_pairs<D, Real, variant, solver>(rows, R, eos, i, neighbors.list() + begin,
                                                          neighbors.start()[i + 1] - begin);
    const double twice = 2.0 * particles.V[i];
    rate.volume[i] = twice * sums.volume;
    for (std::size_t d = 0; d < D; ++d) rate.acceleration[d][i] = -twice / particles.m[i] * sums.force[d];
  }
}

template <int D, class Real, RiemannSolver solver>
void choose(const Particles<D>& particles, const PairRows<D, Real>& rows, const NeighborList<D>& neighbors,
            const LinearEos& eos, Reconstruction reconstruction, Rate<D>& rate) {
  switch (reconstruction) {
    case Reconstruction::first_order:
      return loop<D, Real, Reconstruction::first_order, solver>(particles, rows, neighbors, eos, rate);
    case Reconstruction::unlimited:
      return loop<D, Real, Reconstruction::unlimited, solver>(particles, rows, neighbors, eos, rate);
    case Reconstruction::minmod:
      return loop<D, Real, Reconstruction::minmod, solver>(particles, rows, neighbors, eos, rate);
    case Reconstruction::van_leer:
      return loop<D, Real, Reconstruction::van_leer, solver>(particles, rows, neighbors, eos, rate);
  }
}

}  // namespace

template <int D, class Real>
void riemann_fluxes(const Particles<D>& particles, const PairRows<D, Real>& rows,
                    const NeighborList<D>& neighbors, const LinearEos& eos, Reconstruction reconstruction,
                    RiemannSolver solver, Rate<D>& rate) {
  rate.resize(particles.n_owned);
  switch (solver) {
    case RiemannSolver::linearised:
      return choose<D, Real, RiemannSolver::linearised>(particles, rows, neighbors, eos, reconstruction,
                                                        rate);
    case RiemannSolver::low_dissipation:
      return choose<D, Real, RiemannSolver::low_dissipation>(particles, rows, neighbors, eos, reconstruction,
                                                             rate);
  }
}

template <int D>
void riemann_fluxes(const Particles<D>& particles, const NeighborList<D>& neighbors,
                    const Gradients<D>& gradients, const LinearEos& eos, Reconstruction reconstruction,
                    RiemannSolver solver, Rate<D>& rate) {
  PairRows<D, double> rows;
  rows.pack_states(particles, Kernel<D>(neighbors.kernel_radius()), eos.p0);
  if (reconstruction != Reconstruction::first_order) rows.set_gradients(gradients);
  riemann_fluxes(particles, rows, neighbors, eos, reconstruction, solver, rate);
}

template void riemann_fluxes(const Particles<2>&, const PairRows<2, double>&, const NeighborList<2>&,
                             const LinearEos&, Reconstruction, RiemannSolver, Rate<2>&);
template void riemann_fluxes(const Particles<2>&, const PairRows<2, float>&, const NeighborList<2>&,
                             const LinearEos&, Reconstruction, RiemannSolver, Rate<2>&);
template void riemann_fluxes(const Particles<3>&, const PairRows<3, double>&, const NeighborList<3>&,
                             const LinearEos&, Reconstruction, RiemannSolver, Rate<3>&);
template void riemann_fluxes(const Particles<3>&, const PairRows<3, float>&, const NeighborList<3>&,
                             const LinearEos&, Reconstruction, RiemannSolver, Rate<3>&);
template void riemann_fluxes<2>(const Particles<2>&, const NeighborList<2>&, const Gradients<2>&,
                                const LinearEos&, Reconstruction, RiemannSolver, Rate<2>&);
template void riemann_fluxes<3>(const Particles<3>&, const NeighborList<3>&, const Gradients<3>&,
                                const LinearEos&, Reconstruction, RiemannSolver, Rate<3>&);

}  // namespace littoral::sph
