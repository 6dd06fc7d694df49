#pragma once

#include <cstddef>
#include <cstdio>
#include <memory>
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
  void flush();  ///< to the system; throws also where the file was deleted meanwhile
  void close();  ///< to the disk, then closed

 private:
  std::string path_;
  std::FILE* file_ = nullptr;
};

/// A file written under a temporary name (path + ".part") and renamed when complete, so that `path` is always
/// either the old file or the whole new one. A path that cannot be written is found at once.
class ReplacingFile {
 public:
  explicit ReplacingFile(const std::string& path);
  ~ReplacingFile();  ///< without commit(): removes the temporary file
  ReplacingFile(const ReplacingFile&) = delete;
  ReplacingFile& operator=(const ReplacingFile&) = delete;
  void commit(const void* bytes, std::size_t count);

 private:
  std::string path_, temporary_;
  std::unique_ptr<OutputFile> file_;
};

void replace_file(const std::string& path, const std::string& text);

}  // namespace littoral::support
