#include "littoral/support/both_files.hpp"

#include <map>

#include "littoral/error.hpp"

namespace littoral::support {
namespace {

/// The scene's constants alone, where they are sound: without them the other file's formulas mean nothing.
bool read_constants(const std::string& path, const std::vector<std::string>& settings,
                    std::map<std::string, double>& constants) {
  Document document = Document::from_file(path);
  for (const auto& setting : settings) document.set(setting);
  Binder binder(document);
  binder.numbers("constants", "", constants);
  return binder.sound({"constants"});
}

}  // namespace

Scene read_both_files(const Document& own, const std::vector<std::string>& settings,
                      const std::function<void(Binder&, const Scene&)>& bind_own) {
  std::string name = "scene.yaml";
  Binder first(own);
  first.key("scene", name).doc("The scene's file, relative to this one.");
  const std::string path = own.resolve(name);
  Scene scene;
  std::string problems;
  try {
    scene = Scene::from_file(path, settings);
  } catch (const ConfigError& error) {
    problems = error.what();
    if (!read_constants(path, settings, scene.constants)) throw;
  }
  Binder binder(own);
  binder.use_constants(scene.constants);
  bind_own(binder, scene);
  for (const std::string& line : binder.problems()) problems += (problems.empty() ? "" : "\n") + line;
  if (!problems.empty()) throw ConfigError(problems);
  return scene;
}

}  // namespace littoral::support
