#include "hdf5_file.hpp"

#include "littoral/error.hpp"

namespace littoral::support {
namespace {

constexpr std::size_t k_growth = std::size_t{1} << 20;  // bytes by which the image in memory grows

hid_t open_image(const std::string& path) {
  silence_hdf5();
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  const bool good = access && H5Pset_fapl_core(*access, k_growth, false) >= 0;
  // without a backing store nothing of this name is touched on disk
  const hid_t file = good ? H5Fcreate((path + ".image").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, *access) : -1;
  if (file < 0) throw IoError(path + ": cannot begin an HDF5 file: " + hdf5_reason() + ".");
  return file;
}

herr_t innermost(unsigned, const H5E_error2_t* error, void* reason) {
  if (error->desc) *static_cast<std::string*>(reason) = error->desc;
  return 0;
}

}  // namespace

void silence_hdf5() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

std::string hdf5_reason() {
  std::string reason = "unknown reason";
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_DOWNWARD, innermost, &reason);
  return reason;
}

// clang-format off
template <> hid_t file_type<double>() { return H5T_IEEE_F64LE; }
template <> hid_t file_type<std::int64_t>() { return H5T_STD_I64LE; }
template <> hid_t file_type<std::int32_t>() { return H5T_STD_I32LE; }
template <> hid_t file_type<std::uint8_t>() { return H5T_STD_U8LE; }
template <> hid_t memory_type<double>() { return H5T_NATIVE_DOUBLE; }
template <> hid_t memory_type<std::int64_t>() { return H5T_NATIVE_INT64; }
template <> hid_t memory_type<std::int32_t>() { return H5T_NATIVE_INT32; }
template <> hid_t memory_type<std::uint8_t>() { return H5T_NATIVE_UINT8; }
// clang-format on

Hdf5Image::Hdf5Image(const std::string& path) : path_(path), file_(open_image(path), H5Fclose) {}

void Hdf5Image::put(const std::string& dataset, const std::vector<hsize_t>& shape, hid_t in_file,
                    hid_t in_memory, const void* values) {
  const Handle space(shape.empty() ? H5Screate(H5S_SCALAR)
                                   : H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr),
                     H5Sclose);
  const Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  const bool ready = space && links && H5Pset_create_intermediate_group(*links, 1) >= 0;
  const Handle target(
      ready ? H5Dcreate2(*file_, dataset.c_str(), in_file, *space, *links, H5P_DEFAULT, H5P_DEFAULT) : -1,
      H5Dclose);
  hsize_t count = 1;
  for (const hsize_t extent : shape) count *= extent;
  const bool good =
      target && (count == 0 || H5Dwrite(*target, in_memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0);
  if (!good) throw IoError(path_ + ": cannot write dataset '" + dataset + "': " + hdf5_reason() + ".");
}

void Hdf5Image::put_text(const std::string& dataset, const std::string& text) {
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  // one byte more than the text, so that the length is exact even with zeros inside, and never 0
  if (!type || H5Tset_size(*type, text.size() + 1) < 0)
    throw IoError(path_ + ": cannot write dataset '" + dataset + "': " + hdf5_reason() + ".");
  put(dataset, {}, *type, *type, text.c_str());
}

const void* Hdf5Image::bytes(std::size_t& count) {
  void** memory = nullptr;
  const bool flushed = H5Fflush(*file_, H5F_SCOPE_GLOBAL) >= 0;
  // what the file uses; H5Fget_filesize would count the memory, which grows in steps of k_growth
  const ssize_t size = flushed ? H5Fget_file_image(*file_, nullptr, 0) : -1;
  const bool good =
      size > 0 && H5Fget_vfd_handle(*file_, H5P_DEFAULT, reinterpret_cast<void**>(&memory)) >= 0 && memory;
  if (!good) throw IoError(path_ + ": cannot finish the HDF5 file: " + hdf5_reason() + ".");
  count = static_cast<std::size_t>(size);
  return *memory;
}

}  // namespace littoral::support
