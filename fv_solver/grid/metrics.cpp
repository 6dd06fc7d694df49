#include "grid/metrics.hpp"

#include <cmath>
#include <exception>
#include <string>

#include "grid/loops.hpp"
#include "littoral/error.hpp"

namespace littoral::fv {
namespace {

template <int D>
using Point = std::array<double, D>;

template <int D>
Point<D> at(const VectorField<D>& field, std::ptrdiff_t c) {
  Point<D> x;
  for (std::size_t d = 0; d < D; ++d) x[d] = field[d][static_cast<std::size_t>(c)];
  return x;
}

template <int D>
Point<D> minus(const Point<D>& a, const Point<D>& b) {
  Point<D> x;
  for (std::size_t d = 0; d < D; ++d) x[d] = a[d] - b[d];
  return x;
}

Point<3> cross(const Point<3>& a, const Point<3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double dot(const Point<3>& a, const Point<3>& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Continues the nodes two layers beyond each face. Directions in turn, over the ghosts of those before, so
/// that edges and corners are set too.
template <int D>
void set_ghost_nodes(Block<D>& block) {
  const Extent<D>& e = block.node_extent;
  std::array<int, D> lower{};
  std::array<int, D> upper = e.n;
  for (std::size_t d = 0; d < D; ++d) {
    const int n = block.extent.n[d];
    auto lo = lower;
    auto up = upper;
    lo[d] = 0;
    up[d] = 1;
    for_each_index<D>(lo, up, [&](std::array<int, D> index) {
      const std::ptrdiff_t first = e.at(index);
      const std::ptrdiff_t s = e.stride[d];
      const std::ptrdiff_t last = first + n * s;
      for (std::size_t k = 0; k < D; ++k) {
        double* x = block.node[k].data();
        for (int layer = 1; layer <= k_ghost; ++layer) {
          // a block of one cell has only one inner layer to mirror: go on with its spacing
          const int m = std::min(layer, n);
          const double below = block.periodic[d] ? x[last - m * s] - x[last] : x[first] - x[first + m * s];
          const double above = block.periodic[d] ? x[first + m * s] - x[first] : x[last] - x[last - m * s];
          const double factor = static_cast<double>(layer) / m;
          x[first - layer * s] = x[first] + factor * below;
          x[last + layer * s] = x[last] + factor * above;
        }
      }
    });
    lower[d] = -k_ghost;
    upper[d] = e.n[d] + k_ghost;
  }
}

/// Area vector of the lower face of direction d at node n: edge normal in a plane, half the cross product of
/// the diagonals in space. Exact for any (also warped) face, so cells close to round-off.
Point<2> face_area(const Block<2>& b, std::size_t d, std::ptrdiff_t n) {
  const std::ptrdiff_t t = b.node_extent.stride[1 - d];
  const Point<2> edge = minus<2>(at<2>(b.node, n + t), at<2>(b.node, n));
  return d == 0 ? Point<2>{edge[1], -edge[0]} : Point<2>{-edge[1], edge[0]};
}
Point<3> face_area(const Block<3>& b, std::size_t d, std::ptrdiff_t n) {
  const std::ptrdiff_t s = b.node_extent.stride[(d + 1) % 3];
  const std::ptrdiff_t t = b.node_extent.stride[(d + 2) % 3];
  const Point<3> diagonal = minus<3>(at<3>(b.node, n + s + t), at<3>(b.node, n));
  const Point<3> other = minus<3>(at<3>(b.node, n + t), at<3>(b.node, n + s));
  Point<3> a = cross(diagonal, other);
  for (double& component : a) component *= 0.5;
  return a;
}

double cell_volume(const Block<2>& b, std::ptrdiff_t n) {
  const auto& s = b.node_extent.stride;
  const Point<2> diagonal = minus<2>(at<2>(b.node, n + s[0] + s[1]), at<2>(b.node, n));
  const Point<2> other = minus<2>(at<2>(b.node, n + s[1]), at<2>(b.node, n + s[0]));
  return 0.5 * (diagonal[0] * other[1] - diagonal[1] * other[0]);
}
/// Volume of the trilinear map: its Jacobian is quadratic in each coordinate, so two Gauss points a direction
/// are exact.
double cell_volume(const Block<3>& b, std::ptrdiff_t n) {
  const auto& s = b.node_extent.stride;
  std::array<Point<3>, 8> corner;
  for (std::size_t k = 0; k < 8; ++k)
    corner[k] = at<3>(b.node, n + (k & 1 ? s[0] : 0) + (k & 2 ? s[1] : 0) + (k & 4 ? s[2] : 0));
  const double gauss = 0.5 / std::sqrt(3.0);
  double volume = 0.0;
  for (int q = 0; q < 8; ++q) {
    const Point<3> xi = {0.5 + (q & 1 ? gauss : -gauss), 0.5 + (q & 2 ? gauss : -gauss),
                         0.5 + (q & 4 ? gauss : -gauss)};
    std::array<Point<3>, 3> tangent{};
    for (std::size_t k = 0; k < 8; ++k) {
      for (std::size_t d = 0; d < 3; ++d) {
        double w = (k >> d) & 1 ? 1.0 : -1.0;
        for (std::size_t o = 0; o < 3; ++o)
          if (o != d) w *= (k >> o) & 1 ? xi[o] : 1.0 - xi[o];
        for (std::size_t c = 0; c < 3; ++c) tangent[d][c] += w * corner[k][c];
      }
    }
    volume += 0.125 * dot(tangent[0], cross(tangent[1], tangent[2]));
  }
  return volume;
}

template <int D>
std::string place(const Block<D>& block, const std::array<int, D>& index) {
  std::string text = "block '" + block.name + "' cell (";
  for (std::size_t d = 0; d < D; ++d) text += (d ? ", " : "") + std::to_string(index[d]);
  text += ") at (";
  const Point<D> x = at<D>(block.centre, block.extent.at(index));
  for (std::size_t d = 0; d < D; ++d) text += (d ? ", " : "") + std::to_string(x[d]);
  return text + ") m";
}

}  // namespace

template <int D>
void set_solved_mask(Block<D>& block) {
  block.solved.assign(block.extent.size, 0.0);
  for_each_index<D>({}, block.extent.n, [&](const std::array<int, D>& index) {
    const auto c = static_cast<std::size_t>(block.extent.at(index));
    const CellStatus s = block.status[c];
    block.solved[c] = s == CellStatus::computed || s == CellStatus::forced ? 1.0 : 0.0;
  });
}

template <int D>
void set_metrics(Block<D>& block) {
  set_ghost_nodes(block);
  const Extent<D>& e = block.extent;
  for (auto& f : block.centre) f.assign(e.size, 0.0);
  for (auto& direction : block.area)
    for (auto& f : direction) f.assign(e.size, 0.0);
  block.volume.assign(e.size, 0.0);
  block.width.assign(e.size, 0.0);
  block.status.assign(e.size, CellStatus::fringe);

  std::array<int, D> lower, upper;
  lower.fill(-k_ghost);
  for (std::size_t d = 0; d < D; ++d) upper[d] = e.n[d] + k_ghost;
  for_each_index<D>(lower, upper, [&](const std::array<int, D>& index) {
    const auto c = static_cast<std::size_t>(e.at(index));
    const std::ptrdiff_t n = block.node_extent.at(index);
    for (std::size_t corner = 0; corner < (1u << D); ++corner) {
      std::ptrdiff_t m = n;
      for (std::size_t d = 0; d < D; ++d) m += (corner >> d) & 1 ? block.node_extent.stride[d] : 0;
      for (std::size_t k = 0; k < D; ++k)
        block.centre[k][c] += block.node[k][static_cast<std::size_t>(m)] / (1u << D);
    }
    block.volume[c] = cell_volume(block, n);
    block.width[c] = D == 2 ? std::sqrt(block.volume[c]) : std::cbrt(block.volume[c]);
    for (std::size_t d = 0; d < D; ++d) {
      const Point<D> a = face_area(block, d, n);
      for (std::size_t k = 0; k < D; ++k) block.area[d][k][c] = a[k];
    }
  });
  std::string folded;
  int n_folded = 0;
  constexpr int k_named = 3;
  for_each_index<D>({}, e.n, [&](const std::array<int, D>& index) {
    const auto c = static_cast<std::size_t>(e.at(index));
    block.status[c] = CellStatus::computed;
    if (block.volume[c] > 0.0) return;
    if (++n_folded <= k_named)
      folded +=
          (folded.empty() ? "" : ", ") + std::to_string(block.volume[c]) + " in " + place<D>(block, index);
  });
  if (n_folded > 0)
    throw ConfigError(
        "the grid is folded: " + std::to_string(n_folded) + " cells without a positive volume: " + folded +
        (n_folded > k_named ? ", ..." : "") +
        "; every cell needs one (is the mapping one-to-one, and do the directions form a right-handed "
        "system?)");
  set_solved_mask(block);
}

template <int D>
Block<D> make_block(const std::string& name, const std::array<int, D>& cells,
                    const std::array<bool, D>& periodic,
                    const std::function<std::array<double, D>(const std::array<int, D>&)>& position) {
  Block<D> block;
  block.name = name;
  block.periodic = periodic;
  block.extent = Extent<D>(cells);
  std::array<int, D> nodes = cells;
  for (int& n : nodes) ++n;
  block.node_extent = Extent<D>(nodes);
  try {
    for (auto& f : block.node) f.assign(block.node_extent.size, 0.0);
  } catch (const std::exception&) {  // bad_alloc, length_error
    std::string counts;
    for (const int n : cells) counts += (counts.empty() ? "" : " x ") + std::to_string(n);
    throw ConfigError("block '" + name + "': there is no memory for " + counts +
                      " cells; a run needs about 2.5 kB for each");
  }
  for_each_index<D>({}, nodes, [&](const std::array<int, D>& index) {
    const auto x = position(index);
    const auto n = static_cast<std::size_t>(block.node_extent.at(index));
    for (std::size_t d = 0; d < D; ++d) block.node[d][n] = x[d];
  });
  set_metrics(block);
  return block;
}

template void set_metrics(Block<2>&);
template void set_metrics(Block<3>&);
template void set_solved_mask(Block<2>&);
template void set_solved_mask(Block<3>&);
template Block<2> make_block<2>(const std::string&, const std::array<int, 2>&, const std::array<bool, 2>&,
                                const std::function<std::array<double, 2>(const std::array<int, 2>&)>&);
template Block<3> make_block<3>(const std::string&, const std::array<int, 3>&, const std::array<bool, 3>&,
                                const std::function<std::array<double, 3>(const std::array<int, 3>&)>&);

}  // namespace littoral::fv
