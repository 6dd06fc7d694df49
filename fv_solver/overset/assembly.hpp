#pragma once

#include <string>
#include <vector>

#include "overset/donors.hpp"

namespace littoral::fv {

/// What joins overlapping grids into one: who is blanked, who takes values from where.
template <int D>
struct OversetAssembly {
  OversetLinks<D> links;
  long n_interpolated = 0, n_blanked = 0;  // [cells]
  std::vector<std::string> notes;          // for the log, a line a component
};

struct OversetOptions {
  int fringe_layers = 2;  // of cells that take values: the reconstruction's reach
  int overlap =
      1;  // [cells] of the upper grid, at least, between its fringe and the hole's in the grid below
};

/// By how much the ghosts beyond the lower face of a block's periodic directions are shifted from the cells
/// they stand for; 0 in other directions.
template <int D>
std::vector<std::array<std::array<double, D>, D>> periods(const std::vector<Block<D>>& blocks);

/// What the first layer of ghosts stands for, on the finest level.
template <int D>
GhostSources<D> ghost_sources(const std::vector<Block<D>>& blocks);

/// Joins components (overset/components.hpp) that overlap. Later components lie over earlier ones:
///   - of a component, the first `fringe_layers` layers of cells at its `overset` windows are interpolated;
///   - a cell under the solved part of a later component, `overlap` cells from that one's fringe, or behind
///     a wall of any other component, belongs to a hole;
///   - of a hole the first `fringe_layers` layers beside solved cells are interpolated, the rest is blanked;
///   - donors are solved cells only.
/// in/out block.status, block.solved, block.counted. Grids without `overset` windows are left as they are.
/// throws ConfigError naming cells and places that find no donor: orphans
template <int D>
OversetAssembly<D> assemble_overset(std::vector<Block<D>>& blocks, const OversetOptions& options);

}  // namespace littoral::fv
