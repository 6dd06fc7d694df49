#include <algorithm>

#include "tape.hpp"
#include "tape_format.hpp"

namespace littoral::coupler {

namespace {

void write_attribute(hid_t file, const std::string& path, const char* name, const std::string& text) {
  const std::string tried = std::string("cannot write the attribute '") + name + "'";
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  checked(H5Tset_size(type, text.size() + 1), path, tried);
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute(checked(H5Acreate2(file, name, type, space, H5P_DEFAULT, H5P_DEFAULT), path, tried),
                         H5Aclose);
  checked(H5Awrite(attribute, type, text.c_str()), path, tried);
}

}  // namespace

TapeWriter::TapeWriter(const std::string& path, Role speaker, const std::string& description,
                       const std::string& scene)
    : path_(path) {
  const QuietHdf5 quiet;
  file_ = Handle(checked(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), path,
                         "cannot create the record"),
                 H5Fclose);
  write_attribute(file_, path_, k_format_attribute, k_format);
  write_attribute(file_, path_, k_speaker_attribute, name(speaker));
  write_attribute(file_, path_, k_description_attribute, description);
  write_attribute(file_, path_, k_scene_attribute, scene);
  checked(H5Fflush(file_, H5F_SCOPE_LOCAL), path_, "cannot flush");
}

TapeWriter::~TapeWriter() {
  try {
    commit();
  } catch (const IoError&) {
  }
}

void TapeWriter::put(const std::string& track, const double* values, std::size_t n) {
  append(track, H5T_NATIVE_DOUBLE, values, n);
}
void TapeWriter::put(const std::string& track, const std::int64_t* values, std::size_t n) {
  append(track, H5T_NATIVE_INT64, values, n);
}
void TapeWriter::put(const std::string& track, const std::uint8_t* values, std::size_t n) {
  append(track, H5T_NATIVE_UINT8, values, n);
}

void TapeWriter::append(const std::string& name, hid_t type, const void* values, std::size_t n) {
  if (n == 0) return;
  const QuietHdf5 quiet;
  const hsize_t count = n;
  auto& track = tracks_[name];
  if (track.dataset < 0) {
    // chunks that hold several calls' values where these are few, and part of a call's where they are many
    const hsize_t chunk = std::clamp<hsize_t>(8 * count, 512, 65536), none = 0, any = H5S_UNLIMITED;
    const Handle space(H5Screate_simple(1, &none, &any), H5Sclose);
    const Handle layout(H5Pcreate(H5P_DATASET_CREATE), H5Pclose), link(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
    H5Pset_chunk(layout, 1, &chunk);
    H5Pset_create_intermediate_group(link, 1);
    track.dataset = Handle(checked(H5Dcreate2(file_, name.c_str(), type, space, link, layout, H5P_DEFAULT),
                                   path_, "cannot create '" + name + "'"),
                           H5Dclose);
  }
  const std::string tried = "cannot write '" + name + "'";
  const hsize_t begin = track.size, end = begin + count;
  checked(H5Dset_extent(track.dataset, &end), path_, tried);
  const Handle file_space(checked(H5Dget_space(track.dataset), path_, tried), H5Sclose);
  checked(H5Sselect_hyperslab(file_space, H5S_SELECT_SET, &begin, nullptr, &count, nullptr), path_, tried);
  const Handle memory_space(H5Screate_simple(1, &count, nullptr), H5Sclose);
  checked(H5Dwrite(track.dataset, type, memory_space, file_space, H5P_DEFAULT, values), path_, tried);
  track.size = end;
}

void TapeWriter::commit() {
  if (calls_.empty()) return;
  const QuietHdf5 quiet;
  checked(H5Fflush(file_, H5F_SCOPE_LOCAL), path_, "cannot flush");
  write_calls();
  checked(H5Fflush(file_, H5F_SCOPE_LOCAL), path_, "cannot flush");
  calls_.clear();
}

void TapeWriter::write_calls() {
  for (const auto& call : calls_) {
    const auto kind = static_cast<std::uint8_t>(call.kind);
    const auto& w = call.window;
    const std::array<std::int64_t, 3> integers = {w.index, w.substeps, call.count};
    const std::array<double, 2> times = {w.t_begin, w.t_end};
    put(k_calls_integers, integers.data(), integers.size());
    put(k_calls_times, times.data(), times.size());
    put(k_calls_kind, &kind, 1);
  }
}

}  // namespace littoral::coupler
