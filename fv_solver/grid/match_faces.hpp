#pragma once

#include <array>
#include <optional>
#include <vector>

#include "grid/block.hpp"

namespace littoral::fv {

/// Where a face cell's other side is: the cell there, and how the directions run.
template <int D>
struct FaceMatch {
  std::size_t face = 0;  // position in the list of all face cells
  std::array<int, D> axis{};
  std::array<bool, D> reversed{};
  std::array<double, D> offset{};
};

/// One cell of a window that may be joined.
template <int D>
struct FaceCell {
  std::size_t block = 0, window = 0;
  int direction = 0, side = 0;
  std::array<int, D> index{};  // of the inner cell
  std::array<double, D> centre{};
  double edge = 0.0;  // shortest one that is not collapsed
  std::optional<FaceMatch<D>> match;
};

/// The directions along a face, in order.
template <int D>
std::vector<int> tangential(int direction);

/// Corner nodes of a face; bit t of `corner` steps along the t-th tangential direction.
template <int D>
std::array<int, D> corner_index(const FaceCell<D>& f, unsigned corner);

/// The corner of g that lies on `corner` of f, which matches it.
template <int D>
unsigned corner_there(const FaceCell<D>& f, const FaceCell<D>& g, const FaceMatch<D>& match, unsigned corner);

/// The cells of all windows that ask for a join (Window::request), each with the face it meets, if it meets
/// one: corners fall on corners, to a small part of the faces' own edges, in whichever orientation.
/// Collapsed faces are left out.
template <int D>
std::vector<FaceCell<D>> match_faces(const std::vector<Block<D>>& blocks);

}  // namespace littoral::fv
