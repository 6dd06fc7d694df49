#pragma once

#include <vector>

#include "dual_time/stepper.hpp"

namespace littoral::fv {

/// The faces between computed and fringe cells, also where they lie on joins.
template <int D>
class InterfaceFlux {
 public:
  /// comm neighbours
  InterfaceFlux(const std::vector<Block<D>>& blocks, const Exchange<D>& exchange);

  /// Mass flux through all of them, of all ranks, into the SPH region: central, fourth order along the grid
  /// line, which is what the mean of both reconstructions is; the Riemann problem's dissipation is left out.
  /// Where a free surface cuts the cells beside a face, the mean of their shares of water counts.
  /// in    the stepper's state, ghosts current
  /// out   [kg/s] (per metre in 2-D)
  /// comm  collective
  double mass_flux(const Stepper<D>& stepper) const;

 private:
  struct Face {
    std::size_t block = 0, direction = 0;
    std::ptrdiff_t cell = 0;  // the computed one
    int step = 1;             // along the direction, into the fringe
  };
  Ranks ranks_;
  std::vector<Face> faces_;
};

extern template class InterfaceFlux<2>;
extern template class InterfaceFlux<3>;

}  // namespace littoral::fv
