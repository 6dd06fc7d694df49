#include "io/checkpoint.hpp"

#include <type_traits>
#include <vector>

#include "littoral/error.hpp"
#include "littoral/support/checkpoint.hpp"

namespace littoral::sph {

namespace {

constexpr std::int64_t k_format = 2;

/// Columns are numbered in the order of the particles' own list, so that none can be forgotten here.
std::string column_name(const char* group, std::size_t k) {
  return std::string(group) + "_" + std::to_string(k);
}

struct Writer {
  support::CheckpointWriter& file;
  std::size_t n;
  const char* group;
  std::size_t k = 0;

  template <class T>
  void operator()(std::vector<T>& column) {
    const std::string name = column_name(group, k++);
    const auto end = column.begin() + static_cast<std::ptrdiff_t>(n);
    if constexpr (std::is_enum_v<T>) {
      std::vector<std::uint8_t> bytes;
      bytes.reserve(n);
      for (auto it = column.begin(); it != end; ++it) bytes.push_back(static_cast<std::uint8_t>(*it));
      file.put(name, bytes);
    } else {
      file.put(name, std::vector<T>(column.begin(), end));
    }
  }
};

struct Reader {
  const support::CheckpointReader& file;
  const std::string& path;
  std::size_t n;            // in the file
  std::size_t first, last;  // taken
  const char* group;
  std::size_t k = 0;

  template <class T>
  void operator()(std::vector<T>& column) {
    const std::string name = column_name(group, k++);
    if constexpr (std::is_enum_v<T>) {
      const auto bytes = file.bytes(name);
      column.resize(bytes.size());
      for (std::size_t i = 0; i < bytes.size(); ++i) column[i] = static_cast<T>(bytes[i]);
    } else if constexpr (std::is_same_v<T, double>) {
      column = file.doubles(name);
    } else {
      column = file.int64s(name);
    }
    if (column.size() != n)
      throw IoError(path + ": column " + name + " holds " + std::to_string(column.size()) + " values for " +
                    std::to_string(n) + " particles; the file is damaged.");
    column = std::vector<T>(column.begin() + static_cast<std::ptrdiff_t>(first),
                            column.begin() + static_cast<std::ptrdiff_t>(last));
  }
};

}  // namespace

template <int D>
void write_checkpoint(const std::string& path, const RunState& run, const Particles<D>& particles,
                      const ParticleExchange<D>* exchange) {
  support::CheckpointWriter file(path);
  file.put("format", k_format);
  file.put("dimension", std::int64_t{D});
  file.put("scene_title", run.scene_title);
  file.put("scene_digest", run.scene_digest);
  file.put("time", run.time);
  file.put("window", run.window);
  file.put("last_fields", run.last_fields);
  file.put("most_acceleration", run.most_acceleration);
  file.put("n_owned", static_cast<std::int64_t>(particles.n_owned));
  file.put("rank_counts", run.rank_counts.empty()
                              ? std::vector<std::int64_t>{static_cast<std::int64_t>(particles.n_owned)}
                              : run.rank_counts);
  file.put("regions", run.regions);
  file.put("load", run.load);
  file.put("next_id", particles.next_id);
  auto& columns =
      const_cast<Particles<D>&>(particles);  // the list of columns is not const; they are only read
  columns.for_each_shared_column(Writer{file, particles.n_owned, "state"});
  columns.for_each_owned_column(Writer{file, particles.n_owned, "owned"});
  file.put("coupled", std::int64_t{exchange != nullptr});
  if (exchange != nullptr) {
    file.put("exchange_masses", exchange->pack());
    file.put("exchange_counts", exchange->pack_counts());
  }
  file.commit();
}

namespace {

RunState read_run_state(const support::CheckpointReader& file, const std::string& path,
                        const support::Scene& scene) {
  if (file.integer("format") != k_format)
    throw IoError(path + ": checkpoint format " + std::to_string(file.integer("format")) +
                  "; this program reads format " + std::to_string(k_format) + ".");
  RunState run;
  run.scene_title = file.text("scene_title");
  run.scene_digest = file.text("scene_digest");
  if (run.scene_digest != scene.restart_digest)
    throw ConfigError(path + ": this checkpoint belongs to another scene, '" + run.scene_title +
                      "' (digest " + run.scene_digest + "); the run's scene is '" + scene.title +
                      "' (digest " + scene.restart_digest +
                      "). Only the title, the section time and coupling.deadline may differ at a restart.");
  run.time = file.number("time");
  run.window = file.integer("window");
  run.last_fields = file.number("last_fields");
  run.most_acceleration = file.number("most_acceleration");
  run.rank_counts = file.int64s("rank_counts");
  run.regions = file.doubles("regions");
  run.load = file.number("load");
  return run;
}

/// First particle of a rank, and the one behind its last: the same for all its columns.
std::size_t share_begin(const RunState& run, std::size_t n, const CheckpointShare& share, int rank) {
  if (run.rank_counts.size() != static_cast<std::size_t>(share.size))
    return n * static_cast<std::size_t>(rank) / static_cast<std::size_t>(share.size);
  std::int64_t begin = 0;
  for (int r = 0; r < rank; ++r) begin += run.rank_counts[static_cast<std::size_t>(r)];
  return static_cast<std::size_t>(begin);
}

}  // namespace

RunState read_run_state(const std::string& path, const support::Scene& scene) {
  return read_run_state(support::CheckpointReader(path), path, scene);
}

template <int D>
RunState read_checkpoint(const std::string& path, const support::Scene& scene, Particles<D>& particles,
                         ParticleExchange<D>* exchange, const CheckpointShare& share) {
  const support::CheckpointReader file(path);
  const RunState run = read_run_state(file, path, scene);
  if (file.integer("dimension") != D)
    throw IoError(path + ": a checkpoint in " + std::to_string(file.integer("dimension")) + " dimensions.");
  if ((file.integer("coupled") != 0) != (exchange != nullptr))
    throw ConfigError(path + ": written " + (exchange == nullptr ? "with" : "without") +
                      " a partner, this run has " + (exchange == nullptr ? "none." : "one."));
  particles = Particles<D>();
  const auto n = static_cast<std::size_t>(file.integer("n_owned"));
  const std::size_t first = share_begin(run, n, share, share.rank),
                    last = share_begin(run, n, share, share.rank + 1);
  if (first > last || last > n)
    throw IoError(path + ": its ranks' counts do not add up; the file is damaged.");
  particles.n_owned = last - first;
  particles.next_id = file.integer("next_id");
  particles.for_each_shared_column(Reader{file, path, n, first, last, "state"});
  particles.for_each_owned_column(Reader{file, path, n, first, last, "owned"});
  if (exchange != nullptr) exchange->unpack(file.doubles("exchange_masses"), file.int64s("exchange_counts"));
  return run;
}

template void write_checkpoint<2>(const std::string&, const RunState&, const Particles<2>&,
                                  const ParticleExchange<2>*);
template void write_checkpoint<3>(const std::string&, const RunState&, const Particles<3>&,
                                  const ParticleExchange<3>*);
template RunState read_checkpoint<2>(const std::string&, const support::Scene&, Particles<2>&,
                                     ParticleExchange<2>*, const CheckpointShare&);
template RunState read_checkpoint<3>(const std::string&, const support::Scene&, Particles<3>&,
                                     ParticleExchange<3>*, const CheckpointShare&);

}  // namespace littoral::sph
