#include "bare_pairs.hpp"

#include <cmath>

#include "physics/kernel.hpp"

namespace {

using namespace littoral::sph;

double of_one(const Particles<2>& particles, const Gradients<2>& gradients, const Kernel<2>& kernel,
              const LinearEos& eos, std::size_t i, const std::int32_t* __restrict list, std::size_t count) {
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
  pxi = px[i], pzi = pz[i], uxi = ux[i], uzi = uz[i], wxi = wx[i], wzi = wz[i];
  const double inv_R = kernel.inv_R, slope = -kernel.slope, p0 = eos.p0, c = eos.c, inv_c = 1.0 / eos.c;
  const double least = 1e-18 * kernel.R * kernel.R;
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
    const double dp_l = pxi * dx + pzi * dz, dp_r = px[j] * dx + pz[j] * dz;
    const double du_l = ex * (uxi * dx + uzi * dz) + ez * (wxi * dx + wzi * dz);
    const double du_r = ex * (ux[j] * dx + uz[j] * dz) + ez * (wx[j] * dx + wz[j] * dz);
    p_l += 0.5 * dp_l;
    p_r -= 0.5 * dp_r;
    u_l += 0.5 * du_l;
    u_r -= 0.5 * du_r;
    const double weight = 1.0 / (rhoi + rhoj);
    const double u_face = weight * (rhoi * u_l + rhoj * u_r + inv_c * (p_l - p_r));
    const double p_face = weight * (rhoj * p_l + rhoi * p_r + c * rhoi * rhoj * (u_l - u_r));
    volume += f * r * (u_face - un_i);
    const double force = f * (p_face - p0);
    fx += force * dx;
    fz += force * dz;
  }
  return volume + fx + fz;
}

double of_one(const Particles<3>& particles, const Gradients<3>& gradients, const Kernel<3>& kernel,
              const LinearEos& eos, std::size_t i, const std::int32_t* __restrict list, std::size_t count) {
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
  pxi = px[i], pyi = py[i], pzi = pz[i];
  uxi = ux[i], uyi = uy[i], uzi = uz[i];
  vxi = vx[i], vyi = vy[i], vzi = vz[i];
  wxi = wx[i], wyi = wy[i], wzi = wz[i];
  const double inv_R = kernel.inv_R, slope = -kernel.slope, p0 = eos.p0, c = eos.c, inv_c = 1.0 / eos.c;
  const double least = 1e-18 * kernel.R * kernel.R;
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
    const double dp_l = pxi * dx + pyi * dy + pzi * dz, dp_r = px[j] * dx + py[j] * dy + pz[j] * dz;
    const double du_l = ex * (uxi * dx + uyi * dy + uzi * dz) + ey * (vxi * dx + vyi * dy + vzi * dz) +
                        ez * (wxi * dx + wyi * dy + wzi * dz);
    const double du_r = ex * (ux[j] * dx + uy[j] * dy + uz[j] * dz) +
                        ey * (vx[j] * dx + vy[j] * dy + vz[j] * dz) +
                        ez * (wx[j] * dx + wy[j] * dy + wz[j] * dz);
    p_l += 0.5 * dp_l;
    p_r -= 0.5 * dp_r;
    u_l += 0.5 * du_l;
    u_r -= 0.5 * du_r;
    const double weight = 1.0 / (rhoi + rhoj);
    const double u_face = weight * (rhoi * u_l + rhoj * u_r + inv_c * (p_l - p_r));
    const double p_face = weight * (rhoj * p_l + rhoi * p_r + c * rhoi * rhoj * (u_l - u_r));
    volume += f * r * (u_face - un_i);
    const double force = f * (p_face - p0);
    fx += force * dx;
    fy += force * dy;
    fz += force * dz;
  }
  return volume + fx + fy + fz;
}

template <int D>
double of_all(const Particles<D>& particles, const NeighborList<D>& neighbors, const Gradients<D>& gradients,
              const LinearEos& eos) {
  const Kernel<D> kernel(neighbors.kernel_radius());
  const auto n = static_cast<std::ptrdiff_t>(particles.n_owned);
  double total = 0.0;
#pragma omp parallel for schedule(static) reduction(+ : total)
  for (std::ptrdiff_t row = 0; row < n; ++row) {
    const auto i = static_cast<std::size_t>(row);
    const std::size_t begin = neighbors.start()[i];
    total += of_one(particles, gradients, kernel, eos, i, neighbors.list() + begin,
                    neighbors.start()[i + 1] - begin);
  }
  return total;
}

}  // namespace

double bare_pairs(const Particles<2>& particles, const NeighborList<2>& neighbors,
                  const Gradients<2>& gradients, const LinearEos& eos) {
  return of_all(particles, neighbors, gradients, eos);
}
double bare_pairs(const Particles<3>& particles, const NeighborList<3>& neighbors,
                  const Gradients<3>& gradients, const LinearEos& eos) {
  return of_all(particles, neighbors, gradients, eos);
}
