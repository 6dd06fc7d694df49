#include "grid/match_faces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "grid/loops.hpp"

namespace littoral::fv {

template <int D>
using Index = std::array<int, D>;
template <int D>
using Point = std::array<double, D>;

template <int D>
std::vector<int> tangential(int direction) {
  std::vector<int> t;
  for (int d = 0; d < D; ++d)
    if (d != direction) t.push_back(d);
  return t;
}

template <int D>
std::array<int, D> corner_index(const FaceCell<D>& f, unsigned corner) {
  std::array<int, D> index = f.index;
  unsigned bit = 0;
  for (std::size_t d = 0; d < D; ++d) {
    if (static_cast<int>(d) == f.direction)
      index[d] += f.side;
    else
      index[d] += (corner >> bit++) & 1u;
  }
  return index;
}

template <int D>
unsigned corner_there(const FaceCell<D>& f, const FaceCell<D>& g, const FaceMatch<D>& m, unsigned corner) {
  const std::vector<int> here = tangential<D>(f.direction), there = tangential<D>(g.direction);
  unsigned other = 0;
  for (unsigned bit = 0; bit < here.size(); ++bit) {
    const auto d = static_cast<std::size_t>(here[bit]);
    const bool up = ((corner >> bit) & 1u) != (m.reversed[d] ? 1u : 0u);
    for (unsigned b = 0; b < there.size(); ++b)
      if (up && there[b] == m.axis[d]) other |= 1u << b;
  }
  return other;
}

namespace {

/// Faces match if their corners lie closer than this part of the shorter of their edges.
constexpr double k_tolerance = 0.02;

template <int D>
double distance(const Point<D>& a, const Point<D>& b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < D; ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return std::sqrt(sum);
}

template <int D>
Point<D> node(const Block<D>& block, const Index<D>& index) {
  Point<D> x;
  const auto n = static_cast<std::size_t>(block.node_extent.at(index));
  for (std::size_t k = 0; k < D; ++k) x[k] = block.node[k][n];
  return x;
}

int permutation_sign(const Index<2>& axis) { return axis[0] == 0 ? 1 : -1; }
int permutation_sign(const Index<3>& axis) {
  return (axis[0] + 1) % 3 == axis[1] && (axis[1] + 1) % 3 == axis[2] ? 1 : -1;
}

template <int D>
class Matcher {
 public:
  explicit Matcher(const std::vector<Block<D>>& blocks) : blocks_(blocks) {
    for (std::size_t b = 0; b < blocks.size(); ++b)
      for (std::size_t w = 0; w < blocks[b].windows.size(); ++w)
        if (blocks[b].windows[w].request.kind != JoinRequest<D>::Kind::none) add(b, w);
    for (std::size_t f = 0; f < faces_.size(); ++f) order_.emplace_back(key(faces_[f].centre), f);
    std::sort(order_.begin(), order_.end());
  }

  /// Those who say with whom first, then those that meet without an offset.
  void match() {
    for (const bool named : {true, false})
      for (std::size_t f = 0; f < faces_.size(); ++f) {
        const JoinRequest<D>& request = request_of(faces_[f]);
        if (named == request.block.empty() && request.direction < 0) continue;
        search(f, Point<D>{});
      }
    for (std::size_t f = 0; f < faces_.size(); ++f)
      for (const Point<D>& offset : request_of(faces_[f]).offsets) search(f, offset);
  }

  std::vector<FaceCell<D>> faces() && { return std::move(faces_); }

 private:
  const JoinRequest<D>& request_of(const FaceCell<D>& f) const {
    return blocks_[f.block].windows[f.window].request;
  }

  void add(std::size_t b, std::size_t w) {
    const Window<D>& window = blocks_[b].windows[w];
    Index<D> lower = window.lower, upper = window.upper;
    const auto n = static_cast<std::size_t>(window.direction);
    lower[n] = window.side == 0 ? 0 : blocks_[b].extent.n[n] - 1;
    upper[n] = lower[n] + 1;
    for_each_index<D>(lower, upper, [&](const Index<D>& index) {
      FaceCell<D> f;
      f.block = b;
      f.window = w;
      f.direction = window.direction;
      f.side = window.side;
      f.index = index;
      constexpr unsigned corners = 1u << (D - 1);
      double longest = 0.0, shortest = std::numeric_limits<double>::infinity();
      for (unsigned c = 0; c < corners; ++c) {
        const Point<D> x = node<D>(blocks_[b], corner_index(f, c));
        for (std::size_t k = 0; k < D; ++k) f.centre[k] += x[k] / corners;
        for (unsigned bit = 0; bit + 1 < D; ++bit)
          longest = std::max(longest, distance<D>(x, node<D>(blocks_[b], corner_index(f, c ^ (1u << bit)))));
      }
      for (unsigned c = 0; c < corners; ++c)
        for (unsigned bit = 0; bit + 1 < D; ++bit) {
          const double edge = distance<D>(node<D>(blocks_[b], corner_index(f, c)),
                                          node<D>(blocks_[b], corner_index(f, c ^ (1u << bit))));
          if (edge > 1e-9 * longest) shortest = std::min(shortest, edge);
        }
      f.edge = longest > 0.0 ? shortest : 0.0;
      if (f.edge > 0.0) faces_.push_back(f);  // a face collapsed to a point or line meets nobody
    });
  }

  /// Projection on a direction no grid is aligned with: neighbours in this order are few.
  static double key(const Point<D>& x) {
    constexpr std::array<double, 3> direction = {0.5377, 0.6287, 0.5618};
    double sum = 0.0;
    for (std::size_t k = 0; k < D; ++k) sum += direction[k] * x[k];
    return sum;
  }

  /// The orientation in which g's corners fall on f's, if any does: right-handed blocks meet in one way in a
  /// plane, in four in space.
  std::optional<FaceMatch<D>> orientation(const FaceCell<D>& f, std::size_t g_position,
                                          const Point<D>& offset) const {
    const FaceCell<D>& g = faces_[g_position];
    const std::vector<int> here = tangential<D>(f.direction), there = tangential<D>(g.direction);
    const double tolerance = k_tolerance * std::min(f.edge, g.edge);
    std::optional<FaceMatch<D>> best;
    double best_distance = tolerance;
    for (unsigned swap = 0; swap < (D == 3 ? 2u : 1u); ++swap)
      for (unsigned reversal = 0; reversal < (1u << (D - 1)); ++reversal) {
        FaceMatch<D> m;
        m.face = g_position;
        m.offset = offset;
        m.axis[static_cast<std::size_t>(f.direction)] = g.direction;
        int sign = f.side != g.side ? 1 : -1;  // from here's lower out of there's upper: the same way
        for (std::size_t bit = 0; bit < here.size(); ++bit) {
          const auto d = static_cast<std::size_t>(here[bit]);
          m.axis[d] = there[swap ? here.size() - 1 - bit : bit];
          m.reversed[d] = (reversal >> bit) & 1u;
          if (m.reversed[d]) sign = -sign;
        }
        if (sign * permutation_sign(m.axis) != 1) continue;
        double worst = 0.0;
        for (unsigned c = 0; c < (1u << (D - 1)); ++c) {
          Point<D> x = node<D>(blocks_[g.block], corner_index(g, corner_there(f, g, m, c)));
          for (std::size_t k = 0; k < D; ++k) x[k] += offset[k];
          worst = std::max(worst, distance<D>(x, node<D>(blocks_[f.block], corner_index(f, c))));
        }
        if (worst < best_distance) {
          best_distance = worst;
          best = m;
        }
      }
    return best;
  }

  bool admits(const FaceCell<D>& f, const FaceCell<D>& g) const {
    const JoinRequest<D>& r = request_of(f);
    return (r.block.empty() || r.block == blocks_[g.block].name) &&
           (r.direction < 0 || (r.direction == g.direction && r.side == g.side));
  }

  void search(std::size_t position, const Point<D>& offset) {
    FaceCell<D>& f = faces_[position];
    if (f.match) return;
    Point<D> x = f.centre;
    for (std::size_t k = 0; k < D; ++k) x[k] -= offset[k];
    const double reach = k_tolerance * f.edge;
    auto next =
        std::lower_bound(order_.begin(), order_.end(), std::pair<double, std::size_t>{key(x) - reach, 0});
    for (; next != order_.end() && next->first <= key(x) + reach; ++next) {
      FaceCell<D>& g = faces_[next->second];
      if (next->second == position || g.match || distance<D>(x, g.centre) > reach) continue;
      if (!admits(f, g) || !admits(g, f)) continue;
      const auto m = orientation(f, next->second, offset);
      if (!m) continue;
      f.match = m;
      FaceMatch<D> back;
      back.face = position;
      for (std::size_t d = 0; d < D; ++d) {
        const auto a = static_cast<std::size_t>(m->axis[d]);
        back.axis[a] = static_cast<int>(d);
        back.reversed[a] = m->reversed[d];
        back.offset[d] = -m->offset[d];
      }
      g.match = back;
      return;
    }
  }

  const std::vector<Block<D>>& blocks_;
  std::vector<FaceCell<D>> faces_;
  std::vector<std::pair<double, std::size_t>> order_;
};

}  // namespace

template <int D>
std::vector<FaceCell<D>> match_faces(const std::vector<Block<D>>& blocks) {
  Matcher<D> matcher(blocks);
  matcher.match();
  return std::move(matcher).faces();
}

#define LITTORAL_MATCH_FACES(D)                                                                          \
  template std::vector<int> tangential<D>(int);                                                          \
  template std::array<int, D> corner_index<D>(const FaceCell<D>&, unsigned);                             \
  template unsigned corner_there(const FaceCell<D>&, const FaceCell<D>&, const FaceMatch<D>&, unsigned); \
  template std::vector<FaceCell<D>> match_faces(const std::vector<Block<D>>&)
LITTORAL_MATCH_FACES(2);
LITTORAL_MATCH_FACES(3);
#undef LITTORAL_MATCH_FACES

}  // namespace littoral::fv
