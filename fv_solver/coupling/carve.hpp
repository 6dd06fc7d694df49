#pragma once

#include <string>
#include <vector>

#include "boundary/exchange.hpp"
#include "grid/block.hpp"
#include "littoral/support/scene.hpp"

namespace littoral::fv {

/// What carving found.
struct Carving {
  long n_fringe = 0, n_blanked = 0, n_forced = 0;  // [cells]
  /// For the log: where a nominal face of the region does not lie on the cells' faces, and by how much.
  std::vector<std::string> notes;
  double column_depth = 0.0;  // [m] H of the column the gravest acoustic mode 4H/c lives in: the water along
                              // gravity, from the ground to the surface; 0 without gravity
};

/// Gives the cells inside the SPH region their roles. A cell is inside where its centre is within a nominal
/// box of the scene. Coupling I (imposed): the first `fringe_layers` layers next to computed cells, diagonals
/// included and across joins, are fringe, deeper ones blanked. Coupling II (forced): all are forced.
/// in/out block.status, block.solved of this rank's blocks. comm collective
/// throws ConfigError: a region that holds no cell, or fewer fringe layers beside an open face than asked for
template <int D>
Carving carve(std::vector<Block<D>>& blocks, const Exchange<D>& exchange, const support::Scene& scene);
/// All blocks are here.
template <int D>
Carving carve(std::vector<Block<D>>& blocks, const support::Scene& scene) {
  return carve<D>(blocks, Exchange<D>(blocks), scene);
}

}  // namespace littoral::fv
