#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "littoral/error.hpp"
#include "littoral/support/run_plan.hpp"
#include "mock.hpp"

namespace littoral::mock {

using namespace coupler;

namespace {

void play_scene(Script& s, const std::string& file, const std::vector<std::string>& settings) {
  s.scene = support::Scene::from_file(file, settings);
  const auto& scene = *s.scene;
  s.dimension = scene.dimension;
  s.deadline = scene.coupling.deadline;
  s.with_phi = support::level_set_crosses(scene);
  const auto& region = scene.regions.at(0);
  s.region = s.layers = {region.lower, region.upper};
  const double face = region.lower[2];
  s.layers.lower[2] = face - scene.coupling.blending_width - scene.coupling.driven_width;
  s.layers.upper[2] = face;
  // as much of the grid as the layers need, and the cells it takes from the particles
  s.grid = s.layers.grown(4.0 * s.spacing);
  s.grid.upper[2] = face + scene.coupling.fringe_layers * s.spacing;
}

}  // namespace

Script parse(int argc, char** argv) {
  Script s;
  std::string scene;
  std::vector<std::string> settings;
  const auto number = [](double& to) { return [&to](const std::string& text) { to = std::stod(text); }; };
  const auto integer = [](int& to) { return [&to](const std::string& text) { to = std::stoi(text); }; };
  const auto flag = [](bool& to) { return [&to](const std::string& text) { to = text == "yes"; }; };
  const auto word = [](std::string& to) { return [&to](const std::string& text) { to = text; }; };
  const std::map<std::string, std::function<void(const std::string&)>> options{
      {"--dimension", integer(s.dimension)},
      {"--spacing", number(s.spacing)},
      {"--with-phi", flag(s.with_phi)},
      {"--empty-rank", flag(s.last_rank_is_empty)},
      {"--split-z", flag(s.split_along_z)},
      {"--dt-stable", number(s.dt_stable)},
      {"--dt", number(s.dt)},
      {"--end", number(s.end)},
      {"--schedule", word(s.schedule)},
      {"--deadline", number(s.deadline)},
      {"--stop-at", integer(s.stop_at)},
      {"--region-changes-at", integer(s.region_changes_at)},
      {"--particles", flag(s.wants_particles)},
      {"--scene", word(scene)},
      {"--set", [&](const std::string& text) { settings.push_back(text.substr(text.find('.') + 1)); }},
      {"--tolerance", number(s.tolerance)},
      {"--entries", integer(s.entries)},
      {"--work", number(s.work)},
      {"--misbehave", word(s.misbehave)},
      {"--at", integer(s.at)},
      {"--delay", number(s.delay)}};
  for (int i = 1; i < argc; i += 2) {
    const auto option = options.find(argv[i]);
    if (option == options.end() || i + 1 == argc)
      throw ConfigError(std::string("mock: what is ") + argv[i] + "?");
    option->second(argv[i + 1]);
  }
  if (!scene.empty()) play_scene(s, scene, settings);
  return s;
}

RunPlan plan_of(const Script& script) {
  if (script.scene) return support::run_plan(*script.scene);
  RunPlan plan;
  for (const auto schedule :
       {Schedule::serial, Schedule::predicted, Schedule::iterated, Schedule::concurrent})
    if (script.schedule == name(schedule)) plan.schedule.schedule = schedule;
  plan.window.dt = script.dt;
  plan.end_time = script.end;
  plan.deadline = script.deadline;
  plan.with_phi = script.with_phi;
  return plan;
}

Contract contract_of(const Script& script) {
  if (script.scene) return script.scene->contract();
  Contract contract;
  contract.set("dimension", static_cast<double>(script.dimension)).set("fluid.density", 1000.0);
  const bool wrong = script.misbehave == "wrong-scene";
  contract.set("gravity.z", wrong ? -1.62 : -9.81).set("coupling.kind", wrong ? "forced" : "imposed");
  for (int i = 0; i < script.entries; ++i)
    contract.set("constants.number_" + std::to_string(i), static_cast<double>(i));
  return contract;
}

FlowState flow(const Script& script, const Vec3& x, double t) {
  FlowState state;
  if (script.scene) {
    const auto& initial = script.scene->initial;
    state.p = initial.p(x[0], x[1], x[2], t);
    state.u = {initial.u(x[0], x[1], x[2], t), initial.v(x[0], x[1], x[2], t),
               initial.w(x[0], x[1], x[2], t)};
    return state;
  }
  state.p = 3.0 + 2.0 * x[0] - 1.0 * x[1] - 9.81 * x[2] + 5.0 * t;
  state.u = {0.3 + 0.1 * x[2] - 0.2 * t, 0.02 * x[1], -0.1 + 0.1 * x[0] + 0.4 * t};
  state.phi = x[2] - 0.05 * x[0] - 0.2 - 0.1 * t;
  return state;
}

Box part_of(const Box& box, int rank, int size, const Script& script) {
  const int parts = script.last_rank_is_empty ? std::max(1, size - 1) : size;
  if (rank >= parts) return Box::nothing();
  const std::size_t axis = script.split_along_z ? 2 : 0;
  const double width = (box.upper[axis] - box.lower[axis]) / parts;
  Box part = box;
  part.lower[axis] = box.lower[axis] + width * rank;
  part.upper[axis] = rank + 1 == parts ? box.upper[axis] : part.lower[axis] + width;
  return part;
}

DonorPatch lattice(const Box& box, double spacing, int dimension) {
  DonorPatch patch;
  if (box.empty()) return patch;
  std::array<std::vector<double>, 3> centre;
  for (std::size_t d = 0; d < 3; ++d) {
    if (dimension == 2 && d == 1) {
      centre[d] = {0.0};
    } else {
      const auto first = static_cast<int>(std::ceil(box.lower[d] / spacing - 0.5 - 1e-9));
      for (int i = first; (i + 0.5) * spacing < box.upper[d] - 1e-9 * spacing; ++i)
        centre[d].push_back((i + 0.5) * spacing);
    }
    patch.n[d] = static_cast<int>(centre[d].size());
  }
  for (const double z : centre[2])
    for (const double y : centre[1])
      for (const double x : centre[0]) {
        patch.x.push_back(x);
        patch.y.push_back(y);
        patch.z.push_back(z);
      }
  patch.usable.assign(patch.x.size(), 1);
  return patch;
}

}  // namespace littoral::mock
