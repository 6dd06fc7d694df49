#include "implicit/level_joins.hpp"

namespace littoral::fv {
namespace {

/// Whether cells first..end-1 of n are whole coarse cells, an odd last one alone.
bool halves(int first, int end, int n, bool odd_end_allowed) {
  return first % 2 == 0 && (end % 2 == 0 || (odd_end_allowed && end == n));
}

template <int D>
bool may_halve(const JoinSide<D>& j, std::size_t d, const std::vector<BlockShape<D>>& shapes) {
  const auto a = static_cast<std::size_t>(j.there.axis[d]);
  // an odd cell stays alone at the upper end: on both sides in the same place only if both run the same way
  const bool same_end = !j.there.reversed[d] && j.there.upper[a] == shapes[j.there.block].extent.n[a] &&
                        j.upper[d] == shapes[j.block].extent.n[d];
  return halves(j.lower[d], j.upper[d], shapes[j.block].extent.n[d], same_end) &&
         halves(j.there.lower[a], j.there.upper[a], shapes[j.there.block].extent.n[a], same_end);
}

}  // namespace

template <int D>
std::vector<std::array<int, D>> joint_ratios(const std::vector<BlockShape<D>>& shapes,
                                             const std::vector<JoinSide<D>>& joins,
                                             const std::vector<std::array<bool, D>>& held) {
  std::vector<std::array<int, D>> ratios;
  for (std::size_t b = 0; b < shapes.size(); ++b) {
    ratios.push_back(coarsening_ratio<D>(shapes[b].extent.n, shapes[b].periodic));
    for (std::size_t d = 0; d < D; ++d)
      if (!held.empty() && held[b][d]) ratios.back()[d] = 1;
  }
  for (bool changed = true; changed;) {
    changed = false;
    for (const JoinSide<D>& j : joins)
      for (std::size_t d = 0; d < D; ++d) {
        if (static_cast<int>(d) == j.direction) continue;
        int& here = ratios[j.block][d];
        int& there = ratios[j.there.block][static_cast<std::size_t>(j.there.axis[d])];
        if (here == 1 && there == 1) continue;
        if (here == there && may_halve(j, d, shapes)) continue;
        here = there = 1;
        changed = true;
      }
  }
  return ratios;
}

template <int D>
std::vector<BlockShape<D>> coarse_shapes(const std::vector<BlockShape<D>>& shapes,
                                         const std::vector<std::array<int, D>>& ratios) {
  std::vector<BlockShape<D>> coarse = shapes;
  for (std::size_t b = 0; b < shapes.size(); ++b) {
    std::array<int, D> n = shapes[b].extent.n;
    for (std::size_t d = 0; d < D; ++d) n[d] = (n[d] + ratios[b][d] - 1) / ratios[b][d];
    coarse[b].extent = Extent<D>(n);
  }
  return coarse;
}

template <int D>
std::vector<JoinSide<D>> coarse_joins(const std::vector<JoinSide<D>>& joins,
                                      const std::vector<std::array<int, D>>& ratios) {
  std::vector<JoinSide<D>> coarse = joins;
  const auto shrink = [](std::array<int, D>& lower, std::array<int, D>& upper,
                         const std::array<int, D>& ratio) {
    for (std::size_t d = 0; d < D; ++d) {
      lower[d] /= ratio[d];
      upper[d] = (upper[d] + ratio[d] - 1) / ratio[d];
    }
  };
  for (JoinSide<D>& j : coarse) {
    shrink(j.lower, j.upper, ratios[j.block]);
    shrink(j.there.lower, j.there.upper, ratios[j.there.block]);
  }
  return coarse;
}

template std::vector<std::array<int, 2>> joint_ratios<2>(const std::vector<BlockShape<2>>&,
                                                         const std::vector<JoinSide<2>>&,
                                                         const std::vector<std::array<bool, 2>>&);
template std::vector<std::array<int, 3>> joint_ratios<3>(const std::vector<BlockShape<3>>&,
                                                         const std::vector<JoinSide<3>>&,
                                                         const std::vector<std::array<bool, 3>>&);
template std::vector<BlockShape<2>> coarse_shapes<2>(const std::vector<BlockShape<2>>&,
                                                     const std::vector<std::array<int, 2>>&);
template std::vector<BlockShape<3>> coarse_shapes<3>(const std::vector<BlockShape<3>>&,
                                                     const std::vector<std::array<int, 3>>&);
template std::vector<JoinSide<2>> coarse_joins<2>(const std::vector<JoinSide<2>>&,
                                                  const std::vector<std::array<int, 2>>&);
template std::vector<JoinSide<3>> coarse_joins<3>(const std::vector<JoinSide<3>>&,
                                                  const std::vector<std::array<int, 3>>&);

}  // namespace littoral::fv
