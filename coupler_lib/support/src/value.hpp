#pragma once

#include <string>
#include <utility>
#include <vector>

namespace littoral::support {

/// Where a value stands: in the file at a line, or on the command line.
struct Place {
  std::string text;  // "scene.yaml:14", "scene.yaml", "--set time.cfl=2"
  int order = 0;     // sorts messages as the user reads the file; settings after it
};

struct Problem {
  Place place;
  std::string text;
};

/// One value of a document, with its place. Our own tree instead of the YAML library's: it keeps the order of
/// keys, sees keys given twice, and takes settings from the command line.
struct Value {
  enum class Kind { null, scalar, list, map };
  Kind kind = Kind::null;
  Place place;
  std::string text;                                    // of a scalar
  std::vector<Value> items;                            // of a list
  std::vector<std::pair<std::string, Value>> entries;  // of a map, in the order of the file

  Value* find(const std::string& name);
  const Value* find(const std::string& name) const;
  /// "a number-like text", for messages: what stands here instead of what is expected.
  std::string description() const;
};

/// Parses one YAML document. Keys given twice go to `problems` (the first stays); throws ConfigError where
/// the text is no YAML.
Value parse_yaml(const std::string& text, const std::string& source, std::vector<Problem>& problems);
/// The value of one setting; every part of it has the setting as its place.
Value parse_setting_value(const std::string& text, const Place& place);

/// A dotted path with list indices: "blocks[0].cells".
struct PathStep {
  std::string name;  // of a key; empty: an index
  std::size_t index = 0;
};
/// throws ConfigError if the path is malformed (`where` begins the message)
std::vector<PathStep> parse_path(const std::string& path, const std::string& where);
/// Puts a value at a path, making maps and one more list item on the way as needed; throws ConfigError.
void put(Value& root, const std::string& path, Value value, const std::string& where);
/// The place of a path, or of the deepest part of it that exists.
Place place_of(const Value& root, const std::string& path);

}  // namespace littoral::support
