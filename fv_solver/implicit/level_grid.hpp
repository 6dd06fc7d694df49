#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "grid/block.hpp"

namespace littoral::fv {

/// What closes the correction at a boundary face of a block.
///   link       the ghost cell holds a value from elsewhere: a periodic image or another block
///   wall       no flow, no slip: only pressure acts on the face, and friction
///   slip       no flow (slip wall, symmetry): only pressure acts
///   inflow     u is known on the face
///   outflow    p is known on the face
///   far_field  Riemann problem against a known state with a speed of its own
///   imposed    everything is known one cell beyond the face
enum class EdgeCondition : std::uint8_t { link, wall, slip, inflow, outflow, far_field, imposed };

/// Geometry of one block on one level of the multigrid hierarchy, with all a correction has to know of it.
/// Arrays have the layout of cell arrays (Extent); only the first ghost layer is used.
template <int D>
struct LevelGrid {
  Extent<D> extent;
  Field volume;                              // [m^D]
  std::array<std::array<Field, D>, D> area;  // [direction][component] lower face of the cell [m^(D-1)]
  std::vector<CellStatus> status;            // interior cells
  Field forcing;                             // K/delta of (21), 0 where not forced [1/s]; may be empty
  Field phi;                                 // [m] level set, < 0 in water; empty without a free surface
  std::vector<std::uint8_t> beside_air;      // 1: water with air beyond a face, 2: beyond all; empty likewise
  std::array<bool, D> periodic{};            // both sides of this direction are each other's image
  std::array<std::array<std::vector<EdgeCondition>, 2>, D> edge;  // [direction][lower, upper] per face cell
  double far_speed = 0.0;                                         // [m/s] of far fields; 0: the local |u|
  std::array<double, D> imposed_distance = ones();  // of imposed values beyond a face, in half cells

  explicit LevelGrid(const std::array<int, D>& cells = unit());
  /// Cells of a boundary face of direction d, the lowest remaining direction fastest.
  std::size_t face_cells(int d) const;
  std::size_t face_index(int d, const std::array<int, D>& index) const;
  bool solved(std::ptrdiff_t c) const {
    const CellStatus s = status[static_cast<std::size_t>(c)];
    return (s == CellStatus::computed || s == CellStatus::forced) && wet(c);
  }
  bool wet(std::ptrdiff_t c) const { return phi.empty() || phi[static_cast<std::size_t>(c)] < 0.0; }
  void set_edges(int d, int side, EdgeCondition condition);

 private:
  static std::array<double, D> ones() {
    std::array<double, D> x;
    x.fill(1.0);
    return x;
  }
  static std::array<int, D> unit() {
    std::array<int, D> n;
    n.fill(1);
    return n;
  }
};

/// Calls f(index, offset) for every interior cell, direction 0 fastest.
template <int D, class F>
void for_each_cell(const Extent<D>& extent, F&& f) {
  std::array<int, D> index{};
  for (;;) {
    std::ptrdiff_t c = extent.at(index);
    for (index[0] = 0; index[0] < extent.n[0]; ++index[0], ++c) f(index, c);
    index[0] = 0;
    std::size_t d = 1;
    while (d < D && ++index[d] == extent.n[d]) index[d++] = 0;
    if (d >= D) return;
  }
}

/// Which directions the next level halves: those with at least four cells (an odd last cell stays alone),
/// periodic ones only while the count is even. All 1: nothing left to coarsen.
template <int D>
std::array<int, D> coarsening_ratio(const std::array<int, D>& cells, const std::array<bool, D>& periodic);
template <int D>
std::array<int, D> coarsening_ratio(const LevelGrid<D>& fine) {
  return coarsening_ratio<D>(fine.extent.n, fine.periodic);
}

/// The next level: areas and volumes are sums over the children, so a closed cell stays closed. A coarse cell
/// is solved where at least half of its volume is.
template <int D>
LevelGrid<D> coarsen(const LevelGrid<D>& fine, const std::array<int, D>& ratio);

/// Sets beside_air from phi, ghosts current.
template <int D>
void find_surface(LevelGrid<D>& grid);

/// phi of the next level: the mean over the children that are not blanked, weighted with volume; first ghosts
/// of periodic directions set.
template <int D>
void coarsen_phi(const LevelGrid<D>& fine, const std::array<int, D>& ratio, LevelGrid<D>& coarse);

/// Averages the state over the children that hold one.
template <int D>
void average_state(const LevelGrid<D>& fine, const std::array<int, D>& ratio, const State<D>& fine_state,
                   const LevelGrid<D>& coarse, State<D>& coarse_state);

/// Copies the first ghost layer of periodic directions from their images.
template <int D, class Real>
void fill_periodic(const LevelGrid<D>& grid, std::vector<Real>& values);

}  // namespace littoral::fv
