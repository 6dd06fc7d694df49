#pragma once

#include <memory>
#include <string>

namespace littoral::support {

/// Console and file, for one program of the job. Only rank 0 of the program's communicator writes to the
/// console. A line starts with the program's name; the file's lines also carry the wall clock.
class Log {
 public:
  Log(const std::string& program, int rank, const std::string& file_path);  ///< file_path empty: console only
  ~Log();
  void info(const std::string& message);
  void warn(const std::string& message);
  /// One line a window at most, with the remaining time estimated from the run so far; throttled on the
  /// console to one line every `seconds` (0.5 by default) and always in the file.
  void progress(double time, double end_time, const std::string& details);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace littoral::support
