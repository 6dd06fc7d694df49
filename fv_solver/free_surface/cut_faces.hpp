#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "free_surface/line_stencil.hpp"
#include "grid/block.hpp"
#include "physics/flux_rows.hpp"

namespace littoral::fv {

/// Faces of one block whose stencils the surface cuts, row by row as the residual visits them, with their
/// fluxes along +direction. Everywhere else the ordinary fluxes hold, so that a scene pays for its surface
/// only, and one without a surface for nothing.
///
/// Between water and air (F13): p_f from the surface and one water cell of the line (line_stencil.hpp), so
/// that p is the surface's exactly at phi = 0 and water at rest has no force on any grid; the volume flux of
/// the velocity reconstructed from the water's side, without the term (p_L - p_R)/c of other faces; momentum
/// carried with that same velocity in both directions; free shear: of the stress's force only the part along
/// the surface's normal.
/// Between two water cells with air beside one of them: the ordinary flux, the air cell's pressure continued
/// through the surface along the line.
template <int D>
class CutFaces {
 public:
  /// Lists the faces of a block for one mask.
  void find(const Block<D>& block, const WetMask& wet);

  /// in   p relative to the hydrostatic reference, q.u continued into two layers of air, phi; ghosts current
  /// settled: the stencils stay those of the call before: a surface at the place where they are switched must
  /// not keep an inner iteration from converging
  /// comm local; OpenMP inside
  void compute(const Block<D>& block, const Fluid<D>& fluid, const FluxConstants<D>& constants, bool limited,
               const Field& phi, const WetMask& wet, bool settled, const double* p, const State<D>& q);

  /// Puts the fluxes of a row of `n` faces of `direction`, the first at `index`, in place of the ordinary
  /// ones. after_friction: only those between water and air, whose stress they hold already.
  void put(std::size_t direction, const std::array<int, D>& index, std::ptrdiff_t n, const FluxRow<D>& row,
           bool after_friction) const;

 private:
  struct Faces {
    std::vector<std::ptrdiff_t> cell;                 // offset of the cell whose lower face it is
    std::vector<int> place;                           // index along direction 0
    std::vector<std::uint8_t> free;                   // between water and air
    std::vector<std::uint32_t> row_begin;             // [row], and one past the last
    std::vector<std::array<LineStencil, 2>> stencil;  // towards air below and above
    Field mass;                                       // [kg/s]
    VectorField<D> momentum;                          // [N]
  };
  std::size_t row(std::size_t direction, const std::array<int, D>& index) const;

  std::array<int, D> n_{};
  std::array<Faces, D> faces_;
};

/// The free surface as it cuts one block.
template <int D>
struct BlockSurface {
  const Field& phi;    // [m] ghosts current
  const WetMask& wet;  // by which the faces were found
  bool settled;        // see CutFaces::compute
  CutFaces<D>& faces;
};

/// Normal of the surface at a cell, out of the water: central differences of phi. pure
template <int D>
std::array<double, D> surface_normal(const Block<D>& block, const Field& phi, std::ptrdiff_t c);

/// No water across any face of cell c. pure
template <int D>
bool air_all_around(const Block<D>& block, const WetMask& wet, std::ptrdiff_t c) {
  for (const std::ptrdiff_t s : block.extent.stride)
    if (wet[static_cast<std::size_t>(c - s)] != 0 || wet[static_cast<std::size_t>(c + s)] != 0) return false;
  return true;
}

}  // namespace littoral::fv
