#include <algorithm>

#include "binder_impl.hpp"
#include "littoral/error.hpp"
#include "nearest.hpp"
#include "numbers.hpp"

namespace littoral::support {

std::string Binder::Impl::path_of(const std::string& name) const {
  const std::string& section = frames.back().path;
  return section.empty() ? name : section + "." + name;
}

const Value* Binder::Impl::declare(const std::string& name) {
  auto& names = known[frames.back().path];
  if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  const Value* section = frames.back().value;
  return section && section->kind == Value::Kind::map ? section->find(name) : nullptr;
}

void Binder::Impl::report(const Place& place, const std::string& path, const std::string& text) {
  problems.push_back({place, text});
  faulty.insert(path);
}

void Binder::Impl::report_missing(const std::string& name, const std::string& expected) {
  const Place place = place_of(document->impl->root, path_of(name));
  report(place, path_of(name), "key '" + path_of(name) + "' is missing; expected " + expected + ".");
}

void Binder::Impl::find_unknown(const Value& map, const std::string& path, std::vector<Problem>& out) const {
  const auto names = known.find(path);
  if (names == known.end() || map.kind != Value::Kind::map) return;
  for (const auto& [name, value] : map.entries) {
    const std::string full = path.empty() ? name : path + "." + name;
    if (std::find(names->second.begin(), names->second.end(), name) != names->second.end()) {
      find_unknown(value, full, out);
      for (std::size_t i = 0; i < value.items.size(); ++i)
        find_unknown(value.items[i], full + "[" + std::to_string(i) + "]", out);
      continue;
    }
    std::string guess = nearest(name, names->second);
    if (!guess.empty()) guess = path.empty() ? guess : path + "." + guess;
    if (guess.empty())  // rightly spelt, but in the wrong section?
      for (const auto& [section, keys] : known)
        if (guess.empty() && section.find('[') == std::string::npos &&
            std::find(keys.begin(), keys.end(), name) != keys.end())
          guess = section.empty() ? name : section + "." + name;
    out.push_back({value.place, "unknown key '" + full + "'." +
                                    (guess.empty() ? "" : " Did you mean '" + guess + "'?") +
                                    " Known keys: " + joined(names->second) + "."});
  }
}

std::vector<Problem> Binder::Impl::unknown_keys() const {
  std::vector<Problem> out;
  if (document) find_unknown(document->impl->root, "", out);
  return out;
}

Binder::Binder(const Document& document) : impl_(std::make_unique<Impl>(Mode::read)) {
  impl_->document = document;
  impl_->frames.back().value = &document.impl->root;
  impl_->problems = document.impl->problems;
}

Binder::Binder(Mode mode) : impl_(std::make_unique<Impl>(mode)) {
  if (mode == Mode::read) throw Error("Binder: reading needs a document");
}

Binder::~Binder() = default;
Binder::Mode Binder::mode() const { return impl_->mode; }

void Binder::section(const std::string& name, const std::string& doc, const std::function<void()>& body,
                     bool* present) {
  const Value* value = impl_->declare(name);
  if (impl_->mode == Mode::read) {
    if (present) *present = value != nullptr;
    if (!value && present) return;
    if (value && value->kind != Value::Kind::map && value->kind != Value::Kind::null) {
      impl_->report(
          value->place, impl_->path_of(name),
          "'" + impl_->path_of(name) + "' is a section of keys; found " + value->description() + ".");
      return;
    }
    impl_->frames.push_back({impl_->path_of(name), value});
    body();
    impl_->frames.pop_back();
    return;
  }
  if (impl_->mode == Mode::resolved && present && !*present) return;
  const bool help = impl_->mode == Mode::help;
  const std::string comment = help ? "  # " + doc + (present ? " (may be left out)" : "") : "";
  impl_->write(name + ":" + comment);
  const std::size_t header = impl_->lines.size() - 1;
  impl_->frames.push_back({impl_->path_of(name), nullptr});
  impl_->indent += 2;
  body();
  impl_->indent -= 2;
  impl_->frames.pop_back();
  if (impl_->lines.size() == header + 1) impl_->lines[header] += " {}";
}

void Binder::list_impl(const std::string& name, const std::string& doc, std::size_t size,
                       const std::function<void(std::size_t)>& resize,
                       const std::function<void(std::size_t)>& bind_item) {
  const Value* value = impl_->declare(name);
  const std::string path = impl_->path_of(name);
  const auto bind = [&](std::size_t i, const Value* item) {
    impl_->frames.push_back({path + "[" + std::to_string(i) + "]", item});
    impl_->known[impl_->frames.back().path];  // an item without declared keys refuses all
    bind_item(i);
    impl_->frames.pop_back();
  };
  if (impl_->mode == Mode::read) {
    if (!value || value->kind == Value::Kind::null) return;
    if (value->kind != Value::Kind::list) {
      impl_->report(value->place, path,
                    "'" + path + "' is a list, one '- ' an item; found " + value->description() + ".");
      return;
    }
    resize(0);  // items of the defaults must not show through
    resize(value->items.size());
    for (std::size_t i = 0; i < value->items.size(); ++i) {
      const Value& item = value->items[i];
      if (item.kind == Value::Kind::map || item.kind == Value::Kind::null)
        bind(i, &item);
      else
        impl_->report(item.place, path + "[" + std::to_string(i) + "]",
                      "an item of '" + path + "' is a section of keys; found " + item.description() + ".");
    }
    return;
  }
  const bool help = impl_->mode == Mode::help;
  if (!help && size == 0) return impl_->write(name + ": []");
  impl_->write(name + ":" + (help ? "  # list. " + doc : ""));
  if (help) resize(std::max<std::size_t>(size, 1));
  impl_->indent += 4;
  for (std::size_t i = 0; i < (help ? 1 : size); ++i) {
    impl_->at_dash = true;
    bind(i, nullptr);
    if (impl_->at_dash) impl_->write("{}");
  }
  impl_->indent -= 4;
  if (help) resize(size);
}

void Binder::check(bool holds, const std::string& name, const std::string& problem) {
  if (holds || impl_->mode != Mode::read || !sound({name})) return;
  impl_->report(place_of(impl_->document->impl->root, name), name, "'" + name + "': " + problem);
}

bool Binder::sound(const std::vector<std::string>& paths) const {
  for (const auto& path : paths)
    for (const auto& bad : impl_->faulty) {
      const auto& outer = bad.size() < path.size() ? bad : path;
      const auto& inner = bad.size() < path.size() ? path : bad;
      const bool within =
          inner.compare(0, outer.size(), outer) == 0 &&
          (inner.size() == outer.size() || inner[outer.size()] == '.' || inner[outer.size()] == '[');
      if (within) return false;
    }
  return true;
}

bool Binder::given(const std::string& path) const {
  if (impl_->mode != Mode::read) return false;
  const Value* at = &impl_->document->impl->root;
  for (const PathStep& step : parse_path(path, "given")) {
    if (step.name.empty())
      at = step.index < at->items.size() ? &at->items[step.index] : nullptr;
    else
      at = at->find(step.name);
    if (!at) return false;
  }
  return at->kind != Value::Kind::null;
}

void Binder::use_constants(const std::map<std::string, double>& constants) {
  impl_->constants.insert(constants.begin(), constants.end());
}

std::vector<std::string> Binder::problems() {
  std::vector<Problem> all = impl_->problems;
  const std::vector<Problem> unknown = impl_->unknown_keys();
  all.insert(all.end(), unknown.begin(), unknown.end());
  std::stable_sort(all.begin(), all.end(),
                   [](const Problem& a, const Problem& b) { return a.place.order < b.place.order; });
  std::vector<std::string> out;
  for (const auto& problem : all) out.push_back(problem.place.text + ": " + problem.text);
  return out;
}

void Binder::finish() {
  std::string message;
  for (const auto& line : problems()) message += (message.empty() ? "" : "\n") + line;
  if (!message.empty()) throw ConfigError(message);
}

}  // namespace littoral::support
