#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "boundary/join.hpp"

namespace littoral::fv {

/// What closes the equations on a part of a block's face.
///   wall       no slip: u = u_wall (which may slide), no mass flux, p extrapolated
///   slip       no mass flux, mirrored velocity, p extrapolated (also on curved walls)
///   symmetry   mirror image of everything
///   inflow     u given, p extrapolated
///   outflow    p given, u extrapolated
///   far_field  Riemann problem against a given state, with a wave speed of the order of the stream's
///   state      p and u given in both ghost layers, ordinary flux
///   periodic   the opposite face of the same block
///   fringe     nothing: only beside cells that are not solved (imposed or blanked)
///   convective p and u are carried out with a given speed; p also returns slowly to a given level
///   join       the cells of another block (or of another face of the same one) beyond the face
///   overset    nothing: the cells beside it take their values from an overlapping grid
enum class Condition : std::uint8_t {
  wall,
  slip,
  symmetry,
  inflow,
  outflow,
  far_field,
  state,
  periodic,
  fringe,
  join,
  overset,
  convective
};
const char* name(Condition condition);

/// A value given by the user at a point and time; x, y, z whatever the dimension.
using Prescribed = std::function<double(const std::array<double, 3>& x, double t)>;

/// One window: a range of cells along one face of a block, with its condition.
template <int D>
struct Window {
  std::string name;  // of the wall or opening, for forces and messages
  Condition condition = Condition::wall;
  int direction = 0;                   // of the face's normal
  int side = 0;                        // 0 lower, 1 upper
  std::array<int, D> lower{};          // first cell, tangential directions; entry [direction] is not used
  std::array<int, D> upper{};          // one past the last cell
  std::array<Prescribed, D> velocity;  // [m/s] empty: 0
  Prescribed pressure;                 // [Pa] absolute; empty: of water at rest under `surface`
  Prescribed surface;                  // < 0 in water: phi beyond inflow, far_field, state, and the level
                                       // of a pressure not given; empty: phi extrapolated, p the reference
  double wave_speed = 0.0;             // [m/s] far_field; 0: |u| of the given state, at least c0/10.
                                       // convective: of what leaves; 0: c0
  Join<D> join;                        // condition join only: the other side
  JoinRequest<D> request;              // of a window whose block may meet another one; see find_joins

  /// Given values at the time last set by evaluate_windows, over the window grown into the ghosts of lower
  /// directions, per layer (0: at the face, or the first ghost layer for `state`; 1: second ghost layer).
  std::array<std::vector<double>, 2> given_p;                 // [Pa] relative to the hydrostatic reference
  std::array<std::array<std::vector<double>, D>, 2> given_u;  // [m/s]
  std::array<std::vector<double>, 2> given_phi;               // [m] always in the ghosts' centres

  /// convective: what the first ghosts keep of the steps before, -(a1 q^n + a2 q^n-1), and a0, set by
  /// carry_windows; a0 = 0: no step yet, the ghosts stay as they are.
  std::vector<double> carried_p;                 // [Pa/s] relative to the hydrostatic reference
  std::array<std::vector<double>, D> carried_u;  // [m/s^2]
  double carried_a0 = 0.0;                       // [1/s]
  double carried_speed = 0.0;                    // [m/s]
  double outlet_length = 0.0;                    // [m] to the opposite side of the uncut block; 0: look
};

}  // namespace littoral::fv
