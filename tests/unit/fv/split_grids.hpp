#pragma once

#include <functional>
#include <random>
#include <set>

#include "boundary/exchange.hpp"
#include "grid/find_joins.hpp"
#include "grids.hpp"

namespace littoral::fv {

/// A right-handed renumbering of a block's directions: direction d here runs along direction[d] of the
/// original, against it where reversed.
template <int D>
struct Turn {
  std::array<int, D> direction{};
  std::array<bool, D> reversed{};
};

template <int D>
std::vector<Turn<D>> all_turns() {
  std::vector<Turn<D>> turns;
  std::array<int, D> p;
  for (std::size_t d = 0; d < D; ++d) p[d] = static_cast<int>(d);
  do {
    for (unsigned bits = 0; bits < (1u << D); ++bits) {
      int sign = 1;
      for (std::size_t a = 0; a < D; ++a)
        for (std::size_t b = a + 1; b < D; ++b)
          if (p[a] > p[b]) sign = -sign;
      Turn<D> t;
      t.direction = p;
      for (std::size_t d = 0; d < D; ++d) {
        t.reversed[d] = (bits >> d) & 1u;
        if (t.reversed[d]) sign = -sign;
      }
      if (sign > 0) turns.push_back(t);
    }
  } while (std::next_permutation(p.begin(), p.end()));
  return turns;
}

/// A grid given as one block, and the same cells dealt to several blocks, each turned its own way.
template <int D>
struct SplitGrid {
  using Index = std::array<int, D>;
  Block<D> whole;
  std::vector<Block<D>> parts;
  std::vector<Index> first, cells;  // of each part, in the whole's index space
  std::vector<Turn<D>> turn;

  /// cell of part b where the whole's cell `index` is
  Index in_part(std::size_t b, const Index& index) const {
    Index i;
    for (std::size_t d = 0; d < D; ++d) {
      const auto o = static_cast<std::size_t>(turn[b].direction[d]);
      const int local = index[o] - first[b][o];
      i[d] = turn[b].reversed[d] ? cells[b][o] - 1 - local : local;
    }
    return i;
  }
  /// body(part, offset in part, offset in the whole) for every cell
  template <class Body>
  void for_each_cell_of_parts(Body&& body) const {
    for (std::size_t b = 0; b < parts.size(); ++b) {
      Index upper = first[b];
      for (std::size_t d = 0; d < D; ++d) upper[d] += cells[b][d];
      for_each_index<D>(first[b], upper, [&](const Index& i) {
        body(b, static_cast<std::size_t>(parts[b].extent.at(in_part(b, i))),
             static_cast<std::size_t>(whole.extent.at(i)));
      });
    }
  }
};

/// cuts[d]: cell counts of the parts along d. close: the window for a face of the whole (direction, side).
/// seed 0: no turns
template <int D>
SplitGrid<D> split_grid(const std::array<std::vector<int>, D>& cuts, const std::array<bool, D>& periodic,
                        const std::function<std::array<double, D>(const std::array<double, D>&)>& map,
                        const std::function<Window<D>(int, int)>& close, unsigned seed) {
  using Index = std::array<int, D>;
  SplitGrid<D> s;
  Index n{}, pieces{};
  for (std::size_t d = 0; d < D; ++d) {
    for (int c : cuts[d]) n[d] += c;
    pieces[d] = static_cast<int>(cuts[d].size());
  }
  const auto position = [&](const Index& i) {
    std::array<double, D> xi;
    for (std::size_t d = 0; d < D; ++d) xi[d] = static_cast<double>(i[d]) / n[d];
    return map(xi);
  };
  s.whole = make_block<D>("whole", n, periodic, position);
  std::array<std::array<double, D>, D> period{};  // [direction] displacement of the far face
  for (std::size_t d = 0; d < D; ++d) {
    std::array<double, D> e{};
    e[d] = 1.0;
    for (std::size_t k = 0; k < D; ++k) period[d][k] = map(e)[k] - map({})[k];
  }
  const auto window = [&](Block<D>& block, int d, int side, Window<D> w) {
    w.direction = d;
    w.side = side;
    w.lower = {};
    w.upper = block.extent.n;
    block.windows.push_back(w);
  };
  for (int d = 0; d < D; ++d)
    for (int side = 0; side < 2; ++side) {
      Window<D> w = close(d, side);
      if (periodic[static_cast<std::size_t>(d)]) w.condition = Condition::periodic;
      window(s.whole, d, side, w);
    }
  const auto turns = all_turns<D>();
  std::mt19937 random(seed);
  for_each_index<D>({}, pieces, [&](const Index& piece) {
    Index first{}, cells{};
    for (std::size_t d = 0; d < D; ++d) {
      for (int k = 0; k < piece[d]; ++k) first[d] += cuts[d][static_cast<std::size_t>(k)];
      cells[d] = cuts[d][static_cast<std::size_t>(piece[d])];
    }
    Turn<D> turn;
    for (std::size_t d = 0; d < D; ++d) turn.direction[d] = static_cast<int>(d);
    if (seed != 0) turn = turns[random() % turns.size()];
    Index local;
    for (std::size_t d = 0; d < D; ++d) local[d] = cells[static_cast<std::size_t>(turn.direction[d])];
    Block<D> block = make_block<D>("part" + std::to_string(s.parts.size()), local, {}, [&](const Index& i) {
      Index global = first;
      for (std::size_t d = 0; d < D; ++d) {
        const auto o = static_cast<std::size_t>(turn.direction[d]);
        global[o] += turn.reversed[d] ? local[d] - i[d] : i[d];
      }
      return position(global);
    });
    for (std::size_t d = 0; d < D; ++d)
      for (int side = 0; side < 2; ++side) {
        const auto o = static_cast<std::size_t>(turn.direction[d]);
        const int side_there = turn.reversed[d] ? 1 - side : side;
        const bool outside = side_there == 0 ? piece[o] == 0 : piece[o] == pieces[o] - 1;
        Window<D> w = close(static_cast<int>(o), side_there);
        if (!outside || periodic[o]) {
          w.condition = Condition::join;
          w.request.kind = JoinRequest<D>::Kind::required;
          if (outside) {
            std::array<double, D> offset = period[o];
            if (side_there == 0)
              for (double& x : offset) x = -x;
            w.request.offsets.push_back(offset);
          }
        }
        window(block, static_cast<int>(d), side, w);
      }
    s.parts.push_back(std::move(block));
    s.first.push_back(first);
    s.cells.push_back(cells);
    s.turn.push_back(turn);
  });
  find_joins(s.parts);
  return s;
}

/// Skewed, stretched and wavy.
template <int D>
std::array<double, D> skewed(const std::array<double, D>& xi) {
  std::array<double, D> x = xi;
  double wave = 0.03;
  for (std::size_t d = 0; d < D; ++d) wave *= std::sin(2.0 * M_PI * xi[d]);
  for (std::size_t d = 0; d < D; ++d) x[d] += 0.1 * xi[d] * xi[d] + wave * (d == 0 ? 1.0 : -0.7);
  x[0] += 0.4 * xi[D - 1];
  return x;
}
/// Wavy, of period one.
template <int D>
std::array<double, D> wavy(const std::array<double, D>& xi) {
  std::array<double, D> x = xi;
  double wave = 0.04;
  for (std::size_t d = 0; d < D; ++d)
    wave *= std::sin(2.0 * M_PI * xi[d]) + 0.3 * std::cos(4.0 * M_PI * xi[d]);
  for (std::size_t d = 0; d < D; ++d) x[d] += wave * (d == 0 ? 1.0 : -0.7);
  x[0] += 0.25 * xi[D - 1];
  return x;
}

}  // namespace littoral::fv
