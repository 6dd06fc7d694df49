#include "boundary/links.hpp"

namespace littoral::fv {

template <int D>
JoinLinks<D>::JoinLinks(const std::vector<JoinSide<D>>& joins, const std::vector<Extent<D>>& extents,
                        int layers) {
  for (const JoinSide<D>& side : joins) {
    const Extent<D>& here = extents[side.block];
    const Extent<D>& there = extents[side.there.block];
    std::array<CellCopies, D> copies;
    for (auto& c : copies) {
      c.to_block = side.block;
      c.from_block = side.there.block;
    }
    for_each_ghost<D>(side, here.n, layers,
                      [&](const std::array<int, D>& index, int layer, std::size_t beyond) {
                        const std::array<int, D> other = side.image(index, layer, there.n);
                        // a block thinner than the ghosts are deep ends the copy at its own ghosts
                        for (std::size_t d = 0; d < D; ++d)
                          if (other[d] < -layers || other[d] >= there.n[d] + layers) return;
                        copies[beyond].to.push_back(here.at(index));
                        copies[beyond].from.push_back(there.at(other));
                      });
    for (std::size_t k = 0; k < D; ++k)
      if (!copies[k].to.empty()) copies_[k].push_back(std::move(copies[k]));
  }
}

template <int D>
std::vector<JoinSide<D>> join_sides(const std::vector<Block<D>>& blocks) {
  std::vector<JoinSide<D>> sides;
  for (std::size_t b = 0; b < blocks.size(); ++b)
    for (const Window<D>& w : blocks[b].windows)
      if (w.condition == Condition::join) sides.push_back({b, w.direction, w.side, w.lower, w.upper, w.join});
  return sides;
}

template class JoinLinks<2>;
template class JoinLinks<3>;
template std::vector<JoinSide<2>> join_sides(const std::vector<Block<2>>&);
template std::vector<JoinSide<3>> join_sides(const std::vector<Block<3>>&);

}  // namespace littoral::fv
