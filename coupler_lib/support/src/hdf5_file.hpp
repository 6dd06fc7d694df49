#pragma once

#include <hdf5.h>

#include <cstdint>
#include <string>
#include <vector>

namespace littoral::support {

/// An HDF5 identifier that closes itself.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  hid_t operator*() const { return id_; }
  explicit operator bool() const { return id_ >= 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// Stops HDF5 from printing its own error stack; ours have path, dataset and reason.
void silence_hdf5();
/// The innermost message of HDF5's error stack.
std::string hdf5_reason();

/// How a C++ type lies in a file: little-endian whatever the machine.
template <class T>
hid_t file_type();
template <class T>
hid_t memory_type();

/// An HDF5 file built in memory; the caller writes the bytes. HDF5 itself, when the disk fills up, fails in
/// the close of the file, leaves it open and complains once more at exit; a plain write of bytes fails
/// cleanly.
class Hdf5Image {
 public:
  explicit Hdf5Image(const std::string& path);  ///< the path is for messages
  template <class T>
  void put(const std::string& dataset, const std::vector<hsize_t>& shape, const T* values) {
    put(dataset, shape, file_type<T>(), memory_type<T>(), values);
  }
  void put_text(const std::string& dataset, const std::string& text);
  /// The finished file. Nothing can be added afterwards, and the bytes live as long as this object.
  const void* bytes(std::size_t& count);

 private:
  void put(const std::string& dataset, const std::vector<hsize_t>& shape, hid_t in_file, hid_t in_memory,
           const void* values);
  std::string path_;
  Handle file_;
};

}  // namespace littoral::support
