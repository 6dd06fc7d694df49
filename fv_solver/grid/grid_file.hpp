#pragma once

#include <string>
#include <vector>

#include "config.hpp"
#include "grid/block.hpp"
#include "grid/face_windows.hpp"

namespace littoral::fv {

/// The blocks of a PLOT3D file with the conditions on their faces. A left-handed block has its direction i
/// reversed; its faces keep the names they have in the file. notes   the dialect found, and what was done to
/// the file's content throws  ConfigError: a file that is none, faces of blocks that do not exist, a spatial
/// file for a plane
template <int D>
std::vector<Block<D>> build_grid_file(const GridFileConfig& config, const support::Scene& scene,
                                      const Neighbourhood& others, std::vector<std::string>& notes);

/// Writes the blocks as PLOT3D: double precision, several blocks, Fortran records, or formatted where the
/// name ends in .fmt or .txt; a plane as x and y. throws IoError
template <int D>
void write_grid(const std::string& path, const std::vector<Block<D>>& blocks);

}  // namespace littoral::fv
