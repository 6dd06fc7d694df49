#include "io/checkpoint.hpp"

#include "grid/metrics.hpp"
#include "littoral/error.hpp"
#include "littoral/support/checkpoint.hpp"

namespace littoral::fv {
namespace {

std::string key(std::size_t level, std::size_t block, const std::string& field) {
  return "level" + std::to_string(level) + "/block" + std::to_string(block) + "/" + field;
}

}  // namespace

template <int D>
void write_checkpoint(const std::string& path, const Stepper<D>& stepper, std::int64_t window,
                      const support::Scene& scene,
                      const std::function<void(support::CheckpointWriter&)>& more) {
  support::CheckpointWriter file(path);
  const auto memory = stepper.memory();
  file.put("program", std::string("fv_solver"));
  file.put("scene", scene.restart_digest);
  file.put("window", window);
  file.put("time", memory.time);
  file.put("known", static_cast<std::int64_t>(memory.known));
  file.put("steps", static_cast<std::int64_t>(memory.steps));
  file.put("dt", std::vector<double>(memory.dt.begin(), memory.dt.end()));
  for (std::size_t b = 0; b < stepper.blocks().size(); ++b) {
    std::vector<std::uint8_t> status;
    for (const CellStatus s : stepper.blocks()[b].status) status.push_back(static_cast<std::uint8_t>(s));
    file.put("block" + std::to_string(b) + "/status", status);
    for (std::size_t level = 0; level < memory.level.size(); ++level) {
      file.put(key(level, b, "p"), memory.level[level][b].p);
      for (std::size_t k = 0; k < D; ++k)
        file.put(key(level, b, "u" + std::to_string(k)), memory.level[level][b].u[k]);
    }
  }
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
  typename Stepper<D>::Memory memory;
  memory.time = file.number("time");
  memory.known = static_cast<int>(file.integer("known"));
  memory.steps = file.integer("steps");
  const std::vector<double> dt = file.doubles("dt");
  for (std::size_t k = 0; k < memory.dt.size(); ++k) memory.dt[k] = dt[k];
  for (std::size_t b = 0; b < stepper.blocks().size(); ++b) {
    Block<D>& block = stepper.blocks()[b];
    const std::string name = "block" + std::to_string(b) + "/status";
    const auto status = file.has(name) ? file.bytes(name) : std::vector<std::uint8_t>();
    if (status.size() != block.extent.size)
      throw ConfigError(path + ": block '" + block.name + "' has other cells than the grid of this run");
    for (std::size_t c = 0; c < status.size(); ++c) block.status[c] = static_cast<CellStatus>(status[c]);
    set_solved_mask(block);
    for (std::size_t level = 0; level < memory.level.size(); ++level) {
      memory.level[level].resize(stepper.blocks().size());
      State<D>& q = memory.level[level][b];
      q.p = file.doubles(key(level, b, "p"));
      for (std::size_t k = 0; k < D; ++k) q.u[k] = file.doubles(key(level, b, "u" + std::to_string(k)));
    }
  }
  stepper.recall(memory);
  return file.integer("window");
}

template void write_checkpoint<2>(const std::string&, const Stepper<2>&, std::int64_t, const support::Scene&,
                                  const std::function<void(support::CheckpointWriter&)>&);
template void write_checkpoint<3>(const std::string&, const Stepper<3>&, std::int64_t, const support::Scene&,
                                  const std::function<void(support::CheckpointWriter&)>&);
template std::int64_t read_checkpoint<2>(const std::string&, Stepper<2>&, const support::Scene&);
template std::int64_t read_checkpoint<3>(const std::string&, Stepper<3>&, const support::Scene&);

}  // namespace littoral::fv
