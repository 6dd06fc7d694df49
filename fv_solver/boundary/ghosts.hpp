#pragma once

#include "grid/block.hpp"
#include "physics/equations.hpp"

namespace littoral::fv {

/// Evaluates the given values of all windows at time t. Call once a step, before fill_ghosts.
template <int D>
void evaluate_windows(Block<D>& block, const Equations<D>& equations, double t);

/// Takes from the last two time levels what convective windows carry out in the step of `scheme`. Call once a
/// step, with evaluate_windows.
template <int D>
void carry_windows(Block<D>& block, const Equations<D>& equations, const BackwardDifference& scheme,
                   const State<D>& now, const State<D>& before);

/// Keeps in convective windows how long the water before them is, the mean over their faces: a block that is
/// cut later does not change it.
template <int D>
void set_outlet_lengths(Block<D>& block);

/// Sets p and u in all ghost cells, edges and corners included, from the inner cells and the windows' given
/// values: directions in turn, each over the ghosts of those before. Ghosts behind `fringe` and `join`
/// windows are left alone (boundary/exchange.hpp). Pressures are treated relative to the hydrostatic
/// reference. comm local
template <int D>
void fill_ghosts(const Block<D>& block, State<D>& q);

/// throws ConfigError where the windows of a face do not cover it exactly once
template <int D>
void check_windows(const Block<D>& block);

/// The window's index box grown into the ghosts of lower directions where it touches the block's edge; entry
/// [direction] is the first inner cell's index.
template <int D>
void grown_box(const Block<D>& block, const Window<D>& window, std::array<int, D>& lower,
               std::array<int, D>& upper);

}  // namespace littoral::fv
