#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "calls.hpp"
#include "hdf5.hpp"
#include "littoral/coupler/types.hpp"

namespace littoral::coupler {

/// A record on disk: an HDF5 file of one-dimensional tracks that only grow ("donors/p": the p of all donors
/// of all windows, one after the other; "donors/length": how many belong to each), and the list of calls,
/// "calls/...", that says in which order to read them. Nothing but the calls of the current window is held in
/// memory. throws IoError
class TapeWriter {
 public:
  /// speaker: whose words are recorded.
  TapeWriter(const std::string& path, Role speaker, const std::string& description, const std::string& scene);
  ~TapeWriter();  ///< commits, without a word if that fails

  void put(const std::string& track, const double* values, std::size_t n);
  void put(const std::string& track, const std::int64_t* values, std::size_t n);
  void put(const std::string& track, const std::uint8_t* values, std::size_t n);

  /// The lengths and values of all columns of a structure.
  template <class Each, class Values>
  void put_columns(const std::string& group, const Each& each, const Values& values) {
    std::vector<std::int64_t> lengths;
    each(values, [&](const char* name, const auto& column) {
      lengths.push_back(static_cast<std::int64_t>(column.size()));
      put_column(group + "/" + name, column);
    });
    put(group + "/length", lengths.data(), lengths.size());
  }

  /// Ends what was put for one call.
  void put(const Call& call) { calls_.push_back(call); }
  /// From here on the calls so far are readable, whatever happens to the program: their values are flushed
  /// first, then the calls that refer to them.
  void commit();

 private:
  void put_column(const std::string& track, const std::vector<double>& c) { put(track, c.data(), c.size()); }
  void put_column(const std::string& track, const std::vector<std::uint8_t>& c) {
    put(track, c.data(), c.size());
  }
  void put_column(const std::string& track, const std::vector<SampleStatus>& c) {
    put(track, reinterpret_cast<const std::uint8_t*>(c.data()), c.size());
  }
  void append(const std::string& track, hid_t type, const void* values, std::size_t n);
  void write_calls();

  std::string path_;
  Handle file_;
  struct Track {
    Handle dataset;
    hsize_t size = 0;
  };
  std::map<std::string, Track> tracks_;
  std::vector<Call> calls_;
};

/// Reads a record's tracks from the beginning on. throws IoError: no such file, no HDF5, no record, a record
/// of the other side, values missing; CouplingError: of another scene
class TapeReader {
 public:
  TapeReader(const std::string& path, Role speaker, const std::string& scene);

  const std::string& path() const { return path_; }
  const std::string& description() const { return description_; }
  const std::vector<Call>& calls() const { return calls_; }

  void get(const std::string& track, double* values, std::size_t n);
  void get(const std::string& track, std::int64_t* values, std::size_t n);
  void get(const std::string& track, std::uint8_t* values, std::size_t n);

  template <class Each, class Values>
  void get_columns(const std::string& group, const Each& each, Values& values) {
    each(values, [&](const char* name, auto& column) {
      std::int64_t length = 0;
      get(group + "/length", &length, 1);
      column.resize(checked_length(group + "/" + name, length));
      get_column(group + "/" + name, column);
    });
  }
  /// A length found in the record: not negative and within what is left of the track.
  std::size_t checked_length(const std::string& track, std::int64_t length);

 private:
  void get_column(const std::string& track, std::vector<double>& c) { get(track, c.data(), c.size()); }
  void get_column(const std::string& track, std::vector<std::uint8_t>& c) { get(track, c.data(), c.size()); }
  void get_column(const std::string& track, std::vector<SampleStatus>& c) {
    get(track, reinterpret_cast<std::uint8_t*>(c.data()), c.size());
  }
  struct Track {
    Handle dataset;
    hsize_t size = 0, at = 0;
  };
  Track& track(const std::string& name);
  void read(const std::string& name, hid_t type, void* values, std::size_t n);
  void read_calls();
  std::string attribute(const std::string& name);

  std::string path_;
  Handle file_;
  std::string description_;
  std::map<std::string, Track> tracks_;
  std::vector<Call> calls_;
};

}  // namespace littoral::coupler
