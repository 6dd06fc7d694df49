#include "bare_residual.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <vector>

namespace {

template <bool Limited>
inline double side(double far, double near, double across) {
  const double back = near - far, forth = across - near;
  if constexpr (!Limited) return near + back * (1.0 / 6.0) + forth * (1.0 / 3.0);
  constexpr double tiny = 1e-12;
  const double s = (2.0 * back * forth + tiny) / (back * back + forth * forth + tiny);
  return near + 0.25 * s * ((1.0 - s * (1.0 / 3.0)) * back + (1.0 + s * (1.0 / 3.0)) * forth);
}

struct Fields {
  std::ptrdiff_t n, side, size;
  std::array<std::vector<double>, 4> q, history, r;
};

/// Fluxes of `count` faces along the direction of stride s; `normal` is the velocity's component through
/// them.
template <bool Limited>
void fluxes(const Fields& f, std::size_t normal, std::ptrdiff_t s, std::ptrdiff_t first, std::ptrdiff_t count,
            double* __restrict out, std::ptrdiff_t stride) {
  const double* __restrict p = f.q[0].data() + first;
  const double* __restrict u = f.q[1].data() + first;
  const double* __restrict v = f.q[2].data() + first;
  const double* __restrict w = f.q[3].data() + first;
  const double* __restrict un = f.q[1 + normal].data() + first;
  const double area = 1.0, c_p = 2.0, rho0 = 1000.0, c0 = 1.0;
  double* __restrict pressure = out + (1 + static_cast<std::ptrdiff_t>(normal)) * stride;
  double* __restrict o0 = out;
  double* __restrict o1 = out + stride;
  double* __restrict o2 = out + 2 * stride;
  double* __restrict o3 = out + 3 * stride;
  double* __restrict o4 = out + 4 * stride;
#pragma omp simd
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const double p_l = side<Limited>(p[i - 2 * s], p[i - s], p[i]),
                 p_r = side<Limited>(p[i + s], p[i], p[i - s]);
    const double u_l = side<Limited>(u[i - 2 * s], u[i - s], u[i]),
                 u_r = side<Limited>(u[i + s], u[i], u[i - s]);
    const double v_l = side<Limited>(v[i - 2 * s], v[i - s], v[i]),
                 v_r = side<Limited>(v[i + s], v[i], v[i - s]);
    const double w_l = side<Limited>(w[i - 2 * s], w[i - s], w[i]),
                 w_r = side<Limited>(w[i + s], w[i], w[i - s]);
    const double n_l = side<Limited>(un[i - 2 * s], un[i - s], un[i]),
                 n_r = side<Limited>(un[i + s], un[i], un[i - s]);
    const double m = rho0 * area * (0.5 * (n_l + n_r) + (p_l - p_r) / (2.0 * rho0 * c_p));
    o0[i] = m;
    o1[i] = m * (m > 0.0 ? u_l : u_r);
    o2[i] = m * (m > 0.0 ? v_l : v_r);
    o3[i] = m * (m > 0.0 ? w_l : w_r);
    o4[i] = area * (0.5 * (p_l + p_r) + 0.5 * rho0 * c0 * (n_l - n_r));
  }
#pragma omp simd
  for (std::ptrdiff_t i = 0; i < count; ++i) pressure[i] += o4[i];
}

template <bool Limited>
void residual(Fields& f) {
  constexpr std::ptrdiff_t tile = 16;
  const std::ptrdiff_t n = f.n, a = f.side, b = f.side * f.side, origin = 2 * (1 + a + b);
  const double a0 = 1.5, volume = 1.0;
#pragma omp parallel
  {
    std::vector<double> rows(static_cast<std::size_t>(10 * (n + 1)));
    double* low = rows.data();
    double* up = low + 5 * (n + 1);
    const auto add = [&](std::ptrdiff_t c, const double* upper, const double* lower) {
      for (std::size_t k = 0; k < 4; ++k) {
        double* __restrict r = f.r[k].data() + c;
        const double* __restrict x = upper + static_cast<std::ptrdiff_t>(k) * (n + 1);
        const double* __restrict y = lower + static_cast<std::ptrdiff_t>(k) * (n + 1);
#pragma omp simd
        for (std::ptrdiff_t i = 0; i < n; ++i) r[i] += x[i] - y[i];
      }
    };
#pragma omp for collapse(2) schedule(static)
    for (std::ptrdiff_t kt = 0; kt < n; kt += tile)
      for (std::ptrdiff_t jt = 0; jt < n; jt += tile) {
        const std::ptrdiff_t k_end = std::min(kt + tile, n), j_end = std::min(jt + tile, n);
        for (std::ptrdiff_t k = kt; k < k_end; ++k)
          for (std::ptrdiff_t j = jt; j < j_end; ++j) {
            const std::ptrdiff_t c = origin + j * a + k * b;
            for (std::size_t m = 0; m < 4; ++m) {
              double* __restrict r = f.r[m].data() + c;
              const double* __restrict q = f.q[m].data() + c;
              const double* __restrict h = f.history[m].data() + c;
#pragma omp simd
              for (std::ptrdiff_t i = 0; i < n; ++i) r[i] = volume * (a0 * q[i] + h[i]);
            }
            fluxes<Limited>(f, 0, 1, c, n + 1, low, n + 1);
            add(c, low + 1, low);
          }
        for (std::ptrdiff_t k = kt; k < k_end; ++k)
          for (std::ptrdiff_t j = jt; j <= j_end; ++j) {
            const std::ptrdiff_t c = origin + j * a + k * b;
            fluxes<Limited>(f, 1, a, c, n, up, n + 1);
            if (j > jt) add(c - a, up, low);
            std::swap(low, up);
          }
        for (std::ptrdiff_t j = jt; j < j_end; ++j)
          for (std::ptrdiff_t k = kt; k <= k_end; ++k) {
            const std::ptrdiff_t c = origin + j * a + k * b;
            fluxes<Limited>(f, 2, b, c, n, up, n + 1);
            if (k > kt) add(c - b, up, low);
            std::swap(low, up);
          }
      }
  }
}

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

double bare_residual_rate(int n, bool limited) {
  Fields f;
  f.n = n;
  f.side = n + 4;
  f.size = f.side * f.side * f.side;
  for (std::size_t k = 0; k < 4; ++k) {
    f.q[k].resize(static_cast<std::size_t>(f.size));
    f.history[k].assign(f.q[k].size(), 0.1);
    f.r[k].assign(f.q[k].size(), 0.0);
    for (std::size_t i = 0; i < f.q[k].size(); ++i)
      f.q[k][i] = std::sin(0.01 * static_cast<double>(i) + static_cast<double>(k));
  }
  double best = 1e30;
  const double begin = now();
  do {
    const double start = now();
    limited ? residual<true>(f) : residual<false>(f);
    best = std::min(best, now() - start);
  } while (now() - begin < 1.0);
  return static_cast<double>(n) * n * n / best * 1e-6;
}
