#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace littoral::fv {

/// How a PLOT3D grid file is written: the format has no header that says so.
struct Plot3dDialect {
  bool formatted = false;         // text; else binary
  bool records = true;            // binary: Fortran records with their lengths; else a plain stream
  bool single_precision = false;  // binary only
  bool multi_block = true;        // begins with the number of blocks
  bool iblank = false;
  bool planar = false;         // x and y only
  bool foreign_bytes = false;  // binary: the other byte order than this machine's
};

/// One block: nodes with direction i fastest.
struct Plot3dBlock {
  std::array<int, 3> n = {1, 1, 1};      // nodes
  std::array<std::vector<double>, 3> x;  // [m] (n0 n1 n2) each; x[2] empty in a planar file
  std::vector<int> iblank;               // (n0 n1 n2) or empty; 0: hole
  std::size_t nodes() const {
    return static_cast<std::size_t>(n[0]) * static_cast<std::size_t>(n[1]) * static_cast<std::size_t>(n[2]);
  }
};

struct Plot3dFile {
  std::vector<Plot3dBlock> blocks;
  Plot3dDialect dialect;
};

/// "unformatted (Fortran records), double precision, 3 blocks in space, big-endian". pure
std::string describe(const Plot3dFile& file);

/// Reads a grid, finding out its dialect from its size and record lengths.
/// throws IoError (missing), ConfigError where no dialect fits
Plot3dFile read_plot3d(const std::string& path);

/// throws IoError
void write_plot3d(const std::string& path, const Plot3dFile& file);

}  // namespace littoral::fv
