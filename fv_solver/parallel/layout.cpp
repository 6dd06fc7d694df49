#include "parallel/layout.hpp"

#include <numeric>

#include "boundary/links.hpp"
#include "grid/loops.hpp"
#include "overset/assembly.hpp"
#include "overset/components.hpp"

namespace littoral::fv {

Owners Owners::all_here(std::size_t n_blocks) {
  Owners owners;
  owners.rank.assign(n_blocks, 0);
  owners.number.resize(n_blocks);
  std::iota(owners.number.begin(), owners.number.end(), std::size_t{0});
  return owners;
}

std::vector<std::size_t> Owners::mine() const {
  std::vector<std::size_t> blocks;
  for (std::size_t b = 0; b < rank.size(); ++b)
    if (here(b)) blocks.push_back(b);
  return blocks;
}

template <int D>
Layout<D> layout_of(const std::vector<Block<D>>& blocks) {
  Layout<D> layout;
  layout.owners = Owners::all_here(blocks.size());
  layout.joins = join_sides(blocks);
  layout.component = components(blocks);
  layout.period = periods(blocks);
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const Block<D>& block = blocks[b];
    layout.shape.push_back({block.extent, block.periodic});
    layout.part.push_back({b, {}});
    double volume = 0.0;
    for_each_index<D>({}, block.extent.n, [&](const std::array<int, D>& index) {
      volume += block.volume[static_cast<std::size_t>(block.extent.at(index))];
    });
    layout.whole.push_back({block.name, block.extent.n, volume / static_cast<double>(block.extent.cells())});
  }
  return layout;
}

template Layout<2> layout_of(const std::vector<Block<2>>&);
template Layout<3> layout_of(const std::vector<Block<3>>&);

}  // namespace littoral::fv
