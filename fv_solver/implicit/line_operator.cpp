#include "implicit/line_operator.hpp"

#include <cassert>

namespace littoral::fv {

namespace {

template <int D>
SmallMatrix<D> product(const SmallMatrix<D>& a, const SmallMatrix<D>& b) {
  SmallMatrix<D> c{};
  for (std::size_t i = 0; i <= D; ++i)
    for (std::size_t k = 0; k <= D; ++k)
      for (std::size_t j = 0; j <= D; ++j) c[i][j] += a[i][k] * b[k][j];
  return c;
}

template <int D>
void subtract(SmallMatrix<D>& a, const SmallMatrix<D>& b) {
  for (std::size_t i = 0; i <= D; ++i)
    for (std::size_t j = 0; j <= D; ++j) a[i][j] -= b[i][j];
}

template <int D>
void add(SmallMatrix<D>& a, const SmallMatrix<D>& b) {
  for (std::size_t i = 0; i <= D; ++i)
    for (std::size_t j = 0; j <= D; ++j) a[i][j] += b[i][j];
}

/// Gauss-Jordan without pivoting: pressure and velocity entries of the diagonal are positive by construction.
template <int D>
SmallMatrix<D> inverse(SmallMatrix<D> a) {
  SmallMatrix<D> inv{};
  for (std::size_t i = 0; i <= D; ++i) inv[i][i] = 1.0;
  for (std::size_t k = 0; k <= D; ++k) {
    const double pivot = 1.0 / a[k][k];
    for (std::size_t j = 0; j <= D; ++j) {
      a[k][j] *= pivot;
      inv[k][j] *= pivot;
    }
    for (std::size_t i = 0; i <= D; ++i) {
      if (i == k) continue;
      const double f = a[i][k];
      for (std::size_t j = 0; j <= D; ++j) {
        a[i][j] -= f * a[k][j];
        inv[i][j] -= f * inv[k][j];
      }
    }
  }
  return inv;
}

template <int N, class Real>
inline void subtract_product(const std::array<std::array<std::array<Real, k_lanes>, N>, N>& a,
                             const std::array<std::array<Real, k_lanes>, N>& x,
                             std::array<std::array<Real, k_lanes>, N>& r) {
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t j = 0; j < N; ++j)
      for (std::size_t l = 0; l < k_lanes; ++l) r[i][l] -= a[i][j][l] * x[j][l];
}

template <int N, class Real>
inline void assign_product(const std::array<std::array<std::array<Real, k_lanes>, N>, N>& a,
                           const std::array<std::array<Real, k_lanes>, N>& x,
                           std::array<std::array<Real, k_lanes>, N>& r) {
  for (std::size_t i = 0; i < N; ++i) {
    for (std::size_t l = 0; l < k_lanes; ++l) r[i][l] = a[i][0][l] * x[0][l];
    for (std::size_t j = 1; j < N; ++j)
      for (std::size_t l = 0; l < k_lanes; ++l) r[i][l] += a[i][j][l] * x[j][l];
  }
}

template <int N, class Real>
inline void gather(const std::array<std::vector<Real>, N>& q,
                   const std::array<std::ptrdiff_t, k_lanes>& first, std::ptrdiff_t shift,
                   std::array<std::array<Real, k_lanes>, N>& x) {
  for (std::size_t i = 0; i < N; ++i) {
    const Real* __restrict values = q[i].data() + shift;
    for (std::size_t l = 0; l < k_lanes; ++l) x[i][l] = values[first[l]];
  }
}

template <int N, class Real>
inline void scatter(const std::array<std::array<Real, k_lanes>, N>& x,
                    const std::array<std::ptrdiff_t, k_lanes>& first, std::ptrdiff_t shift,
                    std::array<std::vector<Real>, N>& q) {
  for (std::size_t i = 0; i < N; ++i) {
    Real* __restrict values = q[i].data() + shift;
    for (std::size_t l = 0; l < k_lanes; ++l) values[first[l]] = x[i][l];
  }
}

template <int D>
FaceState<D> face_state(const State<D>& state, std::ptrdiff_t c) {
  FaceState<D> q;
  q.p = state.p[static_cast<std::size_t>(c)];
  for (std::size_t k = 0; k < D; ++k) q.u[k] = state.u[k][static_cast<std::size_t>(c)];
  return q;
}

}  // namespace

template <int D, class Real>
void LineOperator<D, Real>::assemble_cell(const LevelGrid<D>& grid, const State<D>& state,
                                          const CorrectionPhysics<D>& physics, double anchor,
                                          const std::array<int, D>& index,
                                          std::array<SmallMatrix<D>, k_blocks>& blocks) const {
  const std::ptrdiff_t c = grid.extent.at(index);
  const auto cs = static_cast<std::size_t>(c);
  for (auto& block : blocks) block = SmallMatrix<D>{};
  if (!grid.solved(c)) {
    for (std::size_t i = 0; i <= D; ++i) blocks[0][i][i] = 1.0;
    return;
  }
  const FaceState<D> here = face_state<D>(state, c);
  for (std::size_t d = 0; d < D; ++d) {
    for (std::size_t side = 0; side < 2; ++side) {
      const std::ptrdiff_t other = side == 0 ? c - grid.extent.stride[d] : c + grid.extent.stride[d];
      const auto face = static_cast<std::size_t>(side == 0 ? c : other);
      std::array<double, D> area;
      for (std::size_t k = 0; k < D; ++k) area[k] = grid.area[d][k][face];
      EdgeCondition condition = EdgeCondition::link;
      if (index[d] == (side == 0 ? 0 : grid.extent.n[d] - 1))
        condition = grid.edge[d][side][grid.face_index(static_cast<int>(d), index)];
      if (condition != EdgeCondition::link) {
        if (side == 0)
          for (double& a : area) a = -a;
        add<D>(blocks[0], boundary_jacobian<D>(condition, area, grid.volume[cs], here, physics,
                                               grid.far_speed, grid.imposed_distance[d]));
        continue;
      }
      const double volume = 0.5 * (grid.volume[cs] + grid.volume[static_cast<std::size_t>(other)]);
      const FaceState<D> there = face_state<D>(state, other);
      SmallMatrix<D> by_left, by_right;
      if (side == 0) {
        face_jacobian<D>(area, volume, there, here, physics, by_left, by_right);
        subtract<D>(blocks[0], by_right);
        subtract<D>(blocks[1 + 2 * d], by_left);
      } else {
        face_jacobian<D>(area, volume, here, there, physics, by_left, by_right);
        add<D>(blocks[0], by_left);
        add<D>(blocks[2 + 2 * d], by_right);
      }
    }
  }
  add_cell_jacobian<D>(grid.volume[cs], grid.forcing.empty() ? 0.0 : grid.forcing[cs], here, physics,
                       blocks[0]);
  blocks[0][0][0] *= 1.0 + anchor;
}

template <int D, class Real>
void LineOperator<D, Real>::build(const LevelGrid<D>& grid, const State<D>& state,
                                  const CorrectionPhysics<D>& physics, double anchor) {
  const std::size_t n_slots = layout_.bundles.size() * static_cast<std::size_t>(layout_.length);
  blocks_.resize(n_slots);
  inverse_.resize(n_slots);
  if (layout_.cyclic) closing_.resize(n_slots);
  stride_ = grid.extent.stride;
  const auto dir = static_cast<std::size_t>(layout_.direction);

#pragma omp parallel if (worth_threads(layout_.bundles.size()))
  {
    std::vector<std::array<SmallMatrix<D>, k_blocks>> line(static_cast<std::size_t>(layout_.length));
#pragma omp for schedule(static)
    for (std::size_t bundle = 0; bundle < layout_.bundles.size(); ++bundle) {
      for (std::size_t lane = 0; lane < k_lanes; ++lane) {
        std::array<int, D> index = grid.extent.index(layout_.bundles[bundle].first[lane]);
        for (int k = 0; k < layout_.length; ++k) {
          index[dir] = k;
          auto& cell = line[static_cast<std::size_t>(k)];
          assemble_cell(grid, state, physics, anchor, index, cell);
          auto& stored = blocks_[slot(bundle, k)];
          for (std::size_t m = 0; m < k_blocks; ++m)
            for (std::size_t i = 0; i < N; ++i)
              for (std::size_t j = 0; j < N; ++j) stored[m][i][j][lane] = static_cast<Real>(cell[m][i][j]);
        }
        factorise(bundle, line, static_cast<int>(lane));
      }
    }
  }
}

/// Block Thomas elimination in double, whatever Real is: on thin cells the differences that are left at a
/// line's end are below float's resolution of the terms. A cyclic line is cut before its last cell:
/// x_k = y_k - closing_k x_last, and a Schur complement for x_last (Sherman-Morrison-Woodbury).
template <int D, class Real>
void LineOperator<D, Real>::factorise(std::size_t bundle,
                                      const std::vector<std::array<SmallMatrix<D>, k_blocks>>& blocks,
                                      int lane) {
  const auto ln = static_cast<std::size_t>(lane);
  const std::size_t lower = 1 + 2 * static_cast<std::size_t>(layout_.direction), upper = lower + 1;
  const auto store = [&](std::vector<Block>& where, int k, const SmallMatrix<D>& a) {
    for (std::size_t i = 0; i < N; ++i)
      for (std::size_t j = 0; j < N; ++j) where[slot(bundle, k)][i][j][ln] = static_cast<Real>(a[i][j]);
  };
  const auto n = static_cast<std::size_t>(layout_.length);
  const std::size_t open = layout_.cyclic ? n - 1 : n;
  std::vector<SmallMatrix<D>> inv(open);
  for (std::size_t k = 0; k < open; ++k) {
    SmallMatrix<D> diagonal = blocks[k][0];
    if (k > 0)
      subtract<D>(diagonal, product<D>(product<D>(blocks[k][lower], inv[k - 1]), blocks[k - 1][upper]));
    inv[k] = inverse<D>(diagonal);
    store(inverse_, static_cast<int>(k), inv[k]);
  }
  if (!layout_.cyclic) return;

  std::vector<SmallMatrix<D>> z(open, SmallMatrix<D>{});
  z[0] = blocks[0][lower];
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t j = 0; j < N; ++j) z[open - 1][i][j] += blocks[open - 1][upper][i][j];
  for (std::size_t k = 0; k < open; ++k) {
    if (k > 0) subtract<D>(z[k], product<D>(blocks[k][lower], z[k - 1]));
    z[k] = product<D>(inv[k], z[k]);
  }
  for (std::size_t k = open - 1; k-- > 0;)
    subtract<D>(z[k], product<D>(inv[k], product<D>(blocks[k][upper], z[k + 1])));
  SmallMatrix<D> schur = blocks[n - 1][0];
  subtract<D>(schur, product<D>(blocks[n - 1][lower], z[open - 1]));
  subtract<D>(schur, product<D>(blocks[n - 1][upper], z[0]));
  store(inverse_, layout_.length - 1, inverse<D>(schur));
  for (std::size_t k = 0; k < open; ++k) store(closing_, static_cast<int>(k), z[k]);
}

template <int D, class Real>
void LineOperator<D, Real>::residual(const Correction<D, Real>& b, const Correction<D, Real>& e,
                                     Correction<D, Real>& r) const {
#pragma omp parallel for schedule(static) if (worth_threads(layout_.bundles.size()))
  for (std::size_t bundle = 0; bundle < layout_.bundles.size(); ++bundle) {
    const auto& first = layout_.bundles[bundle].first;
    for (int k = 0; k < layout_.length; ++k) {
      const std::ptrdiff_t shift = k * layout_.stride;
      const auto& blocks = blocks_[slot(bundle, k)];
      Column rest, x;
      gather<N>(b.q, first, shift, rest);
      gather<N>(e.q, first, shift, x);
      subtract_product<N>(blocks[0], x, rest);
      for (std::size_t d = 0; d < D; ++d)
        for (std::size_t side = 0; side < 2; ++side) {
          gather<N>(e.q, first, side == 0 ? shift - stride_[d] : shift + stride_[d], x);
          subtract_product<N>(blocks[1 + 2 * d + side], x, rest);
        }
      scatter<N>(rest, first, shift, r.q);
    }
  }
}

template <int D, class Real>
void LineOperator<D, Real>::smooth(int colour, const Correction<D, Real>& b, Correction<D, Real>& e) const {
  const auto dir = static_cast<std::size_t>(layout_.direction);
  const std::size_t lower = 1 + 2 * dir, upper = lower + 1;
  const int n = layout_.length;
  const int open = layout_.cyclic ? n - 1 : n;
#pragma omp parallel if (worth_threads(layout_.colour_end[static_cast <std::size_t>(colour)] - \
                                       layout_.colour_begin(colour)))
  {
    std::vector<Column> y(static_cast<std::size_t>(n));
#pragma omp for schedule(static)
    for (std::size_t bundle = layout_.colour_begin(colour);
         bundle < layout_.colour_end[static_cast<std::size_t>(colour)]; ++bundle) {
      const auto& first = layout_.bundles[bundle].first;
      Column x;
      for (int k = 0; k < n; ++k) {  // right side and forward elimination
        const std::ptrdiff_t shift = k * layout_.stride;
        const auto& blocks = blocks_[slot(bundle, k)];
        Column rest;
        gather<N>(b.q, first, shift, rest);
        for (std::size_t d = 0; d < D; ++d) {
          if (d == dir) continue;
          gather<N>(e.q, first, shift - stride_[d], x);
          subtract_product<N>(blocks[1 + 2 * d], x, rest);
          gather<N>(e.q, first, shift + stride_[d], x);
          subtract_product<N>(blocks[2 + 2 * d], x, rest);
        }
        if (!layout_.cyclic && k == 0) {  // a linked block beyond the line's ends; zero blocks elsewhere
          gather<N>(e.q, first, shift - layout_.stride, x);
          subtract_product<N>(blocks[lower], x, rest);
        }
        if (!layout_.cyclic && k == n - 1) {
          gather<N>(e.q, first, shift + layout_.stride, x);
          subtract_product<N>(blocks[upper], x, rest);
        }
        const auto ks = static_cast<std::size_t>(k);
        if (k == open) {  // the cut cell of a cyclic line waits for its Schur complement
          y[ks] = rest;
          continue;
        }
        if (k > 0) subtract_product<N>(blocks[lower], y[ks - 1], rest);
        assign_product<N>(inverse_[slot(bundle, k)], rest, y[ks]);
      }
      for (int k = open - 2; k >= 0; --k) {
        const auto ks = static_cast<std::size_t>(k);
        Column above{}, change;
        for (auto& lanes : above) lanes.fill(Real(0));
        subtract_product<N>(blocks_[slot(bundle, k)][upper], y[ks + 1], above);
        assign_product<N>(inverse_[slot(bundle, k)], above, change);
        for (std::size_t i = 0; i < N; ++i)
          for (std::size_t l = 0; l < k_lanes; ++l) y[ks][i][l] += change[i][l];
      }
      if (layout_.cyclic) {
        const auto last = static_cast<std::size_t>(n - 1);
        subtract_product<N>(blocks_[slot(bundle, n - 1)][lower], y[last - 1], y[last]);
        subtract_product<N>(blocks_[slot(bundle, n - 1)][upper], y[0], y[last]);
        assign_product<N>(inverse_[slot(bundle, n - 1)], y[last], x);
        y[last] = x;
        for (int k = 0; k < n - 1; ++k)
          subtract_product<N>(closing_[slot(bundle, k)], x, y[static_cast<std::size_t>(k)]);
      }
      for (int k = 0; k < n; ++k) scatter<N>(y[static_cast<std::size_t>(k)], first, k * layout_.stride, e.q);
    }
  }
}

template class LineOperator<2, float>;
template class LineOperator<2, double>;
template class LineOperator<3, float>;
template class LineOperator<3, double>;

}  // namespace littoral::fv
