#include <algorithm>

#include "tape.hpp"
#include "tape_format.hpp"

namespace littoral::coupler {

TapeReader::TapeReader(const std::string& path, Role speaker, const std::string& scene) : path_(path) {
  const QuietHdf5 quiet;
  file_ = Handle(checked(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), path, "cannot open the record"),
                 H5Fclose);
  const std::string format = attribute(k_format_attribute);
  if (format != k_format)
    throw IoError(path_ + ": is not a record this program reads: its format is '" + format + "', '" +
                  k_format + "' was expected");
  const std::string spoke = attribute(k_speaker_attribute);
  if (spoke != name(speaker))
    throw IoError(path_ + ": holds what the side '" + spoke + "' said, '" + name(speaker) +
                  "' was asked for");
  description_ = attribute(k_description_attribute);
  const std::string recorded = attribute(k_scene_attribute);
  if (recorded != scene)
    throw CouplingError(path_ + ": was recorded in another scene (" + recorded + ", this run has " + scene +
                        "): replay it with the scene and the settings that it was recorded with");
  read_calls();
}

std::string TapeReader::attribute(const std::string& name) {
  if (H5Aexists(file_, name.c_str()) <= 0)
    throw IoError(path_ + ": is HDF5, but not a record: it has no attribute '" + name + "'");
  const std::string tried = "cannot read the attribute '" + name + "'";
  const Handle attribute(checked(H5Aopen(file_, name.c_str(), H5P_DEFAULT), path_, tried), H5Aclose);
  const Handle type(checked(H5Aget_type(attribute), path_, tried), H5Tclose);
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) > 0)
    throw IoError(path_ + ": is not a record: its attribute '" + name + "' is no text");
  std::string text(H5Tget_size(type), '\0');
  checked(H5Aread(attribute, type, text.data()), path_, tried);
  return text.substr(0, text.find('\0'));
}

TapeReader::Track& TapeReader::track(const std::string& name) {
  auto& track = tracks_[name];
  if (track.dataset >= 0) return track;
  const std::string tried = "cannot open '" + name + "'";
  const std::string group = name.substr(0, name.find('/'));
  if (H5Lexists(file_, group.c_str(), H5P_DEFAULT) <= 0 || H5Lexists(file_, name.c_str(), H5P_DEFAULT) <= 0)
    return track;  // nothing was ever written to it
  track.dataset = Handle(checked(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), path_, tried), H5Dclose);
  const Handle space(checked(H5Dget_space(track.dataset), path_, tried), H5Sclose);
  if (H5Sget_simple_extent_ndims(space) != 1)
    throw IoError(path_ + ": is not a record: '" + name + "' does not have one dimension");
  H5Sget_simple_extent_dims(space, &track.size, nullptr);
  return track;
}

std::size_t TapeReader::checked_length(const std::string& name, std::int64_t length) {
  const auto& from = track(name);
  if (length < 0 || static_cast<hsize_t>(length) > from.size - from.at)
    throw IoError(path_ + ": the record is damaged: '" + name + "' holds " +
                  std::to_string(from.size - from.at) + " more values where " + std::to_string(length) +
                  " are due");
  return static_cast<std::size_t>(length);
}

void TapeReader::read(const std::string& name, hid_t type, void* values, std::size_t n) {
  if (n == 0) return;
  const QuietHdf5 quiet;
  const hsize_t count = checked_length(name, static_cast<std::int64_t>(n));
  auto& from = track(name);
  const std::string tried = "cannot read '" + name + "'";
  const Handle file_space(checked(H5Dget_space(from.dataset), path_, tried), H5Sclose);
  checked(H5Sselect_hyperslab(file_space, H5S_SELECT_SET, &from.at, nullptr, &count, nullptr), path_, tried);
  const Handle memory_space(H5Screate_simple(1, &count, nullptr), H5Sclose);
  checked(H5Dread(from.dataset, type, memory_space, file_space, H5P_DEFAULT, values), path_, tried);
  from.at += count;
}

void TapeReader::get(const std::string& track, double* values, std::size_t n) {
  read(track, H5T_NATIVE_DOUBLE, values, n);
}
void TapeReader::get(const std::string& track, std::int64_t* values, std::size_t n) {
  read(track, H5T_NATIVE_INT64, values, n);
}
void TapeReader::get(const std::string& track, std::uint8_t* values, std::size_t n) {
  read(track, H5T_NATIVE_UINT8, values, n);
}

void TapeReader::read_calls() {
  // a program may have died between the columns: what all three of them hold counts
  const std::size_t n =
      std::min({track(k_calls_kind).size, track(k_calls_integers).size / 3, track(k_calls_times).size / 2});
  std::vector<std::uint8_t> kinds(n);
  std::vector<std::int64_t> integers(3 * n);
  std::vector<double> times(2 * n);
  get(k_calls_kind, kinds.data(), kinds.size());
  get(k_calls_integers, integers.data(), integers.size());
  get(k_calls_times, times.data(), times.size());
  for (std::size_t i = 0; i < n; ++i) {
    if (kinds[i] >= k_call_names.size()) throw IoError(path_ + ": the record is damaged: unknown call");
    Call call;
    call.kind = static_cast<CallKind>(kinds[i]);
    call.window = {integers[3 * i], times[2 * i], times[2 * i + 1], static_cast<int>(integers[3 * i + 1])};
    call.count = integers[3 * i + 2];
    calls_.push_back(call);
  }
}

}  // namespace littoral::coupler
