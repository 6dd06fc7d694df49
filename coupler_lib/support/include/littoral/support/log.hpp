#pragma once

#include <memory>
#include <string>

namespace littoral::support {

/// Console and file, for one program of the job. Only rank 0 of the program's communicator writes to the
/// console. A line starts with the program's name; the file's lines also carry the wall clock.
class Log {
 public:
  /// file_path empty: console only. The caller gives it on the ranks that keep a file (usually rank 0).
  /// throws IoError if the file cannot be opened
  Log(const std::string& program, int rank, const std::string& file_path, double seconds = 0.5);
  ~Log();
  void info(const std::string& message);
  void warn(const std::string& message);
  /// One line a window at most, with the remaining time estimated from the run so far; throttled on the
  /// console to one line every `seconds` of wall time, and always in the file.
  void progress(double time, double end_time, const std::string& details);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace littoral::support
