// Building a LineOperator: the blocks of a bundle's cells in lanes, and their elimination along the lines.
#include "implicit/line_operator.hpp"
#include "implicit/surface_jacobian.hpp"

namespace littoral::fv {
namespace {

template <int D, class T>
SmallMatrix<D, T> product(const SmallMatrix<D, T>& a, const SmallMatrix<D, T>& b) {
  SmallMatrix<D, T> c;
  for (std::size_t i = 0; i <= D; ++i)
    for (std::size_t k = 0; k <= D; ++k)
      for (std::size_t j = 0; j <= D; ++j) c[i][j] += a[i][k] * b[k][j];
  return c;
}

template <int D, class T>
void subtract(SmallMatrix<D, T>& a, const SmallMatrix<D, T>& b) {
  for (std::size_t i = 0; i <= D; ++i)
    for (std::size_t j = 0; j <= D; ++j) a[i][j] -= b[i][j];
}

template <int D, class T>
void add(SmallMatrix<D, T>& a, const SmallMatrix<D, T>& b) {
  for (std::size_t i = 0; i <= D; ++i)
    for (std::size_t j = 0; j <= D; ++j) a[i][j] += b[i][j];
}

template <int D, class T>
SmallMatrix<D, T> negative(const SmallMatrix<D, T>& a) {
  SmallMatrix<D, T> c;
  subtract<D>(c, a);
  return c;
}

/// Gauss-Jordan without pivoting: pressure and velocity entries of the diagonal are positive by construction.
template <int D, class T>
SmallMatrix<D, T> inverse(SmallMatrix<D, T> a) {
  SmallMatrix<D, T> inv;
  for (std::size_t i = 0; i <= D; ++i) inv[i][i] = 1.0 + T{};
  for (std::size_t k = 0; k <= D; ++k) {
    const T pivot = 1.0 / a[k][k];
    for (std::size_t j = 0; j <= D; ++j) {
      a[k][j] *= pivot;
      inv[k][j] *= pivot;
    }
    for (std::size_t i = 0; i <= D; ++i) {
      if (i == k) continue;
      const T f = a[i][k];
      for (std::size_t j = 0; j <= D; ++j) {
        a[i][j] -= f * a[k][j];
        inv[i][j] -= f * inv[k][j];
      }
    }
  }
  return inv;
}

template <int D, class V>
void narrow(const SmallMatrix<D, Lanes<double>>& a, SmallMatrix<D, V>& b) {
  for (std::size_t i = 0; i <= D; ++i)
    for (std::size_t j = 0; j <= D; ++j) convert(a[i][j], b[i][j]);
}

/// a += b, which may be narrower
template <int D, class V>
void add_wide(SmallMatrix<D, Lanes<double>>& a, const SmallMatrix<D, V>& b) {
  for (std::size_t i = 0; i <= D; ++i)
    for (std::size_t j = 0; j <= D; ++j) {
      Lanes<double> wide;
      convert(b[i][j], wide);
      a[i][j] += wide;
    }
}

template <int D, class V>
void set_lane(SmallMatrix<D, V>& a, std::size_t lane, const SmallMatrix<D>& b) {
  for (std::size_t i = 0; i <= D; ++i)
    for (std::size_t j = 0; j <= D; ++j) a[i][j][lane] = static_cast<LaneReal<V>>(b[i][j]);
}

/// The free surface between cell c, which holds water, and the air beyond its face on `side`.
template <int D>
SurfaceJacobian<D> surface_face(const LevelGrid<D>& grid, const State<D>& state,
                                const CorrectionPhysics<D>& physics, std::ptrdiff_t c,
                                const std::array<int, D>& index, std::size_t d, std::size_t side) {
  const std::ptrdiff_t step = (side == 0 ? -1 : 1) * grid.extent.stride[d];
  const auto at = [](std::ptrdiff_t cell) { return static_cast<std::size_t>(cell); };
  const auto face = at(side == 0 ? c : c + step);
  std::array<double, D> area;
  FaceState<D> inside;
  for (std::size_t k = 0; k < D; ++k) {
    area[k] = (side == 0 ? -1.0 : 1.0) * grid.area[d][k][face];
    inside.u[k] = state.u[k][at(c)];
  }
  const int last = side == 0 ? grid.extent.n[d] - 1 : 0;  // where the line ends behind the cell
  const bool open_behind =
      index[d] != last ||
      grid.edge[d][1 - side][grid.face_index(static_cast<int>(d), index)] == EdgeCondition::link;
  const double reach = grid.volume[at(c)] / (grid.volume[at(c)] + grid.volume[at(c + step)]);
  const double theta = crossing(grid.phi[at(c)], grid.phi[at(c + step)]);
  const LineStencil stencil = line_stencil(theta, open_behind && grid.wet(c - step), reach);
  const LineWeights weights = line_weights(stencil, theta, 1.0, reach);
  return surface_jacobian<D>(area, grid.volume[at(c)], inside, level_normal<D>(grid, c), weights, physics);
}

}  // namespace

/// The cells of one bundle in turn, and what is carried from one to the next.
template <int D, class Real>
struct LineOperator<D, Real>::Line {
  std::array<int, D> index[k_lanes];  // of each lane's cell
  Wide diagonal, lower, upper;
  Wide by_left, by_right;     // through the upper face of the cell before, where it is an inner one
  std::vector<Wide> back, z;  // inverse * upper; response to the last cell of a cyclic line

  explicit Line(std::size_t n) : back(n), z(n) {}
};

template <int D, class Real>
template <LanePattern S>
void LineOperator<D, Real>::build_bundle(const LevelGrid<D>& grid, const State<D>& state,
                                         const CorrectionPhysics<D>& physics, double anchor,
                                         std::size_t bundle, Line& line) {
  const auto dir = static_cast<std::size_t>(layout_.direction);
  const auto& first = layout_.bundles[bundle].first;
  for (std::size_t l = 0; l < k_lanes; ++l) line.index[l] = grid.extent.index(first[l]);
  const MassSpeed mass_speed = physics.mass_speed_between_cells();
  unsigned at_edge[D][2] = {};  // lanes whose cells lie beside a face of the block, across the lines
  for (std::size_t d = 0; d < D; ++d)
    for (std::size_t l = 0; l < k_lanes; ++l) {
      if (d == dir) continue;
      if (line.index[l][d] == 0) at_edge[d][0] |= 1u << l;
      if (line.index[l][d] == grid.extent.n[d] - 1) at_edge[d][1] |= 1u << l;
    }
  struct Behind {  // of a surface's pressure on the cell behind
    std::size_t lane, direction, side;
    std::array<double, D> by_p;
  };
  std::array<Behind, 2 * D * k_lanes> behind;
  std::size_t n_behind = 0;
  using V = Lanes<double>;
  const auto velocity = [&](std::ptrdiff_t shift) {
    FaceState<D, V> q;
    for (std::size_t k = 0; k < D; ++k) load<S>(state.u[k].data() + shift, first, q.u[k]);
    return q;
  };
  for (int m = 0; m < layout_.length; ++m) {
    const std::ptrdiff_t shift = m * layout_.stride;
    for (std::size_t l = 0; l < k_lanes; ++l) line.index[l][dir] = m;
    V volume;
    load<S>(grid.volume.data() + shift, first, volume);
    const FaceState<D, V> here = velocity(shift);
    line.diagonal = Wide{};
    unsigned wet_lanes = 0;  // lanes whose cells have a free surface beside them
    for (std::size_t l = 0; !grid.beside_air.empty() && l < k_lanes; ++l)
      if (grid.beside_air[static_cast<std::size_t>(first[l] + shift)] != 0) wet_lanes |= 1u << l;
    n_behind = 0;
    const auto set_surface = [&](std::size_t d, std::size_t side, auto& own, auto& neighbour) {
      const std::ptrdiff_t step = (side == 0 ? -1 : 1) * grid.extent.stride[d];
      for (std::size_t l = 0; l < k_lanes; ++l) {
        const std::ptrdiff_t c = first[l] + shift;
        if (!(wet_lanes >> l & 1u) || grid.wet(c + step)) continue;
        if (line.index[l][d] == (side == 0 ? 0 : grid.extent.n[d] - 1) &&
            grid.edge[d][side][grid.face_index(static_cast<int>(d), line.index[l])] != EdgeCondition::link)
          continue;
        const SurfaceJacobian<D> face = surface_face<D>(grid, state, physics, c, line.index[l], d, side);
        set_lane<D>(own, l, face.own);
        set_lane<D>(neighbour, l, SmallMatrix<D>{});
        behind[n_behind++] = {l, d, side, face.behind_p};
      }
    };
    // the face on a side: what it gives to the cell's own block, and the neighbour's; by_left, by_right as of
    // a face between cells
    const auto set_face = [&](std::size_t d, std::size_t side, unsigned edge, auto& own, auto& neighbour,
                              auto& by_left, auto& by_right) {
      using W = std::decay_t<decltype(own[0][0])>;
      const std::ptrdiff_t step = (side == 0 ? -1 : 1) * grid.extent.stride[d];
      const std::ptrdiff_t face = side == 0 ? shift : shift + step;
      V area[D], beyond;
      for (std::size_t k = 0; k < D; ++k) load<S>(grid.area[d][k].data() + face, first, area[k]);
      load<S>(grid.volume.data() + shift + step, first, beyond);
      W narrow_area[D], dual;
      FaceState<D, W> inside, outside;
      const FaceState<D, V> there = velocity(shift + step);
      for (std::size_t k = 0; k < D; ++k) {
        convert(area[k], narrow_area[k]);
        convert(here.u[k], inside.u[k]);
        convert(there.u[k], outside.u[k]);
      }
      convert(0.5 * (volume + beyond), dual);
      const auto speed = mass_speed.template as<LaneReal<W>>();
      if (side == 0) {
        face_jacobian<D>(narrow_area, dual, outside, inside, physics, speed, by_left, by_right);
        own = negative<D>(by_right);
        neighbour = negative<D>(by_left);
      } else {
        face_jacobian<D>(narrow_area, dual, inside, outside, physics, speed, by_left, by_right);
        own = by_left;
        neighbour = by_right;
      }
      for (std::size_t l = 0; edge != 0 && l < k_lanes; ++l) {
        if (!(edge >> l & 1u)) continue;
        const EdgeCondition condition =
            grid.edge[d][side][grid.face_index(static_cast<int>(d), line.index[l])];
        if (condition == EdgeCondition::link) continue;
        std::array<double, D> outward;
        FaceState<D> at_face;
        for (std::size_t k = 0; k < D; ++k) {
          outward[k] = side == 0 ? -area[k][l] : area[k][l];
          at_face.u[k] = here.u[k][l];
        }
        set_lane<D>(own, l,
                    boundary_jacobian<D>(condition, outward, volume[l], at_face, physics, grid.far_speed,
                                         grid.imposed_distance[d]));
        set_lane<D>(neighbour, l, SmallMatrix<D>{});
      }
      if (wet_lanes != 0) set_surface(d, side, own, neighbour);
    };
    // along the line in double (see eliminate); across it Real is enough
    for (std::size_t side = 0; side < 2; ++side) {
      const bool end = m == (side == 0 ? 0 : layout_.length - 1);
      Wide& neighbour = side == 0 ? line.lower : line.upper;
      Wide own, by_left, by_right;
      if (side == 0 && !end) {  // computed from the other side
        own = negative<D>(line.by_right);
        neighbour = negative<D>(line.by_left);
        if (wet_lanes != 0) set_surface(dir, side, own, neighbour);
      } else {
        set_face(dir, side, end ? (1u << k_lanes) - 1u : 0u, own, neighbour, by_left, by_right);
      }
      add<D>(line.diagonal, own);
      if (side == 1) {
        line.by_left = by_left;
        line.by_right = by_right;
      }
    }
    Matrix* cross = forward_[slot(bundle, m)].cross;
    Matrix beside{};
    for (std::size_t d = 0, c = 0; d < D; ++d)
      for (std::size_t side = 0; side < 2 && d != dir; ++side, ++c) {
        Matrix own, by_left, by_right;
        set_face(d, side, at_edge[d][side], own, cross[c], by_left, by_right);
        add<D>(beside, own);
      }
    add_wide<D>(line.diagonal, beside);
    for (std::size_t b = 0; b < n_behind; ++b) {
      const auto& [l, d, side, by_p] = behind[b];
      Wide& along = side == 0 ? line.upper : line.lower;
      for (std::size_t i = 0; i < D; ++i)
        if (d == dir)
          along[i + 1][0][l] += by_p[i];
        else
          cross[2 * (d < dir ? d : d - 1) + 1 - side][i + 1][0][l] += static_cast<Real>(by_p[i]);
    }
    V forcing{};
    if (!grid.forcing.empty()) load<S>(grid.forcing.data() + shift, first, forcing);
    add_cell_jacobian<D>(volume, forcing, here, physics, line.diagonal);
    for (std::size_t l = 0; wet_lanes != 0 && l < k_lanes; ++l)  // a cell of water alone has no mass row
      if (grid.beside_air[static_cast<std::size_t>(first[l] + shift)] == 2)
        for (std::size_t j = 0; j <= D; ++j) line.diagonal[0][j][l] = j == 0 ? 1.0 : 0.0;
    line.diagonal[0][0] *= 1.0 + anchor;
    // a pressure on which nothing depends (a cell alone between walls, c infinite) stays as it is
    const V one_p = 1.0 + V{};
    line.diagonal[0][0] = line.diagonal[0][0] != 0.0 ? line.diagonal[0][0] : one_p;
    for (std::size_t l = 0; l < k_lanes; ++l) {
      if (grid.solved(first[l] + shift)) continue;
      SmallMatrix<D> one;
      for (std::size_t i = 0; i <= D; ++i) one[i][i] = 1.0;
      set_lane<D>(line.diagonal, l, one);
      for (Wide* a : {&line.lower, &line.upper}) set_lane<D>(*a, l, SmallMatrix<D>{});
      for (std::size_t c = 0; c < k_cross; ++c) set_lane<D>(cross[c], l, SmallMatrix<D>{});
    }
    eliminate(bundle, m, line);
  }
  if (layout_.cyclic) close(bundle, line);
}

/// Block Thomas elimination in double, whatever Real is: on thin cells the differences that are left at a
/// line's end are below float's resolution of the terms. A cyclic line is cut before its last cell:
/// x_k = y_k - closing_k x_last, and a Schur complement for x_last (Sherman-Morrison-Woodbury).
template <int D, class Real>
void LineOperator<D, Real>::eliminate(std::size_t bundle, int k, Line& line) {
  const std::size_t at = slot(bundle, k), m = static_cast<std::size_t>(k);
  Forward& forward = forward_[at];
  narrow<D>(line.diagonal, diagonal_[at]);
  narrow<D>(line.upper, upper_[at]);
  narrow<D>(line.lower, forward.lower);
  if (layout_.cyclic && k == layout_.length - 1) return;  // the cut cell; see close
  Wide pivot = line.diagonal;
  if (k > 0) subtract<D>(pivot, product<D>(line.lower, line.back[m - 1]));
  const Wide inv = inverse<D>(pivot);
  line.back[m] = product<D>(inv, line.upper);
  narrow<D>(inv, forward.inverse);
  narrow<D>(line.back[m], back_[at]);
  if (!layout_.cyclic) return;
  // right side: the column of the cut cell, which neighbours the first cell and the one before the last
  const bool last = k == layout_.length - 2;
  Wide column = k == 0 ? line.lower : Wide{};
  if (last) add<D>(column, line.upper);
  if (k > 0) subtract<D>(column, product<D>(line.lower, line.z[m - 1]));
  line.z[m] = product<D>(inv, column);
}

template <int D, class Real>
void LineOperator<D, Real>::close(std::size_t bundle, Line& line) {
  const auto open = static_cast<std::size_t>(layout_.length) - 1;
  for (std::size_t k = open - 1; k-- > 0;) subtract<D>(line.z[k], product<D>(line.back[k], line.z[k + 1]));
  Wide schur = line.diagonal;  // of the last cell, which was built last
  subtract<D>(schur, product<D>(line.lower, line.z[open - 1]));
  subtract<D>(schur, product<D>(line.upper, line.z[0]));
  narrow<D>(inverse<D>(schur), forward_[slot(bundle, layout_.length - 1)].inverse);
  for (std::size_t k = 0; k < open; ++k) narrow<D>(line.z[k], closing_[slot(bundle, static_cast<int>(k))]);
}

template <int D, class Real>
void LineOperator<D, Real>::build(const LevelGrid<D>& grid, const State<D>& state,
                                  const CorrectionPhysics<D>& physics, double anchor) {
  const std::size_t n_slots = layout_.bundles.size() * static_cast<std::size_t>(layout_.length);
  forward_.resize(n_slots);
  for (auto* matrices : {&back_, &diagonal_, &upper_}) matrices->resize(n_slots);
  if (layout_.cyclic) closing_.resize(n_slots);
  for (std::size_t d = 0, across = 0; d < D; ++d) {
    if (static_cast<int>(d) == layout_.direction) continue;
    cross_shift_[2 * across] = -grid.extent.stride[d];
    cross_shift_[2 * across + 1] = grid.extent.stride[d];
    ++across;
  }
#pragma omp parallel if (worth_threads(layout_.bundles.size()))
  {
    Line line(static_cast<std::size_t>(layout_.length));
#pragma omp for schedule(static)
    for (std::size_t bundle = 0; bundle < layout_.bundles.size(); ++bundle) {
      switch (layout_.bundles[bundle].spacing) {
        case LanePattern::one:
          build_bundle<LanePattern::one>(grid, state, physics, anchor, bundle, line);
          break;
        case LanePattern::two:
          build_bundle<LanePattern::two>(grid, state, physics, anchor, bundle, line);
          break;
        case LanePattern::any:
          build_bundle<LanePattern::any>(grid, state, physics, anchor, bundle, line);
          break;
      }
    }
  }
}

template void LineOperator<2, float>::build(const LevelGrid<2>&, const State<2>&, const CorrectionPhysics<2>&,
                                            double);
template void LineOperator<2, double>::build(const LevelGrid<2>&, const State<2>&,
                                             const CorrectionPhysics<2>&, double);
template void LineOperator<3, float>::build(const LevelGrid<3>&, const State<3>&, const CorrectionPhysics<3>&,
                                            double);
template void LineOperator<3, double>::build(const LevelGrid<3>&, const State<3>&,
                                             const CorrectionPhysics<3>&, double);

}  // namespace littoral::fv
