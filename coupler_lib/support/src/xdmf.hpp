#pragma once

#include <string>
#include <vector>

#include "littoral/support/series.hpp"

namespace littoral::support {

/// The XDMF text of one step; `h5` is the data file's name beside the XDMF file.
std::string xdmf_points(int step, double time, const std::string& h5, std::size_t n_points,
                        const std::vector<OutputField>& fields);
std::string xdmf_blocks(int step, double time, const std::string& h5,
                        const std::vector<FieldSeries::Block>& blocks);
/// The whole file.
std::string xdmf_file(const std::string& name, const std::vector<std::string>& steps);

struct XdmfStep {
  int step = 0;
  double time = 0.0;
  std::string text;
};
/// The complete steps of a file written by xdmf_file().
std::vector<XdmfStep> xdmf_steps(const std::string& file);

}  // namespace littoral::support
