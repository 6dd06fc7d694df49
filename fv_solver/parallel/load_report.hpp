#pragma once

#include <string>
#include <vector>

#include "parallel/layout.hpp"

namespace littoral::fv {

/// For the log: how the cells are dealt to the ranks, and what the cuts cost the multigrid. pure
template <int D>
std::vector<std::string> load_report(const Layout<D>& layout);

}  // namespace littoral::fv
