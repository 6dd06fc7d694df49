#pragma once

#include "grid/block.hpp"

namespace littoral::fv {

/// How the ghosts of a scalar field are set behind windows.
///   level_set  the signed distance phi: extrapolated linearly behind walls, slip, outflow, convective and
///              overset faces (mirrored at a wall, it would force the surface upright there, and water at
///              rest would move), mirrored behind symmetry, given behind inflow, far_field and state
///              (`surface` of the window), left alone behind fringe
///   cell_data  only what stands for a cell: periodic faces and joins; all other ghosts are left alone
enum class ScalarGhosts : std::uint8_t { level_set, cell_data };

/// F/|grad F| of a function with the right zero level: its distance near there [m]. size: of a cell, of which
/// a part is differenced over [m]. pure
template <int D>
double distance_to(const Prescribed& surface, const std::array<double, 3>& x, double t, double size);

/// Evaluates the windows' given phi at time t, from any function with the right zero level. Call once a step,
/// in scenes with a surface. Windows without a function extrapolate.
template <int D>
void evaluate_surface_windows(Block<D>& block, double t);

/// Marks a block's ghosts that stand for cells: 1 behind joins and periodic faces; 0 elsewhere.
using ConnectedGhosts = std::vector<std::uint8_t>;

/// Sets the ghosts of one block, edges and corners included, directions in turn; not those behind joins, of
/// which the ones beyond faces are read. comm local
template <int D>
void fill_scalar_ghosts(const Block<D>& block, const ConnectedGhosts& connected, ScalarGhosts rule,
                        Field& field);

}  // namespace littoral::fv
