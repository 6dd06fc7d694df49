#pragma once

#include <vector>

#include "boundary/exchange.hpp"
#include "grid/block.hpp"

namespace littoral::fv {

/// Fewer cells than this are not worth a team of threads.
inline constexpr std::ptrdiff_t k_cells_for_threads = 1000;

/// Cells near the surface, in layers: layer 0 has a neighbour across a face on the other side of phi = 0,
/// layer k + 1 has one in layer k, on both sides of the surface, through joins and periodic faces. Found from
/// the signs of phi, never from |phi|, so it is right whatever the gradient of phi is. Blanked cells belong
/// to no layer; fringe and interpolated ones do. A sign that changes towards a ghost that stands for no cell
/// counts too: a film thinner than half a cell on a wall is part of the surface where it lies beside water or
/// goes on to the end of the grid. Elsewhere its end, a layer-0 cell, would be the surface of the cell
/// beyond, and the film would grow by a cell in every step: there it dries up.
template <int D>
class Band {
 public:
  static constexpr int k_none = 127;

  /// in phi with ghosts current; layers: how many (1: the cells at the surface alone)
  /// comm exchange of one field a layer, and one more
  void build(const std::vector<Block<D>>& blocks, const Exchange<D>& exchange, const std::vector<Field>& phi,
             int layers);

  int layers() const { return layers_; }
  /// Offsets of the cells of a block in layers [first, last), each layer in the order of the array.
  struct Cells {
    const std::ptrdiff_t* first;
    const std::ptrdiff_t* last;
    const std::ptrdiff_t* begin() const { return first; }
    const std::ptrdiff_t* end() const { return last; }
    std::ptrdiff_t size() const { return last - first; }
    std::ptrdiff_t operator[](std::ptrdiff_t i) const { return first[i]; }
  };
  Cells cells(std::size_t block, int first, int last) const {
    const auto& start = start_[block];
    const std::ptrdiff_t* base = cells_[block].data();
    return {base + start[static_cast<std::size_t>(first)], base + start[static_cast<std::size_t>(last)]};
  }
  Cells cells(std::size_t block) const { return cells(block, 0, layers_); }
  /// Layer of a cell, ghosts that stand for one (behind joins and periodic faces) included; k_none outside
  /// the band and in other ghosts.
  int layer(std::size_t block, std::ptrdiff_t cell) const {
    return static_cast<int>(layer_[block][static_cast<std::size_t>(cell)]);
  }
  /// Whether this is a cell, or a ghost that stands for one.
  bool stands_for_cell(std::size_t block, std::ptrdiff_t cell) const {
    return stands_[block][static_cast<std::size_t>(cell)] != 0.0;
  }

 private:
  int layers_ = 0;
  std::vector<Field> layer_;   // [block][cell]
  std::vector<Field> stands_;  // [block] 1 in cells that are not blanked and their images
  std::vector<std::vector<std::ptrdiff_t>> cells_;  // [block] sorted by layer
  std::vector<std::vector<std::ptrdiff_t>> start_;  // [block][layer], and one past the last
};

}  // namespace littoral::fv
