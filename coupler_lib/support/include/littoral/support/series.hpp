#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace littoral::support {

/// A CSV file with a fixed header, full precision (%.17g), flushed each row.
/// The second line may give units, after a "#". After a restart, rows later than the restart's time are cut
/// off and writing goes on (append_after; a file that is not there is begun). throws IoError with the path
/// and the system's reason, also when the disk is full
class CsvSeries {
 public:
  CsvSeries(const std::string& path, const std::vector<std::string>& columns,
            const std::string& units_comment = "");
  static CsvSeries append_after(const std::string& path, const std::vector<std::string>& columns, double time,
                                const std::string& units_comment = "");
  CsvSeries(CsvSeries&&) noexcept;
  ~CsvSeries();
  void row(const std::vector<double>& values);  ///< values.size() == columns; first column is the time

 private:
  CsvSeries();
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// A named field over the points or cells of one output: `components` 1 (scalar) or 3 (vector), interleaved.
struct OutputField {
  std::string name;
  int components = 1;
  std::vector<double> values;  // (components * n)
};

/// XDMF + HDF5 time series, opened by ParaView as it is: OUT/<name>.xdmf beside OUT/<name>_<step>.h5.
/// The XDMF file is rewritten after every step, so an interrupted run is readable.
/// comm: local, one writer (the caller gathers). throws IoError
class FieldSeries {
 public:
  FieldSeries(const std::string& folder, const std::string& name, bool restarted, double restart_time);
  FieldSeries(FieldSeries&&) noexcept;
  ~FieldSeries();
  /// Particles: points x, y, z interleaved (3 n) [m].
  void write_points(double time, const std::vector<double>& xyz,
                    const std::vector<OutputField>& point_fields);

  /// One structured block: nodes (ni+1)(nj+1)(nk+1) interleaved xyz, i fastest; fields at the cells (ni nj
  /// nk). A planar block has one cell in its thin direction and still has two layers of nodes.
  struct Block {
    std::string name;
    std::array<int, 3> cells;
    std::vector<double> nodes;
    std::vector<OutputField> cell_fields;
  };
  void write_blocks(double time, const std::vector<Block>& blocks);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace littoral::support
