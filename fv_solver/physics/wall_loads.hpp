#pragma once

#include <string>
#include <vector>

#include "grid/block.hpp"
#include "littoral/coupler/types.hpp"
#include "parallel/ranks.hpp"
#include "physics/equations.hpp"

namespace littoral::fv {

/// A force and its moment (x, y, z whatever the dimension; 2-D: per metre of width).
struct Load {
  coupler::Vec3 force{};   // [N]
  coupler::Vec3 moment{};  // [N m]
};
Load operator+(const Load& a, const Load& b);

/// What the water does to the walls of one name, by cause.
struct WallLoads {
  Load pressure;     // beyond the hydrostatic reference
  Load viscous;      // the full stress on the face
  Load hydrostatic;  // of the reference pressure above p0
  /// Without buoyancy: what C_D and C_L of a submerged body are made of.
  Load dynamic() const { return pressure + viscous; }
  Load total() const { return dynamic() + hydrostatic; }
};

/// Sums over all walls (wall, slip, symmetry) with this name, of all ranks; moments about `about` [m].
/// phi: level set of each block where the water has a surface: a face that it cuts bears the load of its wet
/// part alone, at that part's centre; air bears none
/// pre: ghosts of q and phi current. comm collective, as wall_units
template <int D>
WallLoads wall_loads(const std::vector<Block<D>>& blocks, const Equations<D>& equations,
                     const std::vector<State<D>>& q, const std::string& wall, const coupler::Vec3& about,
                     const Ranks& ranks = {}, const std::vector<Field>* phi = nullptr);

/// Distance of the first cell centres from no-slip walls in wall units, y+ = d sqrt(|tau|/rho0)/nu (F11).
struct WallUnits {
  double largest = 0.0, mean = 0.0;  // [-] mean weighted with the faces' measure
};
/// Over all no-slip walls with this name; without friction 0. pre: ghosts of q current
template <int D>
WallUnits wall_units(const std::vector<Block<D>>& blocks, const Equations<D>& equations,
                     const std::vector<State<D>>& q, const std::string& wall, const Ranks& ranks = {});

}  // namespace littoral::fv
