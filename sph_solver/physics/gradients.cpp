#include "physics/gradients.hpp"

#include "physics/kernel.hpp"
#include "physics/symmetric_matrix.hpp"

namespace littoral::sph {
namespace {

// Bound on the smallest eigenvalue of B below which its inverse amplifies noise instead of correcting it; a
// corner of the water has .34 (2-D, bound .25) and .3 (3-D, bound .18).
constexpr double k_least_eigenvalue = 0.05;

/// What loop 1 collects for one particle: B, and the raw differences of p and u.
template <int D>
struct Sums {
  SymmetricMatrix<D> B;
  std::array<double, D> p;
  std::array<std::array<double, D>, D> u;
};

Sums<2> sum_pairs(const Particles<2>& particles, const Kernel<2>& kernel, std::size_t i,
                  const std::int32_t* __restrict list, std::size_t count) {
  const double* __restrict x = particles.x[0].data();
  const double* __restrict z = particles.x[1].data();
  const double* __restrict u = particles.u[0].data();
  const double* __restrict w = particles.u[1].data();
  const double* __restrict p = particles.p.data();
  const double* __restrict V = particles.V.data();
  const double xi = x[i], zi = z[i], ui = u[i], wi = w[i], pi = p[i];
  const double inv_R = kernel.inv_R, slope = -kernel.slope;
  double bxx = 0, bxz = 0, bzz = 0, px = 0, pz = 0, ux = 0, uz = 0, wx = 0, wz = 0;
#pragma omp simd reduction(+ : bxx, bxz, bzz, px, pz, ux, uz, wx, wz)
  for (std::size_t k = 0; k < count; ++k) {
    const std::int32_t j = list[k];
    const double dx = x[j] - xi, dz = z[j] - zi;
    const double s = 1.0 - std::sqrt(dx * dx + dz * dz) * inv_R;
    const double q = s > 0.0 ? s : 0.0;
    const double f = slope * V[j] * q * q * q;
    const double fx = f * dx, fz = f * dz;
    bxx += fx * dx;
    bxz += fx * dz;
    bzz += fz * dz;
    const double dp = p[j] - pi, du = u[j] - ui, dw = w[j] - wi;
    px += dp * fx;
    pz += dp * fz;
    ux += du * fx;
    uz += du * fz;
    wx += dw * fx;
    wz += dw * fz;
  }
  return {{{bxx, bxz, bzz}}, {px, pz}, {{{ux, uz}, {wx, wz}}}};
}

Sums<3> sum_pairs(const Particles<3>& particles, const Kernel<3>& kernel, std::size_t i,
                  const std::int32_t* __restrict list, std::size_t count) {
  const double* __restrict x = particles.x[0].data();
  const double* __restrict y = particles.x[1].data();
  const double* __restrict z = particles.x[2].data();
  const double* __restrict u = particles.u[0].data();
  const double* __restrict v = particles.u[1].data();
  const double* __restrict w = particles.u[2].data();
  const double* __restrict p = particles.p.data();
  const double* __restrict V = particles.V.data();
  const double xi = x[i], yi = y[i], zi = z[i], ui = u[i], vi = v[i], wi = w[i], pi = p[i];
  const double inv_R = kernel.inv_R, slope = -kernel.slope;
  double bxx = 0, bxy = 0, bxz = 0, byy = 0, byz = 0, bzz = 0, px = 0, py = 0, pz = 0;
  double ux = 0, uy = 0, uz = 0, vx = 0, vy = 0, vz = 0, wx = 0, wy = 0, wz = 0;
#pragma omp simd reduction(+ : bxx, bxy, bxz, byy, byz, bzz, px, py, pz, ux, uy, uz, vx, vy, vz, wx, wy, wz)
  for (std::size_t k = 0; k < count; ++k) {
    const std::int32_t j = list[k];
    const double dx = x[j] - xi, dy = y[j] - yi, dz = z[j] - zi;
    const double s = 1.0 - std::sqrt(dx * dx + dy * dy + dz * dz) * inv_R;
    const double q = s > 0.0 ? s : 0.0;
    const double f = slope * V[j] * q * q * q;
    const double fx = f * dx, fy = f * dy, fz = f * dz;
    bxx += fx * dx;
    bxy += fx * dy;
    bxz += fx * dz;
    byy += fy * dy;
    byz += fy * dz;
    bzz += fz * dz;
    const double dp = p[j] - pi, du = u[j] - ui, dv = v[j] - vi, dw = w[j] - wi;
    px += dp * fx;
    py += dp * fy;
    pz += dp * fz;
    ux += du * fx;
    uy += du * fy;
    uz += du * fz;
    vx += dv * fx;
    vy += dv * fy;
    vz += dv * fz;
    wx += dw * fx;
    wy += dw * fy;
    wz += dw * fz;
  }
  return {{{bxx, bxy, bxz, byy, byz, bzz}}, {px, py, pz}, {{{ux, uy, uz}, {vx, vy, vz}, {wx, wy, wz}}}};
}

}  // namespace

template <int D>
void Gradients<D>::resize(std::size_t n) {
  for (auto& column : p) column.resize(n);
  for (auto& row : u)
    for (auto& column : row) column.resize(n);
}

template <int D>
void compute_gradients(const Particles<D>& particles, const NeighborList<D>& neighbors,
                       Gradients<D>& gradients) {
  gradients.resize(particles.size());
  const Kernel<D> kernel(neighbors.kernel_radius());
  const auto n = static_cast<std::ptrdiff_t>(particles.n_owned);
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t row = 0; row < n; ++row) {
    const auto i = static_cast<std::size_t>(row);
    const std::size_t begin = neighbors.start()[i];
    const auto sums =
        sum_pairs(particles, kernel, i, neighbors.list() + begin, neighbors.start()[i + 1] - begin);
    SymmetricMatrix<D> L;
    if (sums.B.least_eigenvalue_at_least() > k_least_eigenvalue) L = sums.B.inverse();
    const auto grad_p = L * sums.p;
    for (std::size_t b = 0; b < D; ++b) gradients.p[b][i] = grad_p[b];
    for (std::size_t a = 0; a < D; ++a) {
      const auto grad_u = L * sums.u[a];
      for (std::size_t b = 0; b < D; ++b) gradients.u[a][b][i] = grad_u[b];
    }
  }
}

template struct Gradients<2>;
template struct Gradients<3>;
template void compute_gradients<2>(const Particles<2>&, const NeighborList<2>&, Gradients<2>&);
template void compute_gradients<3>(const Particles<3>&, const NeighborList<3>&, Gradients<3>&);

}  // namespace littoral::sph
