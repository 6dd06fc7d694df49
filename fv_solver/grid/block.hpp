#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace littoral::fv {

/// Layers of ghost cells around a block: third-order reconstruction needs two.
inline constexpr int k_ghost = 2;

/// What a cell is to the equations: solved; ignored; value imposed (by another block or the partner); solved
/// with the forcing of (21)-(23).
enum class CellStatus : std::uint8_t { computed = 0, blanked = 1, fringe = 2, forced = 3 };

/// Index space of one structured block with ghosts: one contiguous array per field, direction 0 fastest.
/// In 2-D the directions and components are those of the plane (x, z); a third direction does not exist at
/// all.
template <int D>
struct Extent {
  std::array<int, D> n{};                  // cells without ghosts
  std::array<std::ptrdiff_t, D> stride{};  // of a cell array with ghosts
  std::ptrdiff_t origin = 0;               // offset of cell (0, ..., 0)
  std::size_t size = 0;                    // cells with ghosts

  explicit Extent(const std::array<int, D>& cells = {}) : n(cells) {
    std::ptrdiff_t s = 1;
    for (std::size_t d = 0; d < D; ++d) {
      stride[d] = s;
      origin += k_ghost * s;
      s *= n[d] + 2 * k_ghost;
    }
    size = static_cast<std::size_t>(s);
  }
  /// offset of cell (i, j, ...), each in [-k_ghost, n + k_ghost)
  std::ptrdiff_t at(const std::array<int, D>& index) const {
    std::ptrdiff_t offset = origin;
    for (std::size_t d = 0; d < D; ++d) offset += index[d] * stride[d];
    return offset;
  }
};

using Field = std::vector<double>;

/// Geometry of one curvilinear block. Face f of direction d at offset c is the lower face of cell c (between
/// c - stride[d] and c), so face arrays have the layout of cell arrays.
template <int D>
struct Block {
  Extent<D> extent;
  std::array<Field, D> node;    // [m] corner coordinates; node c is the lower corner of cell c, so the arrays
                                //     have the cell layout with one layer more: see metrics
  std::array<Field, D> centre;  // [m] cell centres, ghosts included
  Field volume;                 // [m^D] ghosts included (mirrored or periodic)
  std::array<std::array<Field, D>, D>
      area;  // [direction][component] [m^(D-1)] area vector of the lower face, along +direction
  std::vector<CellStatus> status;  // ghosts: fringe
};

/// Unknowns of one block: pressure and velocity at the cell centres, ghosts included.
template <int D>
struct State {
  Field p;                 // [Pa]
  std::array<Field, D> u;  // [m/s]
  void resize(std::size_t n) {
    p.assign(n, 0.0);
    for (auto& component : u) component.assign(n, 0.0);
  }
};

}  // namespace littoral::fv
