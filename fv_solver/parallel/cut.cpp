#include "parallel/cut.hpp"

#include <algorithm>

#include "boundary/links.hpp"
#include "grid/loops.hpp"
#include "grid/metrics.hpp"

namespace littoral::fv {
namespace {

template <int D>
using Index = std::array<int, D>;

/// The cells of `from` that a piece has, ghosts included, in the layout of `to`. first: of the piece
template <int D>
void copy_part(const Extent<D>& extent_from, const Field& from, const Index<D>& first,
               const Extent<D>& extent, Field& to) {
  to.resize(extent.size);
  for_each_place<D>(extent, extent_from, first, true,
                    [&](std::size_t here, std::size_t there) { to[here] = from[there]; });
}

template <int D>
class Cutter {
 public:
  Cutter(const std::vector<Block<D>>& whole, const std::vector<Piece<D>>& pieces)
      : whole_(whole), pieces_(pieces), of_(whole.size()) {
    for (std::size_t p = 0; p < pieces.size(); ++p) of_[pieces[p].whole].push_back(p);
  }

  Block<D> block(std::size_t p) const {
    const Piece<D>& piece = pieces_[p];
    const Block<D>& from = whole_[piece.whole];
    Block<D> block;
    block.name = from.name;
    block.first = piece.lower;
    block.face_names = from.face_names;
    Index<D> n, nodes;
    for (std::size_t d = 0; d < D; ++d) {
      n[d] = piece.upper[d] - piece.lower[d];
      nodes[d] = n[d] + 1;
      block.periodic[d] = from.periodic[d] && spans(piece, d);
    }
    block.extent = Extent<D>(n);
    block.node_extent = Extent<D>(nodes);
    const auto copy = [&](const Field& source, Field& target) {
      copy_part<D>(from.extent, source, piece.lower, block.extent, target);
    };
    for (std::size_t k = 0; k < D; ++k) {
      copy_part<D>(from.node_extent, from.node[k], piece.lower, block.node_extent, block.node[k]);
      copy(from.centre[k], block.centre[k]);
      for (std::size_t d = 0; d < D; ++d) copy(from.area[d][k], block.area[d][k]);
    }
    copy(from.volume, block.volume);
    copy(from.width, block.width);
    if (!from.counted.empty()) copy(from.counted, block.counted);
    block.status.assign(block.extent.size, CellStatus::fringe);
    for_each_place<D>(block.extent, from.extent, piece.lower, false,
                      [&](std::size_t here, std::size_t there) { block.status[here] = from.status[there]; });
    set_solved_mask(block);
    for (const Window<D>& w : from.windows) add_windows(piece, w, block);
    for (std::size_t d = 0; d < D; ++d)
      for (int side = 0; side < 2; ++side) add_cut(p, d, side, block);
    return block;
  }

  CellName<D> find(std::size_t whole, std::ptrdiff_t cell) const {
    const Index<D> index = whole_[whole].extent.index(cell);
    for (const std::size_t p : of_[whole]) {
      bool inside = true;
      Index<D> n, local;
      for (std::size_t d = 0; d < D; ++d) {
        inside = inside && index[d] >= pieces_[p].lower[d] && index[d] < pieces_[p].upper[d];
        n[d] = pieces_[p].upper[d] - pieces_[p].lower[d];
        local[d] = index[d] - pieces_[p].lower[d];
      }
      if (inside) return {p, Extent<D>(n).at(local)};
    }
    return {};
  }

 private:
  bool spans(const Piece<D>& piece, std::size_t d) const {
    return piece.lower[d] == 0 && piece.upper[d] == whole_[piece.whole].extent.n[d];
  }
  bool touches(const Piece<D>& piece, std::size_t d, int side) const {
    return side == 0 ? piece.lower[d] == 0 : piece.upper[d] == whole_[piece.whole].extent.n[d];
  }

  /// What is left of a window's range, [lower, upper) in the whole, on a piece; false: nothing.
  static bool clip(const Piece<D>& piece, std::size_t normal, Index<D>& lower, Index<D>& upper) {
    for (std::size_t d = 0; d < D; ++d) {
      if (d == normal) continue;
      lower[d] = std::max(lower[d], piece.lower[d]);
      upper[d] = std::min(upper[d], piece.upper[d]);
      if (upper[d] <= lower[d]) return false;
    }
    return true;
  }

  /// A window of the whole, as far as the piece has it; of a join as many as there are pieces behind it.
  void add_windows(const Piece<D>& piece, const Window<D>& w, Block<D>& block) const {
    const auto n = static_cast<std::size_t>(w.direction);
    if (!touches(piece, n, w.side)) return;
    if (w.condition == Condition::periodic && !spans(piece, n)) {
      const Block<D>& whole = whole_[piece.whole];
      Window<D> join = w;
      join.condition = Condition::join;
      join.join.block = piece.whole;
      join.join.direction = w.direction;
      join.join.side = 1 - w.side;
      join.join.lower = w.lower;
      join.join.upper = w.upper;
      for (std::size_t d = 0; d < D; ++d) join.join.axis[d] = static_cast<int>(d);
      Index<D> ghost{}, image{};
      ghost[n] = w.side == 0 ? -1 : whole.extent.n[n];
      image[n] = w.side == 0 ? whole.extent.n[n] - 1 : 0;
      for (std::size_t k = 0; k < D; ++k)
        join.join.offset[k] = whole.centre[k][static_cast<std::size_t>(whole.extent.at(ghost))] -
                              whole.centre[k][static_cast<std::size_t>(whole.extent.at(image))];
      add_joins(piece, join, block);
    } else if (w.condition == Condition::join) {
      add_joins(piece, w, block);
    } else {
      add_window(piece, w, w.lower, w.upper, block);
    }
  }

  /// range: in the whole
  Window<D>* add_window(const Piece<D>& piece, const Window<D>& w, Index<D> lower, Index<D> upper,
                        Block<D>& block) const {
    const auto n = static_cast<std::size_t>(w.direction);
    if (!clip(piece, n, lower, upper)) return nullptr;
    Window<D> part = w;
    for (std::size_t d = 0; d < D; ++d) {
      part.lower[d] = d == n ? 0 : lower[d] - piece.lower[d];
      part.upper[d] = d == n ? block.extent.n[d] : upper[d] - piece.lower[d];
    }
    block.windows.push_back(std::move(part));
    return &block.windows.back();
  }

  /// One window for each piece behind the join `w`, whose ranges are those of the wholes.
  void add_joins(const Piece<D>& piece, const Window<D>& w, Block<D>& block) const {
    const auto n = static_cast<std::size_t>(w.direction);
    const Join<D>& join = w.join;
    for (const std::size_t q : of_[join.block]) {
      const Piece<D>& other = pieces_[q];
      if (!touches(other, static_cast<std::size_t>(join.direction), join.side)) continue;
      Index<D> lower = w.lower, upper = w.upper, lower_there{}, upper_there{};
      bool meets = clip(piece, n, lower, upper);
      for (std::size_t d = 0; d < D && meets; ++d) {
        if (d == n) continue;
        const auto a = static_cast<std::size_t>(join.axis[d]);
        // the piece behind, as a range along d here
        const int from = join.reversed[d] ? w.lower[d] + join.upper[a] - other.upper[a]
                                          : w.lower[d] + other.lower[a] - join.lower[a];
        lower[d] = std::max(lower[d], from);
        upper[d] = std::min(upper[d], from + other.upper[a] - other.lower[a]);
        meets = lower[d] < upper[d];
        const int length = upper[d] - lower[d];
        lower_there[a] = join.reversed[d] ? join.upper[a] - (upper[d] - w.lower[d])
                                          : join.lower[a] + (lower[d] - w.lower[d]);
        lower_there[a] -= other.lower[a];
        upper_there[a] = lower_there[a] + length;
      }
      if (!meets) continue;
      Window<D>* part = add_window(piece, w, lower, upper, block);
      part->join.block = q;
      part->join.lower = lower_there;
      part->join.upper = upper_there;
    }
  }

  /// Joins across the cuts.
  void add_cut(std::size_t p, std::size_t d, int side, Block<D>& block) const {
    const Piece<D>& piece = pieces_[p];
    if (touches(piece, d, side)) return;
    Window<D> w;
    w.name = "cut";
    w.condition = Condition::join;
    w.direction = static_cast<int>(d);
    w.side = side;
    for (const std::size_t q : of_[piece.whole]) {
      const Piece<D>& other = pieces_[q];
      if (side == 0 ? other.upper[d] != piece.lower[d] : other.lower[d] != piece.upper[d]) continue;
      Index<D> lower = other.lower, upper = other.upper;
      if (!clip(piece, d, lower, upper)) continue;
      Window<D>* part = add_window(piece, w, lower, upper, block);
      part->join.block = q;
      part->join.direction = w.direction;
      part->join.side = 1 - side;
      for (std::size_t e = 0; e < D; ++e) {
        part->join.axis[e] = static_cast<int>(e);
        part->join.lower[e] = e == d ? 0 : lower[e] - other.lower[e];
        part->join.upper[e] = e == d ? 0 : upper[e] - other.lower[e];
      }
    }
  }

  const std::vector<Block<D>>& whole_;
  const std::vector<Piece<D>>& pieces_;
  std::vector<std::vector<std::size_t>> of_;  // pieces of each whole
};

}  // namespace

template <int D>
CutGrid<D> cut(const std::vector<Block<D>>& whole, const OversetLinks<D>& overset,
               const std::vector<Piece<D>>& pieces, const Ranks& ranks) {
  const Cutter<D> cutter(whole, pieces);
  const Layout<D> before = layout_of(whole);
  CutGrid<D> grid;
  Layout<D>& layout = grid.layout;
  layout.owners.ranks = ranks;
  layout.whole = before.whole;
  std::vector<std::size_t> count(static_cast<std::size_t>(ranks.size()), 0);
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    const Piece<D>& piece = pieces[p];
    grid.blocks.push_back(cutter.block(p));
    layout.shape.push_back({grid.blocks.back().extent, grid.blocks.back().periodic});
    layout.component.push_back(before.component[piece.whole]);
    layout.period.push_back(before.period[piece.whole]);
    layout.part.push_back({piece.whole, piece.lower});
    layout.owners.rank.push_back(piece.rank);
    layout.owners.number.push_back(count[static_cast<std::size_t>(piece.rank)]++);
  }
  layout.joins = join_sides(grid.blocks);
  for (auto receiver : overset.receivers) {
    const CellName<D> to = cutter.find(receiver.block, receiver.cell);
    receiver.block = to.block;
    receiver.cell = to.cell;
    for (std::size_t k = 0; k < OversetLinks<D>::k_corners; ++k) {
      const CellName<D> from = cutter.find(receiver.donor_block[k], receiver.donor[k]);
      receiver.donor_block[k] = static_cast<std::uint32_t>(from.block);
      receiver.donor[k] = from.cell;
    }
    grid.overset.receivers.push_back(receiver);
  }
  return grid;
}

template CutGrid<2> cut(const std::vector<Block<2>>&, const OversetLinks<2>&, const std::vector<Piece<2>>&,
                        const Ranks&);
template CutGrid<3> cut(const std::vector<Block<3>>&, const OversetLinks<3>&, const std::vector<Piece<3>>&,
                        const Ranks&);

}  // namespace littoral::fv
