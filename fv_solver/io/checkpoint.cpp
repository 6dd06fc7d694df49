#include "io/checkpoint.hpp"

#include <algorithm>
#include <cstring>

#include "grid/loops.hpp"
#include "grid/metrics.hpp"
#include "littoral/error.hpp"
#include "littoral/support/checkpoint.hpp"

namespace littoral::fv {
namespace {

std::string group(std::size_t level) { return "level" + std::to_string(level) + "/"; }
std::string component(std::size_t k) { return "u" + std::to_string(k); }

template <int D>
void put_statuses(StateWriter<D>& file, const std::vector<Block<D>>& blocks) {
  std::vector<Field> status;
  std::vector<const Field*> own;
  for (const Block<D>& block : blocks) {
    status.emplace_back();
    for (const CellStatus s : block.status) status.back().push_back(static_cast<double>(s));
  }
  for (const Field& field : status) own.push_back(&field);
  const std::vector<Field> whole = gather_whole<D>(file.layout(), own);
  for (std::size_t w = 0; w < whole.size(); ++w) {
    std::vector<std::uint8_t> bytes;
    for (const double s : whole[w]) bytes.push_back(static_cast<std::uint8_t>(s));
    file.file()->put(StateWriter<D>::key("", w, "status"), bytes);
  }
}

/// A number that differs where any centre or volume of the uncut blocks does, however they are cut.
/// comm collective
template <int D>
std::int64_t grid_digest(const Stepper<D>& stepper) {
  const Layout<D>& layout = stepper.exchange().layout();
  const std::vector<std::size_t> mine = layout.owners.mine();
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < mine.size(); ++i) {
    const Block<D>& block = stepper.blocks()[i];
    for_each_index<D>({}, block.extent.n, [&](const std::array<int, D>& index) {
      const auto c = static_cast<std::size_t>(block.extent.at(index));
      std::uint64_t hash = 1469598103934665603ULL + layout.part[mine[i]].whole;  // FNV-1a, a word a time
      const auto mix = [&](double value) {
        std::uint64_t bits = 0;
        std::memcpy(&bits, &value, sizeof bits);
        hash = (hash ^ bits ^ (bits >> 29)) * 1099511628211ULL;
      };
      for (std::size_t k = 0; k < D; ++k) mix(block.centre[k][c]);
      mix(block.volume[c]);
      sum += hash ^ (hash >> 32);
    });
  }
  std::uint64_t total = 0;
  for (const std::uint64_t part : layout.owners.ranks.gather(std::vector<std::uint64_t>{sum})) total += part;
  return static_cast<std::int64_t>(total);
}

}  // namespace

template <int D>
void write_checkpoint(const std::string& path, const Stepper<D>& stepper, std::int64_t window,
                      const support::Scene& scene, const std::function<void(StateWriter<D>&)>& more) {
  StateWriter<D> file(path, stepper.exchange().layout());
  const auto memory = stepper.memory();
  file.put("program", std::string("fv_solver"));
  file.put("scene", scene.restart_digest);
  file.put("blocks", static_cast<std::int64_t>(stepper.exchange().layout().whole.size()));
  file.put("grid", grid_digest(stepper));
  file.put("window", window);
  file.put("time", memory.time);
  file.put("known", static_cast<std::int64_t>(memory.known));
  file.put("steps", static_cast<std::int64_t>(memory.steps));
  file.put("dt", std::vector<double>(memory.dt.begin(), memory.dt.end()));
  const auto put = [&](const std::string& in, const std::string& name, auto&& field_of) {
    std::vector<const Field*> own;
    for (std::size_t b = 0; b < stepper.blocks().size(); ++b) own.push_back(&field_of(b));
    file.put_fields(in, name, own);
  };
  put_statuses<D>(file, stepper.blocks());
  for (std::size_t level = 0; level < memory.level.size(); ++level) {
    const auto& states = memory.level[level];
    put(group(level), "p", [&](std::size_t b) -> const Field& { return states[b].p; });
    for (std::size_t k = 0; k < D; ++k)
      put(group(level), component(k), [&](std::size_t b) -> const Field& { return states[b].u[k]; });
    if (stepper.surface() != nullptr && level < memory.surface.phi.size())
      put(group(level), "phi", [&](std::size_t b) -> const Field& { return memory.surface.phi[level][b]; });
  }
  if (stepper.surface() != nullptr)
    file.put("water", std::vector<double>{memory.surface.budget.volume, memory.surface.budget.inflow,
                                          memory.surface.budget.error, memory.surface.rate});
  if (more) more(file);
  file.commit();
}

template <int D>
std::int64_t read_checkpoint(const std::string& path, Stepper<D>& stepper, const support::Scene& scene) {
  const support::CheckpointReader file(path);
  if (file.text("program") != "fv_solver")
    throw ConfigError(path + ": a checkpoint of " + file.text("program") + ", not of fv_solver");
  if (file.text("scene") != scene.restart_digest)
    throw ConfigError(path + ": a checkpoint of another scene; only title, time and deadline may differ");
  const Layout<D>& layout = stepper.exchange().layout();
  if (file.integer("blocks") != static_cast<std::int64_t>(layout.whole.size()))
    throw ConfigError(path + ": a checkpoint of " + std::to_string(file.integer("blocks")) +
                      " blocks; the grid of this run has " + std::to_string(layout.whole.size()));
  if (file.integer("grid") != grid_digest(stepper))
    throw ConfigError(path +
                      ": a checkpoint on another grid: the cells of this run's blocks lie elsewhere; restart "
                      "with the blocks, rings, plates and grid files it was written with");
  typename Stepper<D>::Memory memory;
  memory.time = file.number("time");
  memory.known = static_cast<int>(file.integer("known"));
  memory.steps = file.integer("steps");
  const auto some = [&](const std::string& name, std::size_t n) {
    std::vector<double> values = file.doubles(name);
    if (values.size() != n)
      throw IoError(path + ": " + name + " has " + std::to_string(values.size()) + " values, not " +
                    std::to_string(n));
    return values;
  };
  const std::vector<double> dt = some("dt", memory.dt.size());
  std::copy(dt.begin(), dt.end(), memory.dt.begin());
  const std::vector<std::size_t> mine = layout.owners.mine();
  for (auto& level : memory.level) level.resize(mine.size());
  double other_overlap = 0.0;  // cells that were interpolated and are not, or the other way round
  for (std::size_t i = 0; i < mine.size(); ++i) {
    Block<D>& block = stepper.blocks()[i];
    const std::size_t whole = layout.part[mine[i]].whole;
    const auto read = [&](std::size_t level, const std::string& name) {
      return part_of<D>(layout, mine[i], file.doubles(StateWriter<D>::key(group(level), whole, name)));
    };
    const std::string name = StateWriter<D>::key("", whole, "status");
    const auto status = file.has(name) ? file.bytes(name) : std::vector<std::uint8_t>();
    if (status.size() != Extent<D>(layout.whole[whole].cells).size)
      throw ConfigError(path + ": block '" + block.name + "' has other cells than the grid of this run");
    const Field own = part_of<D>(layout, mine[i], Field(status.begin(), status.end()));
    for_each_index<D>({}, block.extent.n, [&](const std::array<int, D>& index) {
      const auto c = static_cast<std::size_t>(block.extent.at(index));
      const auto then = static_cast<CellStatus>(static_cast<int>(own[c]));
      // as assembled, before a region is carved out; the file has them as the region left them
      const CellStatus now = block.status[c];
      const bool lost = then == CellStatus::interpolated && now != CellStatus::interpolated;
      const bool gained = now == CellStatus::interpolated && then == CellStatus::computed;
      other_overlap += lost || gained ? 1.0 : 0.0;
      block.status[c] = then;
    });
    set_solved_mask(block);
    for (std::size_t level = 0; level < memory.level.size(); ++level) {
      State<D>& q = memory.level[level][i];
      q.p = read(level, "p");
      for (std::size_t k = 0; k < D; ++k) q.u[k] = read(level, component(k));
    }
    for (std::size_t level = 0; level < memory.surface.phi.size() && stepper.surface() != nullptr; ++level) {
      memory.surface.phi[level].resize(mine.size());
      memory.surface.phi[level][i] = read(level, "phi");
    }
  }
  other_overlap = layout.owners.ranks.sum(other_overlap);
  if (other_overlap > 0.0)
    throw ConfigError(path + ": a checkpoint of another overlap: " +
                      std::to_string(static_cast<std::int64_t>(other_overlap)) +
                      " cells are interpolated in one and not in the other; restart with the same `overset`");
  if (stepper.surface() != nullptr) {
    const std::vector<double> water = some("water", 4);
    memory.surface.budget = {water[0], water[1], water[2], 0.0};
    memory.surface.rate = water[3];
  }
  stepper.recall(memory);
  return file.integer("window");
}

template void write_checkpoint<2>(const std::string&, const Stepper<2>&, std::int64_t, const support::Scene&,
                                  const std::function<void(StateWriter<2>&)>&);
template void write_checkpoint<3>(const std::string&, const Stepper<3>&, std::int64_t, const support::Scene&,
                                  const std::function<void(StateWriter<3>&)>&);
template std::int64_t read_checkpoint<2>(const std::string&, Stepper<2>&, const support::Scene&);
template std::int64_t read_checkpoint<3>(const std::string&, Stepper<3>&, const support::Scene&);

}  // namespace littoral::fv
