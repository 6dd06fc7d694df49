#include "pairs/pair_rows.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace littoral::sph {
namespace {

constexpr double k_units_per_radius = 67108864.0;  // 2^26: finer than a float of the distance

/// A position as whole units, wrapped, kept in the bits of a float.
float wrapped(double units) {
  const auto bits = static_cast<std::uint32_t>(static_cast<std::uint64_t>(std::llrint(units)));
  float kept;
  std::memcpy(&kept, &bits, sizeof kept);
  return kept;
}

}  // namespace

template <int D, class Real>
void PairRows<D, Real>::pack_states(const Particles<D>& particles, const Kernel<D>& kernel, double p0) {
  constexpr bool whole = std::is_same_v<Real, float>;
  const double units = whole ? k_units_per_radius / kernel.R : 1.0;
  unit_ = static_cast<Real>(1.0 / units);
  n_owned_ = particles.n_owned;
  state_.resize(particles.size());
  face_.resize(particles.size());
  const auto n = static_cast<std::ptrdiff_t>(particles.size());
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t row = 0; row < n; ++row) {
    const auto i = static_cast<std::size_t>(row);
    Real* q = state_[i].q;
    for (std::size_t d = 0; d < D; ++d) {
      if constexpr (whole)
        q[k_x + d] = wrapped(particles.x[d][i] * units);
      else
        q[k_x + d] = particles.x[d][i];
      q[k_u + d] = static_cast<Real>(particles.u[d][i]);
    }
    q[k_V] = static_cast<Real>(-kernel.slope * particles.V[i]);
    q[k_p] = static_cast<Real>(particles.p[i] - p0);
    for (std::size_t a = k_n_state; a < k_state_stride; ++a) q[a] = 0;
    face_[i].q[k_rho] = static_cast<Real>(particles.rho[i]);
  }
}

template <int D, class Real>
void PairRows<D, Real>::set_gradients(const Gradients<D>& gradients) {
  const auto n = static_cast<std::ptrdiff_t>(size());
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t row = 0; row < n; ++row) {
    const auto i = static_cast<std::size_t>(row);
    std::array<double, D> grad_p;
    std::array<std::array<double, D>, D> grad_u;
    for (std::size_t a = 0; a < D; ++a) {
      grad_p[a] = gradients.p[a][i];
      for (std::size_t b = 0; b < D; ++b) grad_u[a][b] = gradients.u[a][b][i];
    }
    set_gradients(i, grad_p, grad_u);
  }
}

template class PairRows<2, double>;
template class PairRows<3, double>;
template class PairRows<2, float>;
template class PairRows<3, float>;

}  // namespace littoral::sph
