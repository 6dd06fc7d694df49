#include "grid/join_windows.hpp"

#include <cstdio>
#include <map>
#include <optional>

#include "grid/loops.hpp"
#include "grid/space.hpp"

namespace littoral::fv {

template <int D>
using Index = std::array<int, D>;
template <int D>
using Point = std::array<double, D>;

namespace {

/// The join that a match is part of, in a form that is equal all over one rectangle: the image of index 0.
template <int D>
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

template <int D>
std::optional<Key<D>> key_of(const std::vector<FaceCell<D>>& faces, const FaceCell<D>& f) {
  if (!f.match) return {};
  const FaceCell<D>& g = faces[f.match->face];
  Key<D> k{g.block, g.direction, g.side, f.match->axis, {}, f.match->reversed, f.match->offset};
  for (std::size_t d = 0; d < D; ++d) {
    if (static_cast<int>(d) == f.direction) continue;
    const auto a = static_cast<std::size_t>(k.axis[d]);
    k.image[d] = g.index[a] + (k.reversed[d] ? f.index[d] : -f.index[d]);
  }
  return k;
}

template <int D>
Join<D> join_of(const Key<D>& key, const Window<D>& w) {
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

}  // namespace

template <int D>
std::vector<Window<D>> cut_window(const Window<D>& window, const std::vector<FaceCell<D>>& faces,
                                  const std::vector<std::size_t>& cells) {
  std::map<Index<D>, std::optional<Key<D>>> rest;  // by tangential index, entry [direction] 0
  Index<D> lower = window.lower, upper = window.upper;
  lower[static_cast<std::size_t>(window.direction)] = 0;
  upper[static_cast<std::size_t>(window.direction)] = 1;
  for_each_index<D>(lower, upper, [&](const Index<D>& i) { rest[i] = {}; });  // collapsed faces too
  for (const std::size_t f : cells) {
    Index<D> i = faces[f].index;
    i[static_cast<std::size_t>(window.direction)] = 0;
    rest[i] = key_of(faces, faces[f]);
  }
  const std::vector<int> t = tangential<D>(window.direction);
  std::vector<Window<D>> pieces;
  while (!rest.empty()) {
    const std::optional<Key<D>> key = rest.begin()->second;
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
      piece.join = join_of<D>(*key, piece);
    }
    pieces.push_back(piece);
  }
  return pieces;
}

template <int D>
bool told_here(std::size_t b, const Window<D>& w) {
  const auto here = std::array<int, 2>{w.direction, w.side};
  const auto there = std::array<int, 2>{w.join.direction, w.join.side};
  return b < w.join.block || (b == w.join.block && here <= there);
}

template <int D>
std::string describe_join(const std::vector<Block<D>>& blocks, std::size_t b, const Window<D>& w) {
  const Block<D>& there = blocks[w.join.block];
  const auto range = [](const Block<D>& block, int direction, const Index<D>& lower, const Index<D>& upper) {
    bool whole = true;
    std::string text;
    for (std::size_t d = 0; d < D; ++d) {
      if (static_cast<int>(d) == direction) continue;
      whole = whole && lower[d] == 0 && upper[d] == block.extent.n[d];
      text += (text.empty() ? "" : ", ") + std::to_string(lower[d]) + ".." + std::to_string(upper[d]);
    }
    return whole ? std::string() : "[" + text + "]";
  };
  std::string line = blocks[b].name + "." + face_name(blocks[b], w.direction, w.side) +
                     range(blocks[b], w.direction, w.lower, w.upper) + " joins " + there.name + "." +
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

template <int D>
std::string complain_unmet(const std::vector<Block<D>>& blocks, std::size_t b, const Window<D>& w) {
  Index<D> first = w.lower;
  const auto n = static_cast<std::size_t>(w.direction);
  first[n] = w.side == 0 ? 0 : blocks[b].extent.n[n] - 1;
  int count = 1;
  std::string cell;
  for (std::size_t d = 0; d < D; ++d) {
    if (d == n) continue;
    count *= w.upper[d] - w.lower[d];
    cell += (cell.empty() ? "" : ", ") + std::to_string(first[d]);
  }
  const coupler::Vec3 x = centre_in_space(blocks[b], blocks[b].extent.at(first));
  char text[96];
  std::snprintf(text, sizeof text, "(%.6g, %.6g, %.6g) m", x[0], x[1], x[2]);
  return "block '" + blocks[b].name + "', face " + face_name(blocks[b], w.direction, w.side) + ": " +
         std::to_string(count) + " faces from cell (" + cell + ") at " + text + " on meet no face " +
         (w.request.block.empty() ? "of another block" : "of block '" + w.request.block + "'") +
         " (nodes must coincide to 2% of an edge)" + (w.request.otherwise.empty() ? "" : ": ") +
         w.request.otherwise;
}

#define LITTORAL_JOIN_WINDOWS(D)                                                                   \
  template std::vector<Window<D>> cut_window(const Window<D>&, const std::vector<FaceCell<D>>&,    \
                                             const std::vector<std::size_t>&);                     \
  template bool told_here(std::size_t, const Window<D>&);                                          \
  template std::string describe_join(const std::vector<Block<D>>&, std::size_t, const Window<D>&); \
  template std::string complain_unmet(const std::vector<Block<D>>&, std::size_t, const Window<D>&)
LITTORAL_JOIN_WINDOWS(2);
LITTORAL_JOIN_WINDOWS(3);
#undef LITTORAL_JOIN_WINDOWS

}  // namespace littoral::fv
