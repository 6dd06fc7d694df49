#include "overset/wall_side.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "grid/loops.hpp"
#include "grid/small_matrix.hpp"

namespace littoral::fv {
namespace {

template <std::size_t D>
std::array<double, D> minus(const std::array<double, D>& a, const std::array<double, D>& b) {
  std::array<double, D> c;
  for (std::size_t k = 0; k < D; ++k) c[k] = a[k] - b[k];
  return c;
}
template <std::size_t D>
std::array<double, D> along(const std::array<double, D>& a, double s,
                            const std::array<double, D>& direction) {
  std::array<double, D> c;
  for (std::size_t k = 0; k < D; ++k) c[k] = a[k] + s * direction[k];
  return c;
}

template <std::size_t D>
std::array<double, D> closest_on_segment(const std::array<double, D>& x, const std::array<double, D>& a,
                                         const std::array<double, D>& b) {
  const auto ab = minus(b, a);
  const double length2 = dot(ab, ab);
  return along(a, length2 > 0.0 ? std::clamp(dot(minus(x, a), ab) / length2, 0.0, 1.0) : 0.0, ab);
}

std::array<double, 2> closest(const std::array<double, 2>& x,
                              const std::array<std::array<double, 2>, 2>& corner) {
  return closest_on_segment(x, corner[0], corner[1]);
}

/// The foot of the perpendicular where it lies inside the triangle, else the closest place on its edges.
std::array<double, 3> closest(const std::array<double, 3>& x,
                              const std::array<std::array<double, 3>, 3>& corner) {
  const auto e = minus(corner[1], corner[0]), f = minus(corner[2], corner[0]), r = minus(x, corner[0]);
  const double ee = dot(e, e), ef = dot(e, f), ff = dot(f, f), re = dot(r, e), rf = dot(r, f);
  const double det = ee * ff - ef * ef;
  if (det > 0.0) {
    const double s = (re * ff - rf * ef) / det, t = (rf * ee - re * ef) / det;
    if (s >= 0.0 && t >= 0.0 && s + t <= 1.0) return along(along(corner[0], s, e), t, f);
  }
  std::array<double, 3> best{};
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    const auto c = closest_on_segment(x, corner[k], corner[(k + 1) % 3]);
    const auto d = minus(x, c);
    if (dot(d, d) < least) least = dot(d, d), best = c;
  }
  return best;
}

}  // namespace

template <int D>
WallSide<D>::WallSide(const std::vector<Block<D>>& blocks, const std::vector<std::size_t>& which) {
  for (const std::size_t b : which)
    for (const Window<D>& window : blocks[b].windows) {
      if (window.condition != Condition::wall && window.condition != Condition::slip) continue;
      const auto d = static_cast<std::size_t>(window.direction);
      auto lower = window.lower, upper = window.upper;
      lower[d] = window.side == 0 ? 0 : blocks[b].extent.n[d];
      upper[d] = lower[d] + 1;
      for_each_index<D>(lower, upper,
                        [&](const std::array<int, D>& index) { add_face(blocks[b], window, index); });
    }
  bound();
}

template <int D>
void WallSide<D>::add_face(const Block<D>& block, const Window<D>& window, const std::array<int, D>& index) {
  const auto d = static_cast<std::size_t>(window.direction);
  const auto face = static_cast<std::size_t>(block.extent.at(index));
  Facet facet;
  double size = 0.0;
  for (std::size_t k = 0; k < D; ++k) {
    facet.normal[k] = (window.side == 0 ? 1.0 : -1.0) * block.area[d][k][face];
    size += facet.normal[k] * facet.normal[k];
  }
  if (size == 0.0) return;  // a face without extent, at a pole
  for (double& component : facet.normal) component /= std::sqrt(size);
  const auto node = [&](const std::array<int, D>& at) {
    Point x;
    for (std::size_t k = 0; k < D; ++k)
      x[k] = block.node[k][static_cast<std::size_t>(block.node_extent.at(at))];
    return x;
  };
  if constexpr (D == 2) {
    auto next = index;
    ++next[1 - d];
    facet.corner = {node(index), node(next)};
    facets_.push_back(facet);
  } else {
    auto s = index, t = index, st = index;
    ++s[(d + 1) % 3], ++st[(d + 1) % 3];
    ++t[(d + 2) % 3], ++st[(d + 2) % 3];
    facet.corner = {node(index), node(s), node(st)};
    facets_.push_back(facet);
    facet.corner = {node(index), node(st), node(t)};
    facets_.push_back(facet);
  }
}

template <int D>
void WallSide<D>::bound() {
  constexpr std::size_t k_facets = 32;  // in a chunk: few enough to skip, enough to be worth a box
  for (std::size_t begin = 0; begin < facets_.size(); begin += k_facets) {
    Chunk chunk;
    chunk.begin = begin;
    chunk.end = std::min(begin + k_facets, facets_.size());
    chunk.lower.fill(std::numeric_limits<double>::infinity());
    chunk.upper.fill(-std::numeric_limits<double>::infinity());
    for (std::size_t i = chunk.begin; i < chunk.end; ++i)
      for (const Point& corner : facets_[i].corner)
        for (std::size_t k = 0; k < D; ++k) {
          chunk.lower[k] = std::min(chunk.lower[k], corner[k]);
          chunk.upper[k] = std::max(chunk.upper[k], corner[k]);
        }
    chunks_.push_back(chunk);
  }
}

template <int D>
bool WallSide<D>::behind(const std::array<double, D>& x) const {
  constexpr double k_equal = 1e-9;  // relative difference of squared distances that is round-off
  double least = std::numeric_limits<double>::infinity();
  double height = 0.0;  // over the deciding facet's plane
  for (const Chunk& chunk : chunks_) {
    double to_box = 0.0;
    for (std::size_t k = 0; k < D; ++k) {
      const double out = std::max({chunk.lower[k] - x[k], x[k] - chunk.upper[k], 0.0});
      to_box += out * out;
    }
    if (to_box > least * (1.0 + k_equal)) continue;
    for (std::size_t i = chunk.begin; i < chunk.end; ++i) {
      const Facet& facet = facets_[i];
      const Point away = minus(x, closest(x, facet.corner));
      const double distance2 = dot(away, away);
      if (distance2 > least * (1.0 + k_equal)) continue;
      const double over = dot(away, facet.normal);
      const bool nearer = distance2 < least * (1.0 - k_equal);
      // equally near: the steeper view decides, and the water where both are alike
      const bool steeper = std::abs(over) > std::abs(height) * (1.0 + k_equal) ||
                           (over > height && std::abs(over) >= std::abs(height) * (1.0 - k_equal));
      if (nearer || steeper) height = over;
      least = std::min(least, distance2);
    }
  }
  return height < 0.0;
}

template class WallSide<2>;
template class WallSide<3>;

}  // namespace littoral::fv
