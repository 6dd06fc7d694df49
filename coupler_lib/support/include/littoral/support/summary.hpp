#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace littoral::support {

/// What a program reports of a finished run, written as OUT/<program>/summary.json; the launcher joins both
/// programs' files. A number that is not finite becomes null.
struct Summary {
  std::string program;
  std::string version;
  int ranks = 1;
  int threads = 1;
  double wall_time = 0.0;                              // [s]
  std::vector<std::pair<std::string, double>> phases;  // Timers::table(), of the slowest rank [s]
  std::map<std::string, double> results;               // "mass_defect", "pairs_per_second", ...
  std::map<std::string, std::string> notes;            // "scene", "digest", "partner", "stopped because", ...
  std::vector<std::string> warnings;

  std::string json() const;
  /// throws IoError
  void write(const std::string& path) const;
};

}  // namespace littoral::support
