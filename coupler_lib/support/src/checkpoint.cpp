#include "littoral/support/checkpoint.hpp"

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "hdf5_file.hpp"
#include "littoral/error.hpp"
#include "output_file.hpp"

namespace littoral::support {

std::string checkpoint_path(const std::string& folder, std::int64_t window) {
  std::array<char, 40> name;
  std::snprintf(name.data(), name.size(), "/checkpoint_%08lld.h5", static_cast<long long>(window));
  return folder + name.data();
}

struct CheckpointWriter::Impl {
  explicit Impl(const std::string& path) : file(path), image(path) {}
  ReplacingFile file;
  Hdf5Image image;

  template <class T>
  void put(const std::string& name, const std::vector<T>& values) {
    image.put(name, {values.size()}, values.data());
  }
};

CheckpointWriter::CheckpointWriter(const std::string& path) : impl_(std::make_unique<Impl>(path)) {}
CheckpointWriter::~CheckpointWriter() = default;

void CheckpointWriter::put(const std::string& name, const std::vector<double>& values) {
  impl_->put(name, values);
}
void CheckpointWriter::put(const std::string& name, const std::vector<std::int64_t>& values) {
  impl_->put(name, values);
}
void CheckpointWriter::put(const std::string& name, const std::vector<std::int32_t>& values) {
  impl_->put(name, values);
}
void CheckpointWriter::put(const std::string& name, const std::vector<std::uint8_t>& values) {
  impl_->put(name, values);
}
void CheckpointWriter::put(const std::string& name, double value) { impl_->image.put(name, {}, &value); }
void CheckpointWriter::put(const std::string& name, std::int64_t value) {
  impl_->image.put(name, {}, &value);
}
void CheckpointWriter::put(const std::string& name, const std::string& value) {
  impl_->image.put_text(name, value);
}

void CheckpointWriter::commit() {
  std::size_t count = 0;
  const void* bytes = impl_->image.bytes(count);
  impl_->file.commit(bytes, count);
}

struct CheckpointReader::Impl {
  std::string path;
  Handle file;

  static hid_t open(const std::string& path) {
    silence_hdf5();
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) throw IoError(path + ": cannot open: No such file.");
    if (std::filesystem::is_directory(path, ignored))
      throw IoError(path + ": is a folder; expected a checkpoint.");
    if (!std::ifstream(path)) throw IoError(path + ": cannot open for reading.");
    if (H5Fis_hdf5(path.c_str()) <= 0) throw IoError(path + ": is no checkpoint (not an HDF5 file).");
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    if (file < 0) throw IoError(path + ": cannot open: " + hdf5_reason() + ".");
    return file;
  }
  explicit Impl(const std::string& name) : path(name), file(open(name), H5Fclose) {}

  bool has(const std::string& name) const {
    for (std::size_t slash = name.find('/', 1);; slash = name.find('/', slash + 1)) {
      if (H5Lexists(*file, name.substr(0, slash).c_str(), H5P_DEFAULT) <= 0) return false;
      if (slash == std::string::npos) return true;
    }
  }
  [[noreturn]] void fail(const std::string& name, const std::string& problem) const {
    throw IoError(path + ": dataset '" + name + "' " + problem + ".");
  }
  hid_t dataset(const std::string& name) const {
    if (!has(name)) fail(name, "is missing; is this a checkpoint of another program or scene?");
    const hid_t set = H5Dopen2(*file, name.c_str(), H5P_DEFAULT);
    if (set < 0) fail(name, "cannot be opened: " + hdf5_reason());
    return set;
  }
  void read(hid_t set, hid_t type, void* values, const std::string& name) const {
    if (H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0)
      fail(name, "cannot be read: " + hdf5_reason());
  }

  /// rank: 0 for a scalar, 1 for an array
  template <class T>
  std::vector<T> values(const std::string& name, int rank, const char* expected) const {
    const Handle set(dataset(name), H5Dclose);
    const Handle type(H5Dget_type(*set), H5Tclose);
    const Handle space(H5Dget_space(*set), H5Sclose);
    if (!type || !space) fail(name, "cannot be read: " + hdf5_reason());
    if (H5Tequal(*type, file_type<T>()) <= 0 || H5Sget_simple_extent_ndims(*space) != rank)
      fail(name, std::string("has another type; expected ") + expected);
    std::vector<T> out(static_cast<std::size_t>(H5Sget_simple_extent_npoints(*space)));
    if (!out.empty()) read(*set, memory_type<T>(), out.data(), name);
    return out;
  }
};

CheckpointReader::CheckpointReader(const std::string& path) : impl_(std::make_unique<Impl>(path)) {}
CheckpointReader::~CheckpointReader() = default;
bool CheckpointReader::has(const std::string& name) const { return impl_->has(name); }

std::vector<double> CheckpointReader::doubles(const std::string& name) const {
  return impl_->values<double>(name, 1, "an array of doubles");
}
std::vector<std::int64_t> CheckpointReader::int64s(const std::string& name) const {
  return impl_->values<std::int64_t>(name, 1, "an array of 64-bit integers");
}
std::vector<std::int32_t> CheckpointReader::int32s(const std::string& name) const {
  return impl_->values<std::int32_t>(name, 1, "an array of 32-bit integers");
}
std::vector<std::uint8_t> CheckpointReader::bytes(const std::string& name) const {
  return impl_->values<std::uint8_t>(name, 1, "an array of bytes");
}
double CheckpointReader::number(const std::string& name) const {
  return impl_->values<double>(name, 0, "one double")[0];
}
std::int64_t CheckpointReader::integer(const std::string& name) const {
  return impl_->values<std::int64_t>(name, 0, "one 64-bit integer")[0];
}

std::string CheckpointReader::text(const std::string& name) const {
  const Handle set(impl_->dataset(name), H5Dclose);
  const Handle type(H5Dget_type(*set), H5Tclose);
  const Handle space(H5Dget_space(*set), H5Sclose);
  if (!type || !space) impl_->fail(name, "cannot be read: " + hdf5_reason());
  if (H5Tget_class(*type) != H5T_STRING || H5Tis_variable_str(*type) > 0 ||
      H5Sget_simple_extent_type(*space) != H5S_SCALAR)
    impl_->fail(name, "has another type; expected a text");
  std::string out(H5Tget_size(*type), '\0');
  impl_->read(*set, *type, out.data(), name);
  out.pop_back();
  return out;
}

}  // namespace littoral::support
