#pragma once

#include <cstddef>
#include <cstdio>
#include <string>

namespace littoral::support {

/// A file being written, every call of the system checked. throws IoError with path and reason
class OutputFile {
 public:
  enum class Mode { create, append };
  OutputFile(const std::string& path, Mode mode);  ///< makes the folders of the path
  ~OutputFile();                                   ///< closes; silent, since errors were due at flush()
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  void write(const void* bytes, std::size_t count);
  void write(const std::string& text) { write(text.data(), text.size()); }
  void flush();  ///< to the system
  void close();  ///< to the disk, then closed

 private:
  std::string path_;
  std::FILE* file_ = nullptr;
};

/// Writes the whole file under a temporary name (path + ".part") and renames it, so that `path` is always
/// either the old file or the complete new one.
void replace_file(const std::string& path, const void* bytes, std::size_t count);
void replace_file(const std::string& path, const std::string& text);

}  // namespace littoral::support
