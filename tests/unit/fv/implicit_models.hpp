#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <random>
#include <vector>

#include "grid/metrics.hpp"
#include "implicit/multigrid_solver.hpp"

// Small blocks, states and dense copies of operators, for the oracles of the inner solver.
namespace littoral::fv::test {

/// Cells of a unit box; in the last direction the first cell is 1/aspect as thick as wide (geometric), the
/// other directions are uniform. `bend` shears the grid.
template <int D>
Block<D> stretched_block(const std::array<int, D>& cells, const std::array<bool, D>& periodic, double aspect,
                         double bend = 0.0) {
  const int n = cells[D - 1];
  const double h = 1.0 / cells[0], first = h / aspect;
  double low = 1.0, high = 3.0;  // ratio r with first (r^n - 1)/(r - 1) = n h
  for (int i = 0; i < 200; ++i) {
    const double r = 0.5 * (low + high);
    const double length = r > 1.0 + 1e-12 ? first * (std::pow(r, n) - 1.0) / (r - 1.0) : first * n;
    (length < h * n ? low : high) = r;
  }
  const double r = 0.5 * (low + high);
  return make_block<D>("box", cells, periodic, [=](const std::array<int, D>& i) {
    std::array<double, D> x;
    for (std::size_t d = 0; d < D; ++d) x[d] = h * i[d];
    x[D - 1] = aspect > 1.0 ? first * (std::pow(r, i[D - 1]) - 1.0) / (r - 1.0) : h * i[D - 1];
    x[0] += bend * x[D - 1];
    return x;
  });
}

template <int D>
void set_all_edges(LevelGrid<D>& grid, EdgeCondition lower, EdgeCondition upper) {
  for (int d = 0; d < D; ++d) {
    if (grid.periodic[static_cast<std::size_t>(d)]) continue;
    grid.set_edges(d, 0, d == D - 1 ? lower : EdgeCondition::slip);
    grid.set_edges(d, 1, d == D - 1 ? upper : EdgeCondition::slip);
  }
}

template <int D>
State<D> smooth_state(const Block<D>& block, double speed) {
  State<D> q;
  q.resize(block.extent.size);
  for (std::size_t c = 0; c < block.extent.size; ++c) {
    const double x = block.centre[0][c], z = block.centre[D - 1][c];
    q.p[c] = std::sin(5.0 * x + z);
    for (std::size_t k = 0; k < D; ++k)
      q.u[k][c] = speed * (1.0 + std::sin(6.28318 * x + static_cast<double>(k)) * std::cos(3.0 * z));
  }
  return q;
}

/// The matrix of r = b - A e by unit vectors; unknown of cell m, component i: m (D+1) + i.
template <int D, class Operator>
Eigen::MatrixXd dense(const LevelGrid<D>& grid, const Operator& op) {
  std::vector<std::size_t> cells;
  for_each_cell<D>(grid.extent,
                   [&](const auto&, std::ptrdiff_t c) { cells.push_back(static_cast<std::size_t>(c)); });
  const std::size_t n = cells.size() * (D + 1);
  Eigen::MatrixXd a(n, n);
  Correction<D, double> b, e, r;
  for (auto* f : {&b, &e, &r}) f->assign_zero(grid.extent.size);
  for (std::size_t m = 0; m < cells.size(); ++m)
    for (std::size_t i = 0; i <= D; ++i) {
      e.q[i][cells[m]] = 1.0;
      for (auto& f : e.q) fill_periodic(grid, f);
      op.residual(b, e, r);
      for (std::size_t k = 0; k < cells.size(); ++k)
        for (std::size_t j = 0; j <= D; ++j)
          a(static_cast<Eigen::Index>(k * (D + 1) + j), static_cast<Eigen::Index>(m * (D + 1) + i)) =
              -r.q[j][cells[k]];
      e.assign_zero(grid.extent.size);
    }
  return a;
}

template <int D, class Real>
void randomise(const LevelGrid<D>& grid, Correction<D, Real>& b, unsigned seed = 7) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for_each_cell<D>(grid.extent, [&](const auto&, std::ptrdiff_t c) {
    for (auto& f : b.q)
      f[static_cast<std::size_t>(c)] = static_cast<Real>(
          grid.solved(c) ? grid.volume[static_cast<std::size_t>(c)] * uniform(generator) : 0.0);
  });
}

/// sqrt(sum r^2 / V)
template <int D, class Real>
double norm(const LevelGrid<D>& grid, const Correction<D, Real>& r) {
  double sum = 0.0;
  for_each_cell<D>(grid.extent, [&](const auto&, std::ptrdiff_t c) {
    for (const auto& f : r.q) {
      const auto v = static_cast<double>(f[static_cast<std::size_t>(c)]);
      sum += v * v / grid.volume[static_cast<std::size_t>(c)];
    }
  });
  return std::sqrt(sum);
}

template <int D>
CorrectionPhysics<D> physics(double dt, double mach, double viscosity) {
  CorrectionPhysics<D> p;
  p.fluid.density = 1.0;
  p.fluid.inverse_c2 = mach * mach;  // with U = 1
  p.fluid.viscosity = viscosity;
  p.speeds.c0 = 1.0;
  p.time = BackwardDifference::second_order(dt, dt);
  return p;
}

}  // namespace littoral::fv::test
