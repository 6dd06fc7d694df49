#pragma once

#include <string>
#include <vector>

#include "grid/match_faces.hpp"

namespace littoral::fv {

/// Cuts a window whose faces may be joined into rectangles of one join each, lower indices first; what is not
/// met keeps its condition. cells: those of the window in `faces`
template <int D>
std::vector<Window<D>> cut_window(const Window<D>& window, const std::vector<FaceCell<D>>& faces,
                                  const std::vector<std::size_t>& cells);

/// A join is told once, by the lower of its blocks (faces).
template <int D>
bool told_here(std::size_t block, const Window<D>& window);

/// One line: who joins whom, with which faces, which way round.
template <int D>
std::string describe_join(const std::vector<Block<D>>& blocks, std::size_t block, const Window<D>& window);

/// What is wrong with a window that meets nobody though it must: block, face, cell, place.
template <int D>
std::string complain_unmet(const std::vector<Block<D>>& blocks, std::size_t block, const Window<D>& window);

}  // namespace littoral::fv
