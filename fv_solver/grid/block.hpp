#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "boundary/window.hpp"

namespace littoral::fv {

/// Layers of ghost cells around a block: third-order reconstruction needs two.
inline constexpr int k_ghost = 2;

/// What a cell is to the equations: solved; ignored; value imposed by the partner (or by nobody, in ghosts);
/// solved with the forcing of (21)-(23); value interpolated from an overlapping block (overset/).
enum class CellStatus : std::uint8_t { computed = 0, blanked = 1, fringe = 2, forced = 3, interpolated = 4 };

/// Index space of one structured block with ghosts: one contiguous array per field, direction 0 fastest.
/// In 2-D the directions and components are those of the plane (x, z); a third direction does not exist at
/// all.
template <int D>
struct Extent {
  std::array<int, D> n{};                  // cells (or nodes) without ghosts
  std::array<std::ptrdiff_t, D> stride{};  // of an array with ghosts
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
  /// the index whose offset this is
  std::array<int, D> index(std::ptrdiff_t offset) const {
    std::array<int, D> i{};
    for (std::size_t d = D; d-- > 0;) {
      i[d] = static_cast<int>(offset / stride[d]) - k_ghost;
      offset %= stride[d];
    }
    return i;
  }
  std::ptrdiff_t cells() const {
    std::ptrdiff_t c = 1;
    for (int m : n) c *= m;
    return c;
  }
};

using Field = std::vector<double>;
/// Cells that hold water: 1 or 0, ghosts included.
using WetMask = std::vector<std::uint8_t>;
template <int D>
using VectorField = std::array<Field, D>;

/// One curvilinear block: geometry, the role of each cell, and the conditions on its faces.
/// Face f of direction d at offset c is the lower face of cell c (between c - stride[d] and c), so face
/// arrays have the layout of cell arrays. Filled by set_metrics (grid/metrics.hpp) from the corner nodes.
template <int D>
struct Block {
  std::string name;
  std::array<int, D> first{};      // cell of the uncut block that is (0, ..., 0) here: for messages
  Extent<D> extent;                // of cells
  Extent<D> node_extent;           // of nodes: one more than cells in each direction
  std::array<bool, D> periodic{};  // the block closes on itself in this direction
  std::array<std::array<std::string, 2>, D>
      face_names;                      // for messages; empty: i_lower, i_upper, j_lower, ...
  VectorField<D> node;                 // [m] node (i, j, k) is the lower corner of cell (i, j, k); ghosts set
  VectorField<D> centre;               // [m] mean of the corners, ghosts included
  Field volume;                        // [m^D] ghosts included (mirrored or periodic)
  Field width;                         // [m] volume^(1/D)
  std::array<VectorField<D>, D> area;  // [direction][component] [m^(D-1)] lower face, along +direction
  Field reference_pressure;            // [Pa] hydrostatic P(x), ghosts included: see physics/fluid.hpp
  std::vector<CellStatus> status;      // ghosts: fringe
  Field solved;                        // 1 where the rows are solved (computed, forced), else 0; ghosts 0
  Field counted;                       // of overlapping grids: see counted_share; else empty
  std::vector<Window<D>> windows;      // cover every face once
};

/// Share of a cell's volume that integrals over the water count: 1 in solved cells; of overlapping grids the
/// part that no grid above it has (overset/assembly.hpp); 0 in cells of a partner. pure
template <int D>
double counted_share(const Block<D>& block, std::size_t c) {
  const CellStatus status = block.status[c];
  if (status == CellStatus::blanked || status == CellStatus::fringe) return 0.0;
  if (!block.counted.empty()) return block.counted[c];
  return status == CellStatus::interpolated ? 0.0 : 1.0;
}

/// "(i,j,k)" of a cell in the uncut block. pure
template <int D>
std::string cell_name(const Block<D>& block, const std::array<int, D>& index) {
  std::string text;
  for (std::size_t d = 0; d < D; ++d) text += (d > 0 ? "," : "(") + std::to_string(block.first[d] + index[d]);
  return text + ")";
}

/// What a face is called. pure
template <int D>
std::string face_name(const Block<D>& block, int direction, int side) {
  const auto d = static_cast<std::size_t>(direction);
  const std::string& given = block.face_names[d][static_cast<std::size_t>(side)];
  return given.empty() ? std::string(1, "ijk"[d]) + (side == 0 ? "_lower" : "_upper") : given;
}

/// Unknowns of one block: pressure and velocity at the cell centres, ghosts included.
template <int D>
struct State {
  Field p;           // [Pa]
  VectorField<D> u;  // [m/s]
  void resize(std::size_t n) {
    p.assign(n, 0.0);
    for (auto& component : u) component.assign(n, 0.0);
  }
};

/// Left-hand sides of (4) and (5) for each cell of a block, as forces and mass rates; ghosts 0.
template <int D>
struct Residual {
  Field mass;               // [kg/s]
  VectorField<D> momentum;  // [N]
  void resize(std::size_t n) {
    mass.assign(n, 0.0);
    for (auto& component : momentum) component.assign(n, 0.0);
  }
};

}  // namespace littoral::fv
