#include "parallel/deal.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "grid/loops.hpp"
#include "grid/metrics.hpp"
#include "littoral/error.hpp"

namespace littoral::fv {
namespace {

constexpr int k_least = 4;            // [cells] of a piece across a cut: below it, ghosts reach through
constexpr double k_tolerance = 0.05;  // of a load that is not worth a cut

int trailing_zeros(int i) {
  int n = 0;
  while (i % 2 == 0) {
    i /= 2;
    ++n;
  }
  return n;
}

struct Cut {
  std::size_t direction = 0;
  int at = 0;
  double cost = std::numeric_limits<double>::infinity();
};

/// The best cut that leaves about `wanted` cells below it; load: the cells that an error is measured by.
template <int D>
Cut best_cut(const Piece<D>& piece, const CutPlanes<D>& planes, double wanted, double load) {
  constexpr double k_error = 10.0, k_face = 0.5, k_level = 0.25;  // a percent of load is worth a tenth of ...
  constexpr int k_levels = 3;                                     // ... these halvings, or a fifth of a face
  const auto cells = static_cast<double>(piece.cells());
  Cut best;
  for (std::size_t d = 0; d < D; ++d) {
    const int length = piece.upper[d] - piece.lower[d];
    const double face = cells / length;
    const double relative_face = face / std::pow(cells, (D - 1.0) / D);
    for (int i = piece.lower[d] + k_least; i <= piece.upper[d] - k_least; ++i) {
      if (!planes.may[d][static_cast<std::size_t>(i)]) continue;
      const double error = std::abs(face * (i - piece.lower[d]) - wanted) / load;
      const int levels = trailing_zeros(i);
      const double cost = k_error * error + k_face * relative_face + k_level * std::max(0, k_levels - levels);
      if (cost < best.cost) best = {d, i, cost};
    }
  }
  return best;
}

template <int D>
bool before(const Piece<D>& a, const Piece<D>& b) {
  if (a.whole != b.whole) return a.whole < b.whole;
  for (std::size_t d = D; d-- > 0;)
    if (a.lower[d] != b.lower[d]) return a.lower[d] < b.lower[d];
  return false;
}

template <int D>
class Dealer {
 public:
  Dealer(const std::vector<CutPlanes<D>>& planes, int n_ranks) : planes_(planes) {
    std::vector<Piece<D>> all;
    for (std::size_t b = 0; b < planes.size(); ++b) all.push_back({b, {}, planes[b].cells, 0});
    give(std::move(all), 0, n_ranks);
    std::sort(dealt_.begin(), dealt_.end(), before<D>);
  }
  std::vector<Piece<D>> dealt() && { return std::move(dealt_); }

 private:
  void give(std::vector<Piece<D>> pieces, int first, int n_ranks) {
    if (n_ranks == 1) {
      for (Piece<D>& piece : pieces) {
        piece.rank = first;
        dealt_.push_back(piece);
      }
      return;
    }
    double total = 0.0;
    for (const Piece<D>& piece : pieces) total += static_cast<double>(piece.cells());
    const int lower_ranks = n_ranks / 2;
    std::array<double, 2> room = {total * lower_ranks / n_ranks, 0.0};
    room[1] = total - room[0];
    const double tolerance = k_tolerance * total / n_ranks;
    std::array<std::vector<Piece<D>>, 2> half;
    const auto smaller = [](const Piece<D>& a, const Piece<D>& b) {
      return a.cells() != b.cells() ? a.cells() < b.cells() : before<D>(b, a);
    };
    std::sort(pieces.begin(), pieces.end(), smaller);
    while (!pieces.empty()) {  // the largest first
      Piece<D> piece = pieces.back();
      pieces.pop_back();
      const std::size_t to = room[1] > room[0] ? 1 : 0;
      if (static_cast<double>(piece.cells()) > room[to] + tolerance) {
        const Cut cut = best_cut<D>(piece, planes_[piece.whole], room[to], total / n_ranks);
        if (std::isfinite(cut.cost)) {
          Piece<D> rest = piece;
          piece.upper[cut.direction] = rest.lower[cut.direction] = cut.at;
          pieces.insert(std::upper_bound(pieces.begin(), pieces.end(), rest, smaller), rest);
        }
      }
      room[to] -= static_cast<double>(piece.cells());
      half[to].push_back(piece);
    }
    give(std::move(half[0]), first, lower_ranks);
    give(std::move(half[1]), first + lower_ranks, n_ranks - lower_ranks);
  }

  const std::vector<CutPlanes<D>>& planes_;
  std::vector<Piece<D>> dealt_;
};

}  // namespace

template <int D>
std::vector<CutPlanes<D>> cut_planes(const std::vector<Block<D>>& blocks, bool layers) {
  constexpr double k_thin = 4.0;  // thinner than this part of the widest direction: a layer
  std::vector<CutPlanes<D>> all;
  for (const Block<D>& block : blocks) {
    CutPlanes<D> planes;
    planes.cells = block.extent.n;
    for (std::size_t d = 0; d < D; ++d)
      planes.may[d].assign(static_cast<std::size_t>(block.extent.n[d]) + 1, 1);
    std::array<bool, D> layered{};  // a wall lies across the direction
    for (const Window<D>& w : block.windows)
      if (w.condition == Condition::wall) layered[static_cast<std::size_t>(w.direction)] = !layers;
    if (layered != std::array<bool, D>{})
      for_each_index<D>({}, block.extent.n, [&](const std::array<int, D>& index) {
        const auto c = static_cast<std::size_t>(block.extent.at(index));
        std::array<double, D> h;
        for (std::size_t d = 0; d < D; ++d) h[d] = thickness<D>(block, d, c);
        const double widest = *std::max_element(h.begin(), h.end());
        for (std::size_t d = 0; d < D; ++d) {
          if (!layered[d] || k_thin * h[d] >= widest) continue;
          planes.may[d][static_cast<std::size_t>(index[d])] = 0;
          planes.may[d][static_cast<std::size_t>(index[d]) + 1] = 0;
        }
      });
    all.push_back(std::move(planes));
  }
  return all;
}

template <int D>
std::vector<Piece<D>> deal(const std::vector<CutPlanes<D>>& blocks, int n_ranks) {
  std::vector<Piece<D>> pieces = Dealer<D>(blocks, n_ranks).dealt();
  std::vector<bool> has(static_cast<std::size_t>(n_ranks), false);
  for (const Piece<D>& piece : pieces) has[static_cast<std::size_t>(piece.rank)] = true;
  const auto idle = std::count(has.begin(), has.end(), false);
  if (idle > 0)
    throw ConfigError("the grid cannot be cut into parts for " + std::to_string(n_ranks) +
                      " ranks: " + std::to_string(idle) + " of them would have no cells. Use " +
                      std::to_string(n_ranks - static_cast<int>(idle)) +
                      " ranks or less, or allow cuts through layers (ranks.cut_layers: true)");
  return pieces;
}

template std::vector<CutPlanes<2>> cut_planes(const std::vector<Block<2>>&, bool);
template std::vector<CutPlanes<3>> cut_planes(const std::vector<Block<3>>&, bool);
template std::vector<Piece<2>> deal(const std::vector<CutPlanes<2>>&, int);
template std::vector<Piece<3>> deal(const std::vector<CutPlanes<3>>&, int);

}  // namespace littoral::fv
