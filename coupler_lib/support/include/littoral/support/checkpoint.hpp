#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace littoral::support {

/// FOLDER/checkpoint_00000120.h5: the same name from both programs, so that those of one window are found.
std::string checkpoint_path(const std::string& folder, std::int64_t window);

/// HDF5 file of named arrays and scalars, exact to the bit. Written to a temporary name and renamed on close,
/// so that a crash or a full disk never leaves a half checkpoint under the final name. throws IoError with
/// path, dataset and reason (missing, wrong type, wrong size, disk full)
class CheckpointWriter {
 public:
  explicit CheckpointWriter(const std::string& path);
  ~CheckpointWriter();  ///< without commit(): removes the temporary file
  void put(const std::string& name, const std::vector<double>& values);
  void put(const std::string& name, const std::vector<std::int64_t>& values);
  void put(const std::string& name, const std::vector<std::int32_t>& values);
  void put(const std::string& name, const std::vector<std::uint8_t>& values);
  void put(const std::string& name, double value);
  void put(const std::string& name, std::int64_t value);
  void put(const std::string& name, const std::string& value);
  void commit();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

class CheckpointReader {
 public:
  explicit CheckpointReader(const std::string& path);
  ~CheckpointReader();
  bool has(const std::string& name) const;
  std::vector<double> doubles(const std::string& name) const;
  std::vector<std::int64_t> int64s(const std::string& name) const;
  std::vector<std::int32_t> int32s(const std::string& name) const;
  std::vector<std::uint8_t> bytes(const std::string& name) const;
  double number(const std::string& name) const;
  std::int64_t integer(const std::string& name) const;
  std::string text(const std::string& name) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace littoral::support
