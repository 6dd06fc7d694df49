#pragma once

#include <string>
#include <vector>

#include "config.hpp"
#include "dual_time/stepper.hpp"
#include "overset/assembly.hpp"
#include "parallel/ranks.hpp"

namespace littoral::fv {

template <int D>
struct Grid {
  std::vector<Block<D>> blocks;
  std::vector<std::string> notes;  // for the log: files' dialects, joins found, quality of the blocks
  OversetAssembly<D> overset;      // empty where no face is an overset one
};

/// The blocks of a configuration with their windows, joined and laid over one another. throws ConfigError
/// with the problems of all blocks
template <int D>
Grid<D> build_grid(const FvConfig& config, const support::Scene& scene);

/// The discrete problem of a configuration: blocks, fluid, wave speeds, inner solver, sources, initial state.
/// notes: gets what the user should know of the grid; may be null. On several ranks each gets its blocks, cut
/// from the whole where need be; during this call every rank holds the grid's geometry as a whole.
/// throws ConfigError
template <int D>
Stepper<D> make_stepper(const FvConfig& config, const support::Scene& scene,
                        std::vector<std::string>* notes = nullptr, const Ranks& ranks = {});

}  // namespace littoral::fv
