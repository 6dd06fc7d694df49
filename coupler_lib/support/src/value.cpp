#include "value.hpp"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <sstream>

#include "littoral/error.hpp"

namespace littoral::support {
namespace {

constexpr int k_max_depth = 64;              // an alias may contain itself
constexpr std::size_t k_max_nodes = 200000;  // aliases of aliases multiply

struct Converter {
  const std::string& source;
  const Place* fixed;  // of a setting: every part has the same place
  std::vector<Problem>& problems;
  std::size_t n_nodes = 0;

  Place place(const YAML::Node& node) const {
    if (fixed) return *fixed;
    const int line = node.Mark().line + 1;
    return {source + ":" + std::to_string(line), line};
  }

  Value convert(const YAML::Node& node, const Place& at, const std::string& path, int depth) {
    if (depth > k_max_depth || ++n_nodes > k_max_nodes)
      throw ConfigError(at.text + ": sections nested too deeply, or aliases (&, *) that repeat without end.");
    Value value;
    value.place = at;
    if (node.IsScalar()) {
      value.kind = Value::Kind::scalar;
      value.text = node.Scalar();
    } else if (node.IsSequence()) {
      value.kind = Value::Kind::list;
      std::size_t i = 0;
      for (const auto& item : node)
        value.items.push_back(convert(item, place(item), path + "[" + std::to_string(i++) + "]", depth + 1));
    } else if (node.IsMap()) {
      value.kind = Value::Kind::map;
      for (const auto& entry : node) add_entry(value, entry.first, entry.second, path, depth);
    }
    return value;
  }

  void add_entry(Value& map, const YAML::Node& key, const YAML::Node& content, const std::string& path,
                 int depth) {
    const Place at = place(key);
    if (!key.IsScalar()) throw ConfigError(at.text + ": a key must be a word.");
    const std::string name = key.Scalar();
    const std::string full = path.empty() ? name : path + "." + name;
    if (const Value* first = map.find(name)) {
      problems.push_back({at, "key '" + full + "' is given twice; first at " + first->place.text + "."});
      return;
    }
    Value value = convert(content, at, full, depth + 1);
    map.entries.emplace_back(name, std::move(value));
  }
};

/// YAML forbids tabs in the margin, but its parser then complains of something else.
bool tab_in_margin(const std::string& text) {
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t first = std::min(text.find_first_not_of(" \t", begin), text.size());
    if (text.find('\t', begin) < first) return true;
    begin = std::min(text.find('\n', first), text.size() - 1) + 1;
  }
  return false;
}

[[noreturn]] void refuse(const YAML::Exception& problem, const std::string& source,
                         const std::string& input) {
  std::string text = source;
  if (!problem.mark.is_null())
    text += ":" + std::to_string(problem.mark.line + 1) + ":" + std::to_string(problem.mark.column + 1);
  text += ": not valid YAML: " + problem.msg + ".";
  if (tab_in_margin(input)) text += " The file indents with tabs; use spaces.";
  throw ConfigError(text);
}

/// Hears the beginnings of documents and nothing else.
struct DocumentCounter : YAML::EventHandler {
  int count = 0;
  int line = 0;  // of the last beginning
  void OnDocumentStart(const YAML::Mark& mark) override {
    ++count;
    line = mark.line + 1;
  }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
  void OnAlias(const YAML::Mark&, YAML::anchor_t) override {}
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t, const std::string&) override {}
  void OnSequenceStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {}
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark&, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {
  }
  void OnMapEnd() override {}
};

/// The line where a second document begins, 0 if there is none. yaml-cpp's own LoadAll() never returns where
/// a comma or bracket too many follows the document: it finds empty documents there without end. So this
/// looks for a second one and no further.
int second_document(const std::string& text) {
  std::istringstream input(text);
  YAML::Parser parser(input);
  DocumentCounter counter;
  while (counter.count < 2 && parser.HandleNextDocument(counter)) {
  }
  return counter.count > 1 ? counter.line : 0;
}

}  // namespace

Value* Value::find(const std::string& name) {
  for (auto& entry : entries)
    if (entry.first == name) return &entry.second;
  return nullptr;
}

const Value* Value::find(const std::string& name) const { return const_cast<Value*>(this)->find(name); }

std::string Value::description() const {
  switch (kind) {
    case Kind::null:
      return "nothing";
    case Kind::list:
      return "a list of " + std::to_string(items.size());
    case Kind::map:
      return "a section";
    case Kind::scalar:
      break;
  }
  constexpr std::size_t k_shown = 60;
  return "'" + (text.size() > k_shown ? text.substr(0, k_shown) + "..." : text) + "'";
}

Value parse_yaml(const std::string& text, const std::string& source, std::vector<Problem>& problems) {
  try {
    if (const int line = second_document(text))
      throw ConfigError(
          source + ":" + std::to_string(line) +
          ": a second document begins here; expected one. A comma or bracket too many, or a line '---'?");
    Converter converter{source, nullptr, problems};
    return converter.convert(YAML::Load(text), {source, 0}, "", 0);
  } catch (const YAML::Exception& problem) {
    refuse(problem, source, text);
  }
}

Value parse_setting_value(const std::string& text, const Place& place) {
  try {
    if (second_document(text))
      throw ConfigError(place.text + ": the value is not valid YAML: a comma or bracket too many.");
    std::vector<Problem> problems;
    Converter converter{place.text, &place, problems};
    Value value = converter.convert(YAML::Load(text), place, "", 0);
    if (!problems.empty()) throw ConfigError(place.text + ": " + problems[0].text);
    return value;
  } catch (const YAML::Exception& problem) {
    throw ConfigError(place.text + ": the value is not valid YAML: " + problem.msg + ".");
  }
}

}  // namespace littoral::support
