#include "overset/components.hpp"

#include <algorithm>

#include "boundary/links.hpp"

namespace littoral::fv {

template <int D>
std::vector<std::size_t> components(const std::vector<Block<D>>& blocks) {
  std::vector<std::size_t> lowest(blocks.size());  // block of each component
  for (std::size_t b = 0; b < lowest.size(); ++b) lowest[b] = b;
  const std::vector<JoinSide<D>> joins = join_sides(blocks);
  for (bool changed = true; changed;) {
    changed = false;
    for (const JoinSide<D>& side : joins) {
      const std::size_t low = std::min(lowest[side.block], lowest[side.there.block]);
      changed = changed || lowest[side.block] != low || lowest[side.there.block] != low;
      lowest[side.block] = lowest[side.there.block] = low;
    }
  }
  std::vector<std::size_t> of(blocks.size());
  std::size_t count = 0;
  for (std::size_t b = 0; b < blocks.size(); ++b) of[b] = lowest[b] == b ? count++ : of[lowest[b]];
  return of;
}

template std::vector<std::size_t> components<2>(const std::vector<Block<2>>&);
template std::vector<std::size_t> components<3>(const std::vector<Block<3>>&);

}  // namespace littoral::fv
