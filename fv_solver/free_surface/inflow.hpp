#pragma once

#include <vector>

#include "physics/equations.hpp"

namespace littoral::fv {

/// Water that comes in through the openings of these blocks [m^D/s], those of phi's part of each face: the
/// given flux of inflow, outflow and far_field, elsewhere the central one. Faces of fringe cells have
/// FringeFaces; overlapping ones are not counted.
/// dt: of the step, for the wave speed in the flux. pre windows evaluated, ghosts of q and phi current
/// comm local
template <int D>
double inflow_through_openings(const std::vector<Block<D>>& blocks, const Equations<D>& equations, double dt,
                               const std::vector<Field>& phi, const std::vector<State<D>>& q);

/// The volume of the water, and what of its change is no flow.
struct VolumeBudget {
  double volume = 0.0;        // [m^D] now
  double inflow = 0.0;        // [m^D/s] now, through openings
  double error = 0.0;         // [m^D] gained since the start beside what came in (trapezoidal rule)
  double from_partner = 0.0;  // [m^D/s] now, from fringe cells

  /// Of the water there is; 0 where there is none.
  double relative_error() const { return volume > 0.0 ? error / volume : 0.0; }
  /// A step has ended with this volume and these inflows.
  void add(const VolumeBudget& now, double dt) {
    error += now.volume - volume - 0.5 * dt * (inflow + now.inflow + from_partner + now.from_partner);
    volume = now.volume;
    inflow = now.inflow;
    from_partner = now.from_partner;
  }
};

}  // namespace littoral::fv
