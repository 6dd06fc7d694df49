#pragma once

#include <string>
#include <vector>

#include "config.hpp"

namespace littoral::fv {

/// Position of node i of n cells along [0, 1].
double stretched(const Spacing& spacing, int i, int n);

/// The spacing with its ratio or strength such that the narrowest of n cells over `length` has the width
/// asked for (first_cell); unchanged where none is. where: for the message throws ConfigError where no
/// stretching gives that width
Spacing fitted(const Spacing& spacing, int n, double length, const std::string& where);

/// The n + 1 nodes of a direction from `lower` to `upper` [m], sections included.
/// throws ConfigError: sections that do not lead from lower to upper in n cells, cells that cannot be fitted
std::vector<double> node_positions(const Stretching& stretching, int n, double lower, double upper,
                                   const std::string& where);

}  // namespace littoral::fv
