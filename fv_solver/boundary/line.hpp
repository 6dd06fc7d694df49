#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "grid/block.hpp"

namespace littoral::fv {

/// Offsets along one line normal to a boundary face: what the ghost and flux formulas of a window need.
template <int D>
struct Line {
  std::array<std::size_t, 3>
      inner;  // first, second, third inner cell (the last one repeats if there are fewer)
  std::array<std::size_t, 2> ghost;     // first, second ghost cell
  std::array<std::size_t, 2> opposite;  // cells whose periodic images the ghosts are
  std::size_t face;                     // offset whose lower face is the boundary face

  Line(const Block<D>& block, const Window<D>& w, std::ptrdiff_t first) {
    const auto d = static_cast<std::size_t>(w.direction);
    const std::ptrdiff_t s = block.extent.stride[d] * (w.side == 0 ? 1 : -1);
    const int n = block.extent.n[d];
    for (int k = 0; k < 3; ++k)
      inner[static_cast<std::size_t>(k)] = static_cast<std::size_t>(first + std::min(k, n - 1) * s);
    for (int k = 0; k < 2; ++k) {
      ghost[static_cast<std::size_t>(k)] = static_cast<std::size_t>(first - (k + 1) * s);
      // a layer further out than the block is long wraps around it
      opposite[static_cast<std::size_t>(k)] = static_cast<std::size_t>(first + (n - 1 - k % n) * s);
    }
    face = static_cast<std::size_t>(w.side == 0 ? first : first - s);
  }
  bool single() const { return inner[0] == inner[1]; }
};

/// Unit normal of the boundary face, into the block, and the distances of the first two inner centres along
/// it (the ghosts are mirrored, so the face lies halfway to the first ghost).
template <int D>
struct FaceFrame {
  std::array<double, D> normal;
  double measure = 0.0;       // [m^(D-1)]
  double d0 = 0.0, d1 = 0.0;  // [m]

  FaceFrame(const Block<D>& block, const Window<D>& w, const Line<D>& line) {
    for (std::size_t k = 0; k < D; ++k) {
      normal[k] = block.area[static_cast<std::size_t>(w.direction)][k][line.face];
      measure += normal[k] * normal[k];
    }
    measure = std::sqrt(measure);
    for (std::size_t k = 0; k < D; ++k) {
      normal[k] *= (w.side == 0 ? 1.0 : -1.0) / measure;
      const auto& x = block.centre[k];
      const double on_face = 0.5 * (x[line.inner[0]] + x[line.ghost[0]]);
      d0 += normal[k] * (x[line.inner[0]] - on_face);
      d1 += normal[k] * (x[line.inner[1]] - on_face);
    }
  }
  /// Pressure gradient outward from two cells [Pa/m]; 0 where there is only one.
  double outward_slope(double p0, double p1) const { return d1 > d0 ? (p0 - p1) / (d1 - d0) : 0.0; }
};

}  // namespace littoral::fv
