#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "neighbors/neighbor_list.hpp"
#include "particles/particles.hpp"
#include "physics/symmetric_matrix.hpp"

namespace littoral::sph {

template <int D, class Real>
class PairRows;

/// Gradients of p and u, in columns.
template <int D>
struct Gradients {
  using Column = std::vector<double>;
  std::array<Column, D> p;                 // [Pa/m]
  std::array<std::array<Column, D>, D> u;  // [1/s] u[a][b] = d u_a / d x_b
  void resize(std::size_t n);
};

/// What walls know of the pressure's gradient at some particles: their part of both sides of (S3).
template <int D>
struct KnownSlopes {
  const std::int32_t* row_of = nullptr;      // (n_owned) -1: no wall; the wall list's own
  std::vector<SymmetricMatrix<D>> B;         // (rows)
  std::vector<std::array<double, D>> slope;  // (rows) [Pa/m]
};

/// Renormalised gradients (S3): grad q_i = B_i^-1 sum_j V_j (q_j - q_i) grad W_ij, exact for linear fields on
/// any cloud. Where the neighbours nearly lie in a plane (spray) B has no usable inverse and the gradient is
/// 0: first order.
/// in    rows with states, copies current; known: added for the pressure (S13), null without walls
/// out   rows with gradients, owned part (the caller refreshes the copies); beside_walls: those of known's
///       rows, whole
/// comm  local
template <int D, class Real>
void compute_gradients(PairRows<D, Real>& rows, const NeighborList<D>& neighbors,
                       const KnownSlopes<D>* known = nullptr, Gradients<D>* beside_walls = nullptr);
/// Those of all owned particles in columns.
template <int D, class Real>
void compute_gradients(const PairRows<D, Real>& rows, const NeighborList<D>& neighbors,
                       Gradients<D>& gradients);
/// The same in double, packing rows for this call alone.
template <int D>
void compute_gradients(const Particles<D>& particles, const NeighborList<D>& neighbors,
                       Gradients<D>& gradients);

extern template struct Gradients<2>;
extern template struct Gradients<3>;
extern template void compute_gradients<2>(const Particles<2>&, const NeighborList<2>&, Gradients<2>&);
extern template void compute_gradients<3>(const Particles<3>&, const NeighborList<3>&, Gradients<3>&);

}  // namespace littoral::sph
