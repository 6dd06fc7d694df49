#include "level_set/transport.hpp"

#include <algorithm>
#include <cmath>

namespace littoral::fv {
namespace {

/// Third-order difference of an array, upwind of a flow along +stride (or against it).
inline double upwind_difference(const double* f, std::ptrdiff_t c, std::ptrdiff_t stride, bool forward) {
  const std::ptrdiff_t s = forward ? stride : -stride;
  const double difference = (2.0 * f[c + s] + 3.0 * f[c] - 6.0 * f[c - s] + f[c - 2 * s]) / 6.0;
  return forward ? difference : -difference;
}

template <int D>
SpaceVector<D> velocity(const VectorField<D>& u, std::ptrdiff_t c) {
  SpaceVector<D> v;
  for (std::size_t k = 0; k < D; ++k) v[k] = u[k][static_cast<std::size_t>(c)];
  return v;
}

/// u . grad phi
template <int D>
double advection(const Block<D>& block, const double* phi, const SpaceVector<D>& u,
                 const std::array<double, D>& rate, std::ptrdiff_t c) {
  SpaceMatrix<D> dx;  // [component][direction]
  SpaceVector<D> change;
  for (std::size_t d = 0; d < D; ++d) {
    const std::ptrdiff_t s = block.extent.stride[d];
    change[d] = upwind_difference(phi, c, s, rate[d] > 0.0);
    for (std::size_t k = 0; k < D; ++k)
      dx[k][d] = upwind_difference(block.centre[k].data(), c, s, rate[d] > 0.0);
  }
  return dot(times(inverse<D>(dx), u), change);
}

bool moves(CellStatus status) { return status == CellStatus::computed || status == CellStatus::forced; }

/// Contravariant velocity at a cell's centre: cells a second along each direction of the grid.
template <int D>
std::array<double, D> index_velocity(const Block<D>& block, const VectorField<D>& u, std::ptrdiff_t c) {
  const auto i = static_cast<std::size_t>(c);
  std::array<double, D> rate;
  for (std::size_t d = 0; d < D; ++d) {
    const auto up = static_cast<std::size_t>(c + block.extent.stride[d]);
    double flow = 0.0;
    for (std::size_t k = 0; k < D; ++k) flow += 0.5 * (block.area[d][k][i] + block.area[d][k][up]) * u[k][i];
    rate[d] = flow / block.volume[i];
  }
  return rate;
}

/// R of the at-th cell of the band [m/s] and, in `diagonal`, what a sweep divides by [1/s].
template <int D>
double cell_residual(const Block<D>& block, std::size_t b, const SurfaceStep<D>& step,
                     const VectorField<D>& u_s, const double* phi, std::ptrdiff_t at, double& diagonal) {
  const std::ptrdiff_t c = step.band.cells(b)[at];
  const auto i = static_cast<std::size_t>(c);
  const SpaceVector<D> u = velocity<D>(u_s, c);
  const std::array<double, D> rate = index_velocity<D>(block, u_s, c);
  double r = step.time.a0 * phi[c] + step.time.a1 * step.phi_n[b][i];
  if (step.time.a2 != 0.0) r += step.time.a2 * step.phi_nm1[b][i];
  constexpr double k_diagonal = 1.5;  // per unit of CFL: the smallest with which all waves decay at any CFL
  diagonal = step.time.a0;
  for (const double x : rate) diagonal += k_diagonal * std::abs(x);
  if (step.band.layer(b, c) + 2 < step.band.layers())
    r += advection<D>(block, phi, u, rate, c);
  else if (step.patches.has(b, c))
    r += dot(u, step.patches.foot(b, at).normal);
  if (!step.forcing.empty() && step.forcing[b].active()) {
    const SurfaceForcing& f = step.forcing[b];
    r += f.rate[i] * (phi[c] - f.target[i]);
    diagonal += f.rate[i];
  }
  return r;
}

}  // namespace

template <int D>
double transport(const std::vector<Block<D>>& blocks, const Exchange<D>& exchange, const SurfaceStep<D>& step,
                 const std::vector<VectorField<D>>& surface_velocity, int sweeps, std::vector<Field>& phi) {
  double largest = 0.0;
  std::vector<double> change;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    largest = 0.0;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      const auto cells = step.band.cells(b);
      change.assign(static_cast<std::size_t>(cells.size()), 0.0);
      double* f = phi[b].data();
#pragma omp parallel for schedule(static) if (cells.size() > k_cells_for_threads) reduction(max : largest)
      for (std::ptrdiff_t i = 0; i < cells.size(); ++i) {
        if (!moves(blocks[b].status[static_cast<std::size_t>(cells[i])])) continue;
        double diagonal = 0.0;
        const double r = cell_residual<D>(blocks[b], b, step, surface_velocity[b], f, i, diagonal);
        largest = std::max(largest, std::abs(r));
        change[static_cast<std::size_t>(i)] = r / diagonal;
      }
      for (std::ptrdiff_t i = 0; i < cells.size(); ++i) f[cells[i]] -= change[static_cast<std::size_t>(i)];
    }
    exchange.scalar(blocks, phi, ScalarGhosts::level_set);
  }
  return largest;
}

template <int D>
double surface_rate(const std::vector<Block<D>>& blocks, const Band<D>& band,
                    const std::vector<VectorField<D>>& surface_velocity) {
  double largest = 0.0;
  for (std::size_t b = 0; b < blocks.size(); ++b)
    for (const std::ptrdiff_t c : band.cells(b, 0, std::min(2, band.layers()))) {
      double sum = 0.0;
      for (const double x : index_velocity<D>(blocks[b], surface_velocity[b], c)) sum += std::abs(x);
      largest = std::max(largest, sum);
    }
  return largest;
}

template double transport<2>(const std::vector<Block<2>>&, const Exchange<2>&, const SurfaceStep<2>&,
                             const std::vector<VectorField<2>>&, int, std::vector<Field>&);
template double transport<3>(const std::vector<Block<3>>&, const Exchange<3>&, const SurfaceStep<3>&,
                             const std::vector<VectorField<3>>&, int, std::vector<Field>&);
template double surface_rate<2>(const std::vector<Block<2>>&, const Band<2>&,
                                const std::vector<VectorField<2>>&);
template double surface_rate<3>(const std::vector<Block<3>>&, const Band<3>&,
                                const std::vector<VectorField<3>>&);

}  // namespace littoral::fv
