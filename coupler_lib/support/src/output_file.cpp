#include "output_file.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "littoral/error.hpp"

namespace littoral::support {
namespace {

[[noreturn]] void fail(const std::string& path, const std::string& action, int code) {
  throw IoError(path + ": cannot " + action + ": " + std::strerror(code) + ".");
}

}  // namespace

OutputFile::OutputFile(const std::string& path, Mode mode) : path_(path) {
  const auto folder = std::filesystem::path(path).parent_path();
  std::error_code error;
  if (!folder.empty()) std::filesystem::create_directories(folder, error);
  if (error) fail(folder.string(), "make the folder", error.value());
  errno = 0;
  file_ = std::fopen(path.c_str(), mode == Mode::append ? "ab" : "wb");
  if (!file_) fail(path, "open for writing", errno);
}

OutputFile::~OutputFile() {
  if (file_) std::fclose(file_);
}

void OutputFile::write(const void* bytes, std::size_t count) {
  errno = 0;
  if (std::fwrite(bytes, 1, count, file_) != count) fail(path_, "write", errno);
}

void OutputFile::flush() {
  errno = 0;
  if (std::fflush(file_) != 0) fail(path_, "write", errno);
  // the system accepts bytes for a deleted file and drops them when it is closed
  struct stat status {};
  if (fstat(fileno(file_), &status) == 0 && status.st_nlink == 0)
    throw IoError(path_ + ": was deleted while this run writes it. Leave the folder of a run in place.");
}

void OutputFile::close() {
  flush();
  // pipes and terminals cannot be synchronised; that is no loss
  if (fsync(fileno(file_)) != 0 && errno != EINVAL && errno != EROFS) fail(path_, "write", errno);
  std::FILE* file = file_;
  file_ = nullptr;
  errno = 0;
  if (std::fclose(file) != 0) fail(path_, "close", errno);
}

ReplacingFile::ReplacingFile(const std::string& path)
    : path_(path),
      temporary_(path + ".part"),
      file_(std::make_unique<OutputFile>(temporary_, OutputFile::Mode::create)) {}

ReplacingFile::~ReplacingFile() {
  std::error_code ignored;
  if (file_) std::filesystem::remove(temporary_, ignored);
}

void ReplacingFile::commit(const void* bytes, std::size_t count) {
  file_->write(bytes, count);
  file_->close();
  std::error_code error;
  std::filesystem::rename(temporary_, path_, error);
  if (error) fail(path_, "rename the finished file to this name", error.value());
  file_.reset();
}

void replace_file(const std::string& path, const std::string& text) {
  ReplacingFile file(path);
  file.commit(text.data(), text.size());
}

}  // namespace littoral::support
