#include "grid/find_joins.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <optional>

#include "boundary/exchange.hpp"
#include "grid/loops.hpp"
#include "grid/metrics.hpp"
#include "grid/space.hpp"
#include "littoral/error.hpp"

namespace littoral::fv {
namespace {

template <int D>
using Index = std::array<int, D>;
template <int D>
using Point = std::array<double, D>;

/// Faces match if their corners lie closer than this part of the shorter of their edges.
constexpr double k_tolerance = 0.02;

template <int D>
double distance(const Point<D>& a, const Point<D>& b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < D; ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return std::sqrt(sum);
}

/// Where a face cell's other side is: the cell there, and how the directions run.
template <int D>
struct Match {
  std::size_t face = 0;  // position in Finder's list
  Index<D> axis{};
  std::array<bool, D> reversed{};
  Point<D> offset{};
};

/// One cell of a window that may be joined.
template <int D>
struct FaceCell {
  std::size_t block = 0, window = 0;
  int direction = 0, side = 0;
  Index<D> index{};  // of the inner cell
  Point<D> centre{};
  double edge = 0.0;  // shortest one that is not collapsed
  std::optional<Match<D>> match;
};

template <int D>
Point<D> node(const Block<D>& block, const Index<D>& index) {
  Point<D> x;
  const auto n = static_cast<std::size_t>(block.node_extent.at(index));
  for (std::size_t k = 0; k < D; ++k) x[k] = block.node[k][n];
  return x;
}

/// Corner nodes of a face; bit t of `corner` steps along the t-th tangential direction.
template <int D>
Index<D> corner_index(const FaceCell<D>& f, unsigned corner) {
  Index<D> index = f.index;
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
std::vector<int> tangential(int direction) {
  std::vector<int> t;
  for (int d = 0; d < D; ++d)
    if (d != direction) t.push_back(d);
  return t;
}

int permutation_sign(const Index<2>& axis) { return axis[0] == 0 ? 1 : -1; }
int permutation_sign(const Index<3>& axis) {
  return (axis[0] + 1) % 3 == axis[1] && (axis[1] + 1) % 3 == axis[2] ? 1 : -1;
}

template <int D>
class Finder {
 public:
  explicit Finder(std::vector<Block<D>>& blocks) : blocks_(blocks) {
    for (std::size_t b = 0; b < blocks.size(); ++b)
      for (std::size_t w = 0; w < blocks[b].windows.size(); ++w)
        if (blocks[b].windows[w].request.kind != JoinRequest<D>::Kind::none) add(b, w);
    for (std::size_t f = 0; f < faces_.size(); ++f) order_.emplace_back(key(faces_[f].centre), f);
    std::sort(order_.begin(), order_.end());
  }

  bool any() const { return !faces_.empty(); }

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

  /// Joined faces share their nodes to the bit: those of the lower block (face) win.
  void share_nodes() {
    for (int round = 0; round < D; ++round)  // a corner may have to travel around
      for (const FaceCell<D>& f : faces_) {
        if (!f.match) continue;
        const FaceCell<D>& g = faces_[f.match->face];
        if (&g >= &f) continue;
        const std::vector<int> t = tangential<D>(f.direction);
        for (unsigned corner = 0; corner < (1u << (D - 1)); ++corner) {
          const auto to = static_cast<std::size_t>(blocks_[f.block].node_extent.at(corner_index(f, corner)));
          const auto from = static_cast<std::size_t>(
              blocks_[g.block].node_extent.at(corner_index(g, corner_there(f, g, *f.match, corner))));
          for (std::size_t k = 0; k < D; ++k)
            blocks_[f.block].node[k][to] = blocks_[g.block].node[k][from] + f.match->offset[k];
        }
      }
  }

  /// Cuts the windows into rectangles of one join each; what is not met keeps its condition.
  std::vector<std::string> rebuild(std::string& problems) {
    std::vector<std::string> lines;
    std::map<std::pair<std::size_t, std::size_t>, std::vector<std::size_t>> of_window;
    for (std::size_t f = 0; f < faces_.size(); ++f)
      of_window[{faces_[f].block, faces_[f].window}].push_back(f);
    std::vector<std::vector<Window<D>>> rebuilt(blocks_.size());
    for (std::size_t b = 0; b < blocks_.size(); ++b)
      for (std::size_t w = 0; w < blocks_[b].windows.size(); ++w) {
        const auto found = of_window.find({b, w});
        if (found == of_window.end()) {
          rebuilt[b].push_back(blocks_[b].windows[w]);
          continue;
        }
        for (Window<D>& piece : cut(blocks_[b].windows[w], found->second)) {
          const bool joined = piece.condition == Condition::join && piece.join.upper != Index<D>{};
          if (joined) {
            if (told_here(b, piece)) lines.push_back(describe(b, piece));
          } else if (piece.request.kind == JoinRequest<D>::Kind::required)
            problems += (problems.empty() ? "" : "\n") + complaint(b, piece);
          rebuilt[b].push_back(std::move(piece));
        }
      }
    for (std::size_t b = 0; b < blocks_.size(); ++b) blocks_[b].windows = std::move(rebuilt[b]);
    return lines;
  }

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

  unsigned corner_there(const FaceCell<D>& f, const FaceCell<D>& g, const Match<D>& m,
                        unsigned corner) const {
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

  /// The orientation in which g's corners fall on f's, if any does: right-handed blocks meet in one way in a
  /// plane, in four in space.
  std::optional<Match<D>> orientation(const FaceCell<D>& f, std::size_t g_position,
                                      const Point<D>& offset) const {
    const FaceCell<D>& g = faces_[g_position];
    const std::vector<int> here = tangential<D>(f.direction), there = tangential<D>(g.direction);
    const double tolerance = k_tolerance * std::min(f.edge, g.edge);
    std::optional<Match<D>> best;
    double best_distance = tolerance;
    for (unsigned swap = 0; swap < (D == 3 ? 2u : 1u); ++swap)
      for (unsigned reversal = 0; reversal < (1u << (D - 1)); ++reversal) {
        Match<D> m;
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
      Match<D> back;
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

  /// The join that a match is part of, in a form that is equal all over one rectangle: the image of index 0.
  struct Key {
    std::size_t block;
    int direction, side;
    Index<D> axis, image;
    std::array<bool, D> reversed;
    Point<D> offset;
    bool operator==(const Key& o) const {
      return block == o.block && direction == o.direction && side == o.side && axis == o.axis &&
             image == o.image && reversed == o.reversed && offset == o.offset;
    }
  };
  std::optional<Key> key_of(const FaceCell<D>& f) const {
    if (!f.match) return {};
    const FaceCell<D>& g = faces_[f.match->face];
    Key k{g.block, g.direction, g.side, f.match->axis, {}, f.match->reversed, f.match->offset};
    for (std::size_t d = 0; d < D; ++d) {
      if (static_cast<int>(d) == f.direction) continue;
      const auto a = static_cast<std::size_t>(k.axis[d]);
      k.image[d] = g.index[a] + (k.reversed[d] ? f.index[d] : -f.index[d]);
    }
    return k;
  }

  /// Maximal rectangles of one key, lower indices first.
  std::vector<Window<D>> cut(const Window<D>& window, const std::vector<std::size_t>& cells) const {
    std::map<Index<D>, std::optional<Key>> rest;  // by tangential index, entry [direction] 0
    Index<D> lower = window.lower, upper = window.upper;
    lower[static_cast<std::size_t>(window.direction)] = 0;
    upper[static_cast<std::size_t>(window.direction)] = 1;
    for_each_index<D>(lower, upper, [&](const Index<D>& i) { rest[i] = {}; });  // collapsed faces too
    for (const std::size_t f : cells) {
      Index<D> i = faces_[f].index;
      i[static_cast<std::size_t>(window.direction)] = 0;
      rest[i] = key_of(faces_[f]);
    }
    const std::vector<int> t = tangential<D>(window.direction);
    std::vector<Window<D>> pieces;
    while (!rest.empty()) {
      const std::optional<Key> key = rest.begin()->second;
      Window<D> piece = window;
      piece.lower = rest.begin()->first;
      piece.upper = piece.lower;
      for (int& u : piece.upper) ++u;
      const auto fits = [&](const Index<D>& from, const Index<D>& to) {
        bool all = true;
        for_each_index<D>(from, to, [&](const Index<D>& i) {
          const auto at = rest.find(i);
          all = all && at != rest.end() && at->second == key;
        });
        return all;
      };
      for (auto d = t.rbegin(); d != t.rend(); ++d) {  // the map's order runs along the last direction
        const auto s = static_cast<std::size_t>(*d);
        for (;;) {
          Index<D> from = piece.lower, to = piece.upper;
          from[s] = to[s];
          to[s] += 1;
          if (!fits(from, to)) break;
          piece.upper[s] += 1;
        }
      }
      for_each_index<D>(piece.lower, piece.upper, [&](const Index<D>& i) { rest.erase(i); });
      if (key) {
        piece.condition = Condition::join;
        piece.join = join_of(*key, piece);
      }
      pieces.push_back(piece);
    }
    return pieces;
  }

  static Join<D> join_of(const Key& key, const Window<D>& w) {
    Join<D> join;
    join.block = key.block;
    join.direction = key.direction;
    join.side = key.side;
    join.axis = key.axis;
    join.reversed = key.reversed;
    join.offset = key.offset;
    join.upper[static_cast<std::size_t>(key.direction)] = 1;
    for (std::size_t d = 0; d < D; ++d) {
      if (static_cast<int>(d) == w.direction) continue;
      const auto a = static_cast<std::size_t>(key.axis[d]);
      join.lower[a] = key.reversed[d] ? key.image[d] - (w.upper[d] - 1) : key.image[d] + w.lower[d];
      join.upper[a] = join.lower[a] + w.upper[d] - w.lower[d];
    }
    return join;
  }

  /// A join is told once, by the lower of its blocks (faces).
  static bool told_here(std::size_t b, const Window<D>& w) {
    const auto here = std::array<int, 2>{w.direction, w.side};
    const auto there = std::array<int, 2>{w.join.direction, w.join.side};
    return b < w.join.block || (b == w.join.block && here <= there);
  }

  std::string describe(std::size_t b, const Window<D>& w) const {
    const Block<D>& there = blocks_[w.join.block];
    const auto range = [](const Block<D>& block, int direction, const Index<D>& lower,
                          const Index<D>& upper) {
      bool whole = true;
      std::string text;
      for (std::size_t d = 0; d < D; ++d) {
        if (static_cast<int>(d) == direction) continue;
        whole = whole && lower[d] == 0 && upper[d] == block.extent.n[d];
        text += (text.empty() ? "" : ", ") + std::to_string(lower[d]) + ".." + std::to_string(upper[d]);
      }
      return whole ? std::string() : "[" + text + "]";
    };
    std::string line = blocks_[b].name + "." + face_name(blocks_[b], w.direction, w.side) +
                       range(blocks_[b], w.direction, w.lower, w.upper) + " joins " + there.name + "." +
                       face_name(there, w.join.direction, w.join.side) +
                       range(there, w.join.direction, w.join.lower, w.join.upper);
    for (std::size_t d = 0; d < D; ++d)
      if (static_cast<int>(d) != w.direction && (w.join.reversed[d] || w.join.axis[d] != static_cast<int>(d)))
        line += std::string(", direction ") + "ijk"[d] + " along " + (w.join.reversed[d] ? "-" : "") +
                "ijk"[static_cast<std::size_t>(w.join.axis[d])];
    if (w.join.offset != Point<D>{}) {
      char text[96];
      const coupler::Vec3 x = vector_in_space<D>(w.join.offset);
      std::snprintf(text, sizeof text, ", offset (%g, %g, %g) m", x[0], x[1], x[2]);
      line += text;
    }
    return line;
  }

  std::string complaint(std::size_t b, const Window<D>& w) const {
    Index<D> first = w.lower;
    const auto n = static_cast<std::size_t>(w.direction);
    first[n] = w.side == 0 ? 0 : blocks_[b].extent.n[n] - 1;
    int count = 1;
    std::string cell;
    for (std::size_t d = 0; d < D; ++d) {
      if (d == n) continue;
      count *= w.upper[d] - w.lower[d];
      cell += (cell.empty() ? "" : ", ") + std::to_string(first[d]);
    }
    const coupler::Vec3 x = centre_in_space(blocks_[b], blocks_[b].extent.at(first));
    char text[96];
    std::snprintf(text, sizeof text, "(%.6g, %.6g, %.6g) m", x[0], x[1], x[2]);
    return "block '" + blocks_[b].name + "', face " + face_name(blocks_[b], w.direction, w.side) + ": " +
           std::to_string(count) + " faces from cell (" + cell + ") at " + text + " on meet no face " +
           (w.request.block.empty() ? "of another block" : "of block '" + w.request.block + "'") +
           " (nodes must coincide to 2% of an edge)" + (w.request.otherwise.empty() ? "" : ": ") +
           w.request.otherwise;
  }

  std::vector<Block<D>>& blocks_;
  std::vector<FaceCell<D>> faces_;
  std::vector<std::pair<double, std::size_t>> order_;
};

/// A block that meets itself, whole face to whole opposite face and the same way round, is a periodic one:
/// lines around it close on themselves.
template <int D>
void close_on_themselves(std::vector<Block<D>>& blocks) {
  for (std::size_t b = 0; b < blocks.size(); ++b)
    for (int d = 0; d < D; ++d) {
      std::vector<Window<D>*> pair;
      for (Window<D>& w : blocks[b].windows)
        if (w.direction == d) pair.push_back(&w);
      if (pair.size() != 2) continue;
      bool closes = true;
      for (const Window<D>* w : pair) {
        closes = closes && w->condition == Condition::join && w->join.block == b && w->join.direction == d &&
                 w->join.side != w->side;
        for (std::size_t k = 0; k < D; ++k)
          closes = closes && w->join.axis[k] == static_cast<int>(k) && !w->join.reversed[k] &&
                   (static_cast<int>(k) == d || w->join.lower[k] == w->lower[k]);
      }
      if (!closes) continue;
      blocks[b].periodic[static_cast<std::size_t>(d)] = true;
      for (Window<D>* w : pair) w->condition = Condition::periodic;
    }
}

}  // namespace

template <int D>
std::vector<std::string> find_joins(std::vector<Block<D>>& blocks) {
  Finder<D> finder(blocks);
  if (!finder.any()) return {};
  finder.match();
  std::string problems;
  const std::vector<std::string> lines = finder.rebuild(problems);
  if (!problems.empty()) throw ConfigError(problems);
  if (lines.empty()) return {};
  finder.share_nodes();
  close_on_themselves(blocks);
  for (auto& block : blocks) set_metrics(block);
  join_metrics(blocks);
  return lines;
}

template std::vector<std::string> find_joins(std::vector<Block<2>>&);
template std::vector<std::string> find_joins(std::vector<Block<3>>&);

}  // namespace littoral::fv
