#include "level_set/transport.hpp"

#include <algorithm>
#include <cmath>

#include "grid/between.hpp"

namespace littoral::fv {
namespace {

/// An upwind difference along one direction of the grid, of any array: third order where phi is smooth.
/// Across the ridge of phi in the middle of a thin body, or between two, its two second differences are
/// unlike, and the one of the smoother side counts (weighted as Jiang & Peng 2000, with two stencils): with
/// fixed weights the fore side of a thread of water three cells wide went a third faster than its rear.
struct UpwindDifference {
  std::ptrdiff_t step = 0;  // downwind
  double ahead = 0.0, own = 0.0, near = 0.0,
         far = 0.0;  // weights of the cells from one downwind to two upwind
  double operator()(const double* f, std::ptrdiff_t c) const {
    return ahead * f[c + step] + own * f[c] + near * f[c - step] + far * f[c - 2 * step];
  }
  UpwindDifference times(double factor) const {
    return {step, factor * ahead, factor * own, factor * near, factor * far};
  }
};

/// spacing2 [m^2]: squared distance of the centres around c
UpwindDifference upwind_difference(const double* phi, std::ptrdiff_t c, std::ptrdiff_t stride, bool forward,
                                   double spacing2) {
  const std::ptrdiff_t s = forward ? stride : -stride;
  const double here = phi[c + s] - 2.0 * phi[c] + phi[c - s],
               upwind = phi[c] - 2.0 * phi[c - s] + phi[c - 2 * s];
  // a distance bends by h^2/R where it is smooth, by up to 2 h at a ridge
  constexpr double k_smooth = 0.25;  // (h/2)^2
  const auto weight = [&](double share, double bend) {
    const double b = k_smooth * spacing2 + bend * bend;
    return share / (b * b);
  };
  const double w_here = weight(2.0 / 3.0, here), w_upwind = weight(1.0 / 3.0, upwind);
  const double w = w_upwind / (w_here + w_upwind), sign = forward ? 1.0 : -1.0;
  return {s, sign * 0.5 * (1.0 - w), sign * 1.5 * w, -sign * (0.5 + 1.5 * w), sign * 0.5 * w};
}

template <int D>
SpaceVector<D> velocity(const VectorField<D>& u, std::ptrdiff_t c) {
  SpaceVector<D> v;
  for (std::size_t k = 0; k < D; ++k) v[k] = u[k][static_cast<std::size_t>(c)];
  return v;
}

/// u . grad phi at a cell, as differences of phi along the grid's directions; `rate`: of index_velocity
template <int D>
std::array<UpwindDifference, D> advection(const Block<D>& block, const double* phi, const SpaceVector<D>& u,
                                          const std::array<double, D>& rate, std::ptrdiff_t c) {
  SpaceMatrix<D> dx;  // [component][direction]
  std::array<UpwindDifference, D> difference;
  for (std::size_t d = 0; d < D; ++d) {
    const std::ptrdiff_t s = block.extent.stride[d];
    const SpaceVector<D> across = between(block, c - s, c + s);
    difference[d] = upwind_difference(phi, c, s, rate[d] > 0.0, 0.25 * dot(across, across));
    for (std::size_t k = 0; k < D; ++k) dx[k][d] = difference[d](block.centre[k].data(), c);
  }
  const SpaceVector<D> along = times(inverse<D>(dx), u);
  for (std::size_t d = 0; d < D; ++d) difference[d] = difference[d].times(along[d]);
  return difference;
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

/// The equation of phi in one cell, its weights of upwinding those of one phi: R(phi) = constant +
/// (a0 + rate) phi + sum of the differences.
template <int D>
struct CellEquation {
  bool moves = false;
  double constant = 0.0;  // [m/s]
  double own = 0.0;       // [1/s]
  double diagonal = 1.0;  // [1/s] what a sweep divides by
  std::array<UpwindDifference, D> advection{};

  double residual(const double* phi, std::ptrdiff_t c) const {
    double r = constant + own * phi[c];
    for (const UpwindDifference& difference : advection) r += difference(phi, c);
    return r;
  }
};

/// Of the at-th cell of the band.
template <int D>
CellEquation<D> cell_equation(const Block<D>& block, std::size_t b, const SurfaceStep<D>& step,
                              const VectorField<D>& u_s, const double* phi, std::ptrdiff_t at) {
  CellEquation<D> equation;
  const std::ptrdiff_t c = step.band.cells(b)[at];
  const auto i = static_cast<std::size_t>(c);
  equation.moves = moves(block.status[i]);
  if (!equation.moves) return equation;
  const SpaceVector<D> u = velocity<D>(u_s, c);
  const std::array<double, D> rate = index_velocity<D>(block, u_s, c);
  equation.own = step.time.a0;
  equation.constant = step.time.a1 * step.phi_n[b][i];
  if (step.time.a2 != 0.0) equation.constant += step.time.a2 * step.phi_nm1[b][i];
  constexpr double k_diagonal = 1.5;  // per unit of CFL: the smallest with which all waves decay at any CFL
  equation.diagonal = step.time.a0;
  for (const double x : rate) equation.diagonal += k_diagonal * std::abs(x);
  if (step.band.layer(b, c) + 2 < step.band.layers())
    equation.advection = advection<D>(block, phi, u, rate, c);
  else if (step.patches.has(b, c))
    equation.constant += dot(u, step.patches.foot(b, at).normal);
  if (!step.forcing.empty() && step.forcing[b].active()) {
    const SurfaceForcing& f = step.forcing[b];
    equation.own += f.rate[i];
    equation.constant -= f.rate[i] * f.target[i];
    equation.diagonal += f.rate[i];
  }
  return equation;
}

}  // namespace

template <int D>
double transport(const std::vector<Block<D>>& blocks, const Exchange<D>& exchange, const SurfaceStep<D>& step,
                 const std::vector<VectorField<D>>& surface_velocity, int sweeps, std::vector<Field>& phi) {
  double first = 0.0;
  std::vector<std::vector<CellEquation<D>>> equations(blocks.size());
  std::vector<double> change;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      const auto cells = step.band.cells(b);
      equations[b].resize(static_cast<std::size_t>(cells.size()));
      change.assign(static_cast<std::size_t>(cells.size()), 0.0);
      double* f = phi[b].data();
      double largest = 0.0;
#pragma omp parallel for schedule(static) if (cells.size() > k_cells_for_threads) reduction(max : largest)
      for (std::ptrdiff_t i = 0; i < cells.size(); ++i) {
        CellEquation<D>& equation = equations[b][static_cast<std::size_t>(i)];
        if (sweep == 0) equation = cell_equation<D>(blocks[b], b, step, surface_velocity[b], f, i);
        if (!equation.moves) continue;
        const double r = equation.residual(f, cells[i]);
        largest = std::max(largest, std::abs(r));
        change[static_cast<std::size_t>(i)] = r / equation.diagonal;
      }
      for (std::ptrdiff_t i = 0; i < cells.size(); ++i) f[cells[i]] -= change[static_cast<std::size_t>(i)];
      if (sweep == 0) first = std::max(first, largest);
    }
    exchange.scalar(blocks, phi, ScalarGhosts::level_set);
  }
  return first;
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
