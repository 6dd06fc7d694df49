#include "physics/riemann_fluxes.hpp"

#include "physics/kernel.hpp"

namespace littoral::sph {
namespace {

constexpr double k_least_distance = 1e-9;  // of R; keeps 1/r finite for coincident particles

/// Sums over the neighbours of one particle: sum V_j F r (u_E - u_i) and sum V_j F (p_E - p0) x_ij.
template <int D>
struct Sums {
  double volume;
  std::array<double, D> force;
};

template <Reconstruction variant, RiemannSolver solver>
Sums<2> sum_pairs(const Particles<2>& particles, const Gradients<2>& gradients, const Kernel<2>& kernel,
                  const LinearEos& eos, std::size_t i, const std::int32_t* __restrict list,
                  std::size_t count) {
  constexpr bool k_second_order = variant != Reconstruction::first_order;
  const double* __restrict x = particles.x[0].data();
  const double* __restrict z = particles.x[1].data();
  const double* __restrict u = particles.u[0].data();
  const double* __restrict w = particles.u[1].data();
  const double* __restrict p = particles.p.data();
  const double* __restrict V = particles.V.data();
  const double* __restrict rho = particles.rho.data();
  const double* __restrict px = gradients.p[0].data();
  const double* __restrict pz = gradients.p[1].data();
  const double* __restrict ux = gradients.u[0][0].data();
  const double* __restrict uz = gradients.u[0][1].data();
  const double* __restrict wx = gradients.u[1][0].data();
  const double* __restrict wz = gradients.u[1][1].data();
  const double xi = x[i], zi = z[i], ui = u[i], wi = w[i], pi = p[i], rhoi = rho[i];
  double pxi = 0, pzi = 0, uxi = 0, uzi = 0, wxi = 0, wzi = 0;
  if constexpr (k_second_order) pxi = px[i], pzi = pz[i], uxi = ux[i], uzi = uz[i], wxi = wx[i], wzi = wz[i];
  const double inv_R = kernel.inv_R, slope = -kernel.slope, p0 = eos.p0, c = eos.c, inv_c = 1.0 / eos.c;
  const double least = k_least_distance * k_least_distance * kernel.R * kernel.R;
  double volume = 0, fx = 0, fz = 0;
#pragma omp simd reduction(+ : volume, fx, fz)
  for (std::size_t k = 0; k < count; ++k) {
    const std::int32_t j = list[k];
    const double dx = x[j] - xi, dz = z[j] - zi;
    const double rr = dx * dx + dz * dz;
    const double r2 = rr > least ? rr : least;
    const double inv_r = 1.0 / std::sqrt(r2);
    const double r = r2 * inv_r;
    const double s = 1.0 - r * inv_R;
    const double q = s > 0.0 ? s : 0.0;
    const double f = slope * V[j] * q * q * q;  // -V_j W'/r
    const double ex = dx * inv_r, ez = dz * inv_r;
    const double uj = u[j], wj = w[j], pj = p[j], rhoj = rho[j];
    const double un_i = ui * ex + wi * ez;
    double u_l = un_i, u_r = uj * ex + wj * ez, p_l = pi, p_r = pj;
    if constexpr (k_second_order) {
      const double du = u_r - u_l, dp = pj - pi;
      const double dp_l = pxi * dx + pzi * dz, dp_r = px[j] * dx + pz[j] * dz;
      const double du_l = ex * (uxi * dx + uzi * dz) + ez * (wxi * dx + wzi * dz);
      const double du_r = ex * (ux[j] * dx + uz[j] * dz) + ez * (wx[j] * dx + wz[j] * dz);
      p_l += 0.5 * limited_difference<variant>(dp_l, dp);
      p_r -= 0.5 * limited_difference<variant>(dp_r, dp);
      u_l += 0.5 * limited_difference<variant>(du_l, du);
      u_r -= 0.5 * limited_difference<variant>(du_r, du);
    }
    // riemann_state() written out: this compiler keeps the lanes only without a struct in between
    const double weight = 1.0 / (rhoi + rhoj), speed = dissipation_speed<solver>(u_l - u_r, c);
    const double u_face = weight * (rhoi * u_l + rhoj * u_r + inv_c * (p_l - p_r));
    const double p_face = weight * (rhoj * p_l + rhoi * p_r + speed * rhoi * rhoj * (u_l - u_r));
    volume += f * r * (u_face - un_i);
    const double force = f * (p_face - p0);
    fx += force * dx;
    fz += force * dz;
  }
  return {volume, {fx, fz}};
}

template <Reconstruction variant, RiemannSolver solver>
Sums<3> sum_pairs(const Particles<3>& particles, const Gradients<3>& gradients, const Kernel<3>& kernel,
                  const LinearEos& eos, std::size_t i, const std::int32_t* __restrict list,
                  std::size_t count) {
  constexpr bool k_second_order = variant != Reconstruction::first_order;
  const double* __restrict x = particles.x[0].data();
  const double* __restrict y = particles.x[1].data();
  const double* __restrict z = particles.x[2].data();
  const double* __restrict u = particles.u[0].data();
  const double* __restrict v = particles.u[1].data();
  const double* __restrict w = particles.u[2].data();
  const double* __restrict p = particles.p.data();
  const double* __restrict V = particles.V.data();
  const double* __restrict rho = particles.rho.data();
  const double* __restrict px = gradients.p[0].data();
  const double* __restrict py = gradients.p[1].data();
  const double* __restrict pz = gradients.p[2].data();
  const double* __restrict ux = gradients.u[0][0].data();
  const double* __restrict uy = gradients.u[0][1].data();
  const double* __restrict uz = gradients.u[0][2].data();
  const double* __restrict vx = gradients.u[1][0].data();
  const double* __restrict vy = gradients.u[1][1].data();
  const double* __restrict vz = gradients.u[1][2].data();
  const double* __restrict wx = gradients.u[2][0].data();
  const double* __restrict wy = gradients.u[2][1].data();
  const double* __restrict wz = gradients.u[2][2].data();
  const double xi = x[i], yi = y[i], zi = z[i], ui = u[i], vi = v[i], wi = w[i], pi = p[i], rhoi = rho[i];
  double pxi = 0, pyi = 0, pzi = 0, uxi = 0, uyi = 0, uzi = 0, vxi = 0, vyi = 0, vzi = 0, wxi = 0, wyi = 0,
         wzi = 0;
  if constexpr (k_second_order) {
    pxi = px[i], pyi = py[i], pzi = pz[i];
    uxi = ux[i], uyi = uy[i], uzi = uz[i];
    vxi = vx[i], vyi = vy[i], vzi = vz[i];
    wxi = wx[i], wyi = wy[i], wzi = wz[i];
  }
  const double inv_R = kernel.inv_R, slope = -kernel.slope, p0 = eos.p0, c = eos.c, inv_c = 1.0 / eos.c;
  const double least = k_least_distance * k_least_distance * kernel.R * kernel.R;
  double volume = 0, fx = 0, fy = 0, fz = 0;
#pragma omp simd reduction(+ : volume, fx, fy, fz)
  for (std::size_t k = 0; k < count; ++k) {
    const std::int32_t j = list[k];
    const double dx = x[j] - xi, dy = y[j] - yi, dz = z[j] - zi;
    const double rr = dx * dx + dy * dy + dz * dz;
    const double r2 = rr > least ? rr : least;
    const double inv_r = 1.0 / std::sqrt(r2);
    const double r = r2 * inv_r;
    const double s = 1.0 - r * inv_R;
    const double q = s > 0.0 ? s : 0.0;
    const double f = slope * V[j] * q * q * q;  // -V_j W'/r
    const double ex = dx * inv_r, ey = dy * inv_r, ez = dz * inv_r;
    const double pj = p[j], rhoj = rho[j];
    const double un_i = ui * ex + vi * ey + wi * ez;
    double u_l = un_i, u_r = u[j] * ex + v[j] * ey + w[j] * ez, p_l = pi, p_r = pj;
    if constexpr (k_second_order) {
      const double du = u_r - u_l, dp = pj - pi;
      const double dp_l = pxi * dx + pyi * dy + pzi * dz, dp_r = px[j] * dx + py[j] * dy + pz[j] * dz;
      const double du_l = ex * (uxi * dx + uyi * dy + uzi * dz) + ey * (vxi * dx + vyi * dy + vzi * dz) +
                          ez * (wxi * dx + wyi * dy + wzi * dz);
      const double du_r = ex * (ux[j] * dx + uy[j] * dy + uz[j] * dz) +
                          ey * (vx[j] * dx + vy[j] * dy + vz[j] * dz) +
                          ez * (wx[j] * dx + wy[j] * dy + wz[j] * dz);
      p_l += 0.5 * limited_difference<variant>(dp_l, dp);
      p_r -= 0.5 * limited_difference<variant>(dp_r, dp);
      u_l += 0.5 * limited_difference<variant>(du_l, du);
      u_r -= 0.5 * limited_difference<variant>(du_r, du);
    }
    // riemann_state() written out, as above
    const double weight = 1.0 / (rhoi + rhoj), speed = dissipation_speed<solver>(u_l - u_r, c);
    const double u_face = weight * (rhoi * u_l + rhoj * u_r + inv_c * (p_l - p_r));
    const double p_face = weight * (rhoj * p_l + rhoi * p_r + speed * rhoi * rhoj * (u_l - u_r));
    volume += f * r * (u_face - un_i);
    const double force = f * (p_face - p0);
    fx += force * dx;
    fy += force * dy;
    fz += force * dz;
  }
  return {volume, {fx, fy, fz}};
}

template <int D, Reconstruction variant, RiemannSolver solver>
void loop(const Particles<D>& particles, const NeighborList<D>& neighbors, const Gradients<D>& gradients,
          const LinearEos& eos, Rate<D>& rate) {
  const Kernel<D> kernel(neighbors.kernel_radius());
  const auto n = static_cast<std::ptrdiff_t>(particles.n_owned);
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t row = 0; row < n; ++row) {
    const auto i = static_cast<std::size_t>(row);
    const std::size_t begin = neighbors.start()[i];
    const auto sums = sum_pairs<variant, solver>(particles, gradients, kernel, eos, i,
                                                 neighbors.list() + begin, neighbors.start()[i + 1] - begin);
    const double twice = 2.0 * particles.V[i];
    rate.volume[i] = twice * sums.volume;
    for (std::size_t d = 0; d < D; ++d) rate.acceleration[d][i] = -twice / particles.m[i] * sums.force[d];
  }
}

template <int D, RiemannSolver solver>
void choose(const Particles<D>& particles, const NeighborList<D>& neighbors, const Gradients<D>& gradients,
            const LinearEos& eos, Reconstruction reconstruction, Rate<D>& rate) {
  switch (reconstruction) {
    case Reconstruction::first_order:
      return loop<D, Reconstruction::first_order, solver>(particles, neighbors, gradients, eos, rate);
    case Reconstruction::unlimited:
      return loop<D, Reconstruction::unlimited, solver>(particles, neighbors, gradients, eos, rate);
    case Reconstruction::minmod:
      return loop<D, Reconstruction::minmod, solver>(particles, neighbors, gradients, eos, rate);
    case Reconstruction::van_leer:
      return loop<D, Reconstruction::van_leer, solver>(particles, neighbors, gradients, eos, rate);
  }
}

}  // namespace

template <int D>
void riemann_fluxes(const Particles<D>& particles, const NeighborList<D>& neighbors,
                    const Gradients<D>& gradients, const LinearEos& eos, Reconstruction reconstruction,
                    RiemannSolver solver, Rate<D>& rate) {
  rate.resize(particles.n_owned);
  switch (solver) {
    case RiemannSolver::linearised:
      return choose<D, RiemannSolver::linearised>(particles, neighbors, gradients, eos, reconstruction, rate);
    case RiemannSolver::low_dissipation:
      return choose<D, RiemannSolver::low_dissipation>(particles, neighbors, gradients, eos, reconstruction,
                                                       rate);
  }
}

template void riemann_fluxes<2>(const Particles<2>&, const NeighborList<2>&, const Gradients<2>&,
                                const LinearEos&, Reconstruction, RiemannSolver, Rate<2>&);
template void riemann_fluxes<3>(const Particles<3>&, const NeighborList<3>&, const Gradients<3>&,
                                const LinearEos&, Reconstruction, RiemannSolver, Rate<3>&);

}  // namespace littoral::sph
