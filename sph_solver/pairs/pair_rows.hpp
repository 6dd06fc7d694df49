#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "pairs/lanes.hpp"
#include "particles/particles.hpp"
#include "physics/gradients.hpp"
#include "physics/kernel.hpp"

namespace littoral::sph {

/// What the pair loops read of a particle, side by side in one row a particle, owned and copies: a neighbour
/// then costs one cache line in the loop of gradients and about three in that of fluxes, not one a column.
///
/// With Real = float positions are whole multiples of R / 2^26 modulo 2^32, in place of a float: their
/// differences are exact wherever the particles are, since a pair is never 32 R apart.
template <int D, class Real>
class PairRows {
 public:
  /// Places in a row of states: x, V 20 A / R^(D+2) (so that times (1-s)^3 it is -V W'/r), u, p - p0.
  static constexpr std::size_t k_x = 0, k_V = D, k_u = D + 1, k_p = 2 * D + 1, k_n_state = 2 * D + 2;
  /// Places in a row of faces: rho, grad p, and what x.(grad u) x needs: u_aa, u_ab + u_ba (a < b), by rows.
  static constexpr std::size_t k_rho = 0, k_grad_p = 1, k_strain = D + 1, k_n_face = 1 + D + D * (D + 1) / 2;

  static constexpr std::size_t whole_units(std::size_t n) {
    return (n + LaneTypes<Real>::k_unit - 1) / LaneTypes<Real>::k_unit * LaneTypes<Real>::k_unit;
  }
  static constexpr std::size_t k_state_stride = 8, k_face_stride = whole_units(k_n_face);
  struct alignas(8 * sizeof(Real)) State {
    Real q[k_state_stride];
  };
  struct alignas(16) Face {
    Real q[k_face_stride];
  };

  /// Rows of all particles, but for the gradients in those of faces; copies current. p0: pressure on the
  /// surface, taken off.
  void pack_states(const Particles<D>& particles, const Kernel<D>& kernel, double p0);
  /// To be called after pack_states. grad_u[a][b] = d u_a / d x_b
  void set_gradients(std::size_t i, const std::array<double, D>& grad_p,
                     const std::array<std::array<double, D>, D>& grad_u) {
    Real* q = face_[i].q;
    std::size_t next = k_strain;
    for (std::size_t a = 0; a < D; ++a) {
      q[k_grad_p + a] = static_cast<Real>(grad_p[a]);
      q[next++] = static_cast<Real>(grad_u[a][a]);
      for (std::size_t b = a + 1; b < D; ++b) q[next++] = static_cast<Real>(grad_u[a][b] + grad_u[b][a]);
    }
  }
  /// div u of the gradients that were set [1/s].
  double divergence(std::size_t i) const {
    double sum = 0.0;
    std::size_t next = k_strain;
    for (std::size_t a = 0; a < D; next += D - a, ++a) sum += face_[i].q[next];
    return sum;
  }
  /// Gradients of all particles, from columns.
  void set_gradients(const Gradients<D>& gradients);

  std::size_t n_owned() const { return n_owned_; }
  std::size_t size() const { return state_.size(); }  ///< owned and copies
  const Real* states() const { return state_.empty() ? nullptr : state_[0].q; }
  const Real* faces() const { return face_.empty() ? nullptr : face_[0].q; }
  const State& state(std::size_t i) const { return state_[i]; }
  const Face& face(std::size_t i) const { return face_[i]; }
  Face& face(std::size_t i) { return face_[i]; }
  Real unit() const { return unit_; }  ///< [m] of a position; 1 for double
  std::size_t bytes() const { return state_.capacity() * sizeof(State) + face_.capacity() * sizeof(Face); }

 private:
  std::size_t n_owned_ = 0;
  Real unit_ = 1;
  std::vector<State> state_;
  std::vector<Face> face_;
};

/// x_j - x_i of the neighbours in the lanes. q: their states, i: that of the particle.
template <int D>
inline void separations(const Lanes<double>* q, const PairRows<D, double>& rows, std::size_t i,
                        Lanes<double>* x) {
  for (std::size_t d = 0; d < D; ++d) x[d] = q[d] - rows.state(i).q[d];
}
template <int D>
inline void separations(const Lanes<float>* q, const PairRows<D, float>& rows, std::size_t i,
                        Lanes<float>* x) {
  using Bits = LaneTypes<float>::Bits;
  using Integer = LaneTypes<float>::Integer;
  for (std::size_t d = 0; d < D; ++d) {
    std::uint32_t own;
    std::memcpy(&own, &rows.state(i).q[d], sizeof own);
    const Bits apart = reinterpret_cast<Bits>(q[d]) - own;  // modulo 2^32
    x[d] = __builtin_convertvector(reinterpret_cast<Integer>(apart), Lanes<float>) * rows.unit();
  }
}

extern template class PairRows<2, double>;
extern template class PairRows<3, double>;
extern template class PairRows<2, float>;
extern template class PairRows<3, float>;

}  // namespace littoral::sph
