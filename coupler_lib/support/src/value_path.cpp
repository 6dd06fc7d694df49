#include <algorithm>

#include "littoral/error.hpp"
#include "value.hpp"

namespace littoral::support {
namespace {

[[noreturn]] void malformed(const std::string& path, const std::string& where) {
  throw ConfigError(where + ": '" + path +
                    "' is not a key. Expected names joined by dots, as in time.end or " + "blocks[0].cells.");
}

}  // namespace

std::vector<PathStep> parse_path(const std::string& path, const std::string& where) {
  std::vector<PathStep> steps;
  std::size_t i = 0;
  while (i < path.size()) {
    if (path[i] == '[') {
      const std::size_t close = path.find(']', i);
      const std::string digits = close == std::string::npos ? "" : path.substr(i + 1, close - i - 1);
      const bool number =
          !digits.empty() && digits.size() < 9 &&
          std::all_of(digits.begin(), digits.end(), [](char c) { return c >= '0' && c <= '9'; });
      if (!number || steps.empty()) malformed(path, where);
      steps.push_back({"", static_cast<std::size_t>(std::stoul(digits))});
      i = close + 1;
      if (i < path.size() && path[i] != '.' && path[i] != '[') malformed(path, where);
    } else {
      if (path[i] == '.') {
        if (steps.empty()) malformed(path, where);
        ++i;
      }
      const std::size_t end = std::min(path.find_first_of(".[", i), path.size());
      if (end == i) malformed(path, where);
      steps.push_back({path.substr(i, end - i), 0});
      i = end;
    }
  }
  if (steps.empty()) malformed(path, where);
  return steps;
}

void put(Value& root, const std::string& path, Value value, const std::string& where) {
  Value* at = &root;
  for (const PathStep& step : parse_path(path, where)) {
    const auto wanted = step.name.empty() ? Value::Kind::list : Value::Kind::map;
    if (at->kind == Value::Kind::null) {
      at->kind = wanted;
      at->place = value.place;
    }
    if (at->kind != wanted)
      throw ConfigError(where + ": cannot reach '" + path + "': " + at->place.text + " has " +
                        at->description() + " on the way.");
    if (wanted == Value::Kind::list) {
      if (step.index > at->items.size())
        throw ConfigError(where + ": index " + std::to_string(step.index) + " in a list of " +
                          std::to_string(at->items.size()) + "; the next free one is " +
                          std::to_string(at->items.size()) + ".");
      if (step.index == at->items.size()) at->items.emplace_back();
      at = &at->items[step.index];
    } else if (Value* next = at->find(step.name)) {
      at = next;
    } else {
      at->entries.emplace_back(step.name, Value{});
      at = &at->entries.back().second;
      at->place = value.place;
    }
  }
  *at = std::move(value);
}

Place place_of(const Value& root, const std::string& path) {
  const Value* at = &root;
  Place place = root.place;
  for (const PathStep& step : parse_path(path, "check")) {
    if (step.name.empty())
      at = at->kind == Value::Kind::list && step.index < at->items.size() ? &at->items[step.index] : nullptr;
    else
      at = at->find(step.name);
    if (!at) break;
    place = at->place;
  }
  return place;
}

}  // namespace littoral::support
