#pragma once

#include <cstdint>

namespace littoral::fv {

/// A pressure near the surface from that on the surface and in one water cell of the same grid line.
struct LineWeights {
  double own = 0.0;      // of the water cell beside the surface
  double behind = 0.0;   // of the next one, away from the surface
  double surface = 1.0;  // of the surface; the three have sum 1
};

/// From which water cell a pressure at the surface follows.
enum class LineStencil : std::uint8_t { own, behind, surface };

/// The cell beside the surface where the surface lies beyond `reach` (the face's place); else the cell
/// behind, so that the distance in the denominator is never small and nothing has to be clipped; in a film of
/// one cell neither: there the surface's pressure is the face's. pure
inline LineStencil line_stencil(double theta, bool has_behind, double reach) {
  if (theta >= reach) return LineStencil::own;
  return has_behind ? LineStencil::behind : LineStencil::surface;
}

/// Linear through the surface and a water cell (F13). Lengths from the water cell beside the surface towards
/// the air cell, in units of the distance between the two: the surface at theta in [0, 1], the place asked
/// for at `at`, the cell behind at -behind. pure
inline LineWeights line_weights(LineStencil stencil, double theta, double behind, double at) {
  if (stencil == LineStencil::surface) return {};
  if (stencil == LineStencil::own) {
    const double s = at / theta;
    return {1.0 - s, 0.0, s};
  }
  const double s = (at + behind) / (theta + behind);
  return {0.0, 1.0 - s, s};
}

/// Where phi changes sign between a water cell and an air cell, from the first towards the second; in [0, 1]
/// also while an inner iteration holds cells for water (air) whose phi has just become positive (negative).
/// pure
inline double crossing(double phi_water, double phi_air) {
  if (phi_water >= 0.0) return 0.0;
  if (phi_air <= 0.0) return 1.0;
  return phi_water / (phi_water - phi_air);
}

}  // namespace littoral::fv
