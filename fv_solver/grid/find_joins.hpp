#pragma once

#include <string>
#include <vector>

#include "grid/block.hpp"

namespace littoral::fv {

/// Joins all windows that ask for it (Window::request) with the faces they meet, cell by cell, whatever the
/// orientation: nodes must coincide to a small part of the faces' own edges. Windows are cut where only a
/// part is met; nodes of joined faces are made equal; a block whose opposite faces meet as a whole, in order,
/// becomes periodic (an O-grid); metrics are set anew, ghosts behind joins included. Windows that ask in vain
/// keep their condition if they may, and are reported otherwise. out     one line a join: who, where, how
/// many faces, which way round throws  ConfigError naming block, face, cell and place of every window that is
/// not met though it must be
template <int D>
std::vector<std::string> find_joins(std::vector<Block<D>>& blocks);

}  // namespace littoral::fv
