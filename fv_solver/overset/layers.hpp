#pragma once

#include <vector>

#include "overset/ghost_sources.hpp"

namespace littoral::fv {

/// A number of layers for every cell of a set of blocks, first ghosts included: how many steps from a front,
/// diagonals included, through joins and periodic faces.
template <int D>
class Layers {
 public:
  static constexpr int k_none = -1;
  Layers(const std::vector<Block<D>>& blocks, const GhostSources<D>& sources);

  int at(std::size_t block, std::ptrdiff_t cell) const {
    return layer_[block][static_cast<std::size_t>(cell)];
  }
  void set(std::size_t block, std::ptrdiff_t cell, int layer) {
    layer_[block][static_cast<std::size_t>(cell)] = layer;
  }
  /// Spreads from the cells with layer 0 over those without one for which may(block, cell), up to `deepest`.
  template <class May>
  void spread(int deepest, May&& may);

 private:
  void refresh();

  const std::vector<Block<D>>& blocks_;
  const GhostSources<D>& sources_;
  std::vector<std::vector<int>> layer_;
};

}  // namespace littoral::fv

#include "grid/loops.hpp"

namespace littoral::fv {

template <int D>
Layers<D>::Layers(const std::vector<Block<D>>& blocks, const GhostSources<D>& sources)
    : blocks_(blocks), sources_(sources) {
  for (const auto& block : blocks) layer_.emplace_back(block.extent.size, k_none);
}

template <int D>
void Layers<D>::refresh() {
  for (std::size_t b = 0; b < blocks_.size(); ++b)
    for (const auto& [ghost, source] : sources_.of(b)) set(b, ghost, at(source.block, source.cell));
}

template <int D>
template <class May>
void Layers<D>::spread(int deepest, May&& may) {
  for (int depth = 1; depth <= deepest; ++depth) {
    refresh();
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      const Extent<D>& e = blocks_[b].extent;
      for_each_index<D>({}, e.n, [&](const std::array<int, D>& index) {
        const std::ptrdiff_t c = e.at(index);
        if (at(b, c) != k_none || !may(b, c)) return;
        std::array<int, D> lower, upper;
        for (std::size_t d = 0; d < D; ++d) lower[d] = index[d] - 1, upper[d] = index[d] + 2;
        bool beside = false;
        for_each_index<D>(lower, upper, [&](const std::array<int, D>& other) {
          beside = beside || at(b, e.at(other)) == depth - 1;
        });
        if (beside) set(b, c, depth);
      });
    }
  }
}

}  // namespace littoral::fv
