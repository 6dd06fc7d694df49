#include "physics/gradients.hpp"

#include "pairs/pair_rows.hpp"
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

template <int D, class Real>
Sums<D> sum_pairs(const PairRows<D, Real>& rows, Real inv_R, std::size_t i, const std::int32_t* list,
                  std::size_t count) {
  using Rows = PairRows<D, Real>;
  using Vector = Lanes<Real>;
  constexpr std::size_t k_fields = D + 1;  // u, p: as they stand in a row
  constexpr std::size_t k_read = Rows::whole_units(Rows::k_n_state);
  const Real* table = rows.states();
  const Real* own = rows.state(i).q + Rows::k_u;
  Vector B[D * (D + 1) / 2] = {}, slope[k_fields][D] = {};
  for_each_group<Real>(list, count, i, [&](const std::int32_t* j) {
    Vector q[k_read], x[D];
    load_rows<k_read, Rows::k_state_stride>(table, j, q);
    separations(q, rows, i, x);
    Vector r2 = x[0] * x[0];
    for (std::size_t d = 1; d < D; ++d) r2 += x[d] * x[d];
    const Vector s = largest(Real(1) - sqrt(r2) * inv_R, Vector{});
    const Vector f = q[Rows::k_V] * (s * s * s);
    std::size_t next = 0;
    for (std::size_t a = 0; a < D; ++a) {
      const Vector fx = f * x[a];
      for (std::size_t b = a; b < D; ++b) B[next++] += fx * x[b];
      for (std::size_t c = 0; c < k_fields; ++c) slope[c][a] += (q[Rows::k_u + c] - own[c]) * fx;
    }
  });
  Sums<D> sums;
  for (std::size_t a = 0; a < D * (D + 1) / 2; ++a) sums.B.a[a] = sum(B[a]);
  for (std::size_t b = 0; b < D; ++b) {
    for (std::size_t a = 0; a < D; ++a) sums.u[a][b] = sum(slope[a][b]);
    sums.p[b] = sum(slope[D][b]);
  }
  return sums;
}

/// 0 where there is none.
template <int D>
SymmetricMatrix<D> usable_inverse(const SymmetricMatrix<D>& B) {
  return B.least_eigenvalue_at_least() > k_least_eigenvalue ? B.inverse() : SymmetricMatrix<D>{};
}

/// use(i, grad p, grad u) of every owned particle.
template <int D, class Real, class Use>
void for_each_gradient(const PairRows<D, Real>& rows, const NeighborList<D>& neighbors,
                       const KnownSlopes<D>* known, const Use& use) {
  const auto inv_R = static_cast<Real>(1.0 / neighbors.kernel_radius());
  const auto n = static_cast<std::ptrdiff_t>(rows.n_owned());
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t row = 0; row < n; ++row) {
    const auto i = static_cast<std::size_t>(row);
    const std::size_t begin = neighbors.start()[i];
    const auto sums = sum_pairs(rows, inv_R, i, neighbors.list() + begin, neighbors.start()[i + 1] - begin);
    const auto L = usable_inverse(sums.B);
    auto grad_p = L * sums.p;
    if (known != nullptr && known->row_of[i] >= 0) {
      const auto wall = static_cast<std::size_t>(known->row_of[i]);
      auto slope = known->slope[wall];
      for (std::size_t b = 0; b < D; ++b) slope[b] += sums.p[b];
      grad_p = usable_inverse(sums.B + known->B[wall]) * slope;
    }
    std::array<std::array<double, D>, D> grad_u;
    for (std::size_t a = 0; a < D; ++a) grad_u[a] = L * sums.u[a];
    use(i, grad_p, grad_u);
  }
}

/// Into columns.
template <int D>
void put(Gradients<D>& gradients, std::size_t place, const std::array<double, D>& grad_p,
         const std::array<std::array<double, D>, D>& grad_u) {
  for (std::size_t b = 0; b < D; ++b) {
    gradients.p[b][place] = grad_p[b];
    for (std::size_t a = 0; a < D; ++a) gradients.u[a][b][place] = grad_u[a][b];
  }
}

}  // namespace

template <int D>
void Gradients<D>::resize(std::size_t n) {
  for (auto& column : p) column.resize(n);
  for (auto& row : u)
    for (auto& column : row) column.resize(n);
}

template <int D, class Real>
void compute_gradients(PairRows<D, Real>& rows, const NeighborList<D>& neighbors, const KnownSlopes<D>* known,
                       Gradients<D>* beside_walls) {
  if (beside_walls != nullptr) beside_walls->resize(known->slope.size());
  for_each_gradient(rows, neighbors, known, [&](std::size_t i, const auto& grad_p, const auto& grad_u) {
    rows.set_gradients(i, grad_p, grad_u);
    if (beside_walls != nullptr && known->row_of[i] >= 0)
      put<D>(*beside_walls, static_cast<std::size_t>(known->row_of[i]), grad_p, grad_u);
  });
}

template <int D, class Real>
void compute_gradients(const PairRows<D, Real>& rows, const NeighborList<D>& neighbors,
                       Gradients<D>& gradients) {
  gradients.resize(rows.size());
  for_each_gradient<D, Real>(
      rows, neighbors, nullptr,
      [&](std::size_t i, const auto& grad_p, const auto& grad_u) { put<D>(gradients, i, grad_p, grad_u); });
}

template <int D>
void compute_gradients(const Particles<D>& particles, const NeighborList<D>& neighbors,
                       Gradients<D>& gradients) {
  PairRows<D, double> rows;
  rows.pack_states(particles, Kernel<D>(neighbors.kernel_radius()), 0.0);
  compute_gradients<D, double>(rows, neighbors, gradients);
}

template struct Gradients<2>;
template struct Gradients<3>;
template void compute_gradients(PairRows<2, double>&, const NeighborList<2>&, const KnownSlopes<2>*,
                                Gradients<2>*);
template void compute_gradients(const PairRows<2, double>&, const NeighborList<2>&, Gradients<2>&);
template void compute_gradients(PairRows<2, float>&, const NeighborList<2>&, const KnownSlopes<2>*,
                                Gradients<2>*);
template void compute_gradients(const PairRows<2, float>&, const NeighborList<2>&, Gradients<2>&);
template void compute_gradients(PairRows<3, double>&, const NeighborList<3>&, const KnownSlopes<3>*,
                                Gradients<3>*);
template void compute_gradients(const PairRows<3, double>&, const NeighborList<3>&, Gradients<3>&);
template void compute_gradients(PairRows<3, float>&, const NeighborList<3>&, const KnownSlopes<3>*,
                                Gradients<3>*);
template void compute_gradients(const PairRows<3, float>&, const NeighborList<3>&, Gradients<3>&);
template void compute_gradients<2>(const Particles<2>&, const NeighborList<2>&, Gradients<2>&);
template void compute_gradients<3>(const Particles<3>&, const NeighborList<3>&, Gradients<3>&);

}  // namespace littoral::sph
