#pragma once

#include <vector>

#include "boundary/exchange.hpp"
#include "physics/equations.hpp"

namespace littoral::fv {

/// The faces between computed cells and cells on which the partner's state is imposed (fringe), also where
/// they lie on joins.
template <int D>
class FringeFaces {
 public:
  FringeFaces() = default;
  /// comm neighbours
  FringeFaces(const std::vector<Block<D>>& blocks, const Exchange<D>& exchange);

  /// Flux through all of them of this rank, out of the computed cells: central, fourth order along the grid
  /// line, which is what the mean of both reconstructions is; the Riemann problem's dissipation is left out.
  /// Where a free surface cuts the cells beside a face, the mean of their shares of water counts.
  /// in    states and phi (null: water everywhere), ghosts current; fluid: whose mass flows, null: the volume
  /// out   [kg/s] or [m^D/s] (in 2-D per metre of width)
  /// comm  neighbours
  double flux(const std::vector<Block<D>>& blocks, const Exchange<D>& exchange,
              const std::vector<State<D>>& states, const std::vector<Field>* phi,
              const Fluid<D>* fluid) const;

 private:
  struct Face {
    std::size_t block = 0, direction = 0;
    std::ptrdiff_t cell = 0;  // the computed one
    int step = 1;             // along the direction, into the fringe
  };
  std::vector<Face> faces_;
  bool any_ = false;  // on any rank
};

extern template class FringeFaces<2>;
extern template class FringeFaces<3>;

}  // namespace littoral::fv
