// The types a key can have: each as a reader, a text and the numbers its range concerns.
#include <algorithm>
#include <cmath>

#include "binder_impl.hpp"
#include "littoral/error.hpp"
#include "nearest.hpp"
#include "numbers.hpp"

namespace littoral::support {
namespace {

const std::string& scalar(const Value& value, const std::string& type) {
  if (value.kind != Value::Kind::scalar) throw BadValue{"is " + value.description() + "; expected " + type};
  return value.text;
}

/// Formula of constants, as `4*dx`; nothing where it is no formula or depends on x, y, z, t.
std::optional<double> constant_formula(const std::string& text,
                                       const std::map<std::string, double>& constants) {
  try {
    const Formula formula(text, constants);
    if (!formula.is_constant()) return std::nullopt;
    const double number = formula(0, 0, 0, 0);
    return std::isfinite(number) ? std::optional<double>(number) : std::nullopt;
  } catch (const ConfigError&) {
    return std::nullopt;
  }
}

double to_double(const Value& value, const std::map<std::string, double>& constants) {
  const std::string& text = scalar(value, "a number");
  if (const auto number = parse_number(text)) return *number;
  if (text == ".nan" || text == ".NaN" || text == ".NAN") throw BadValue{"is not a number (.nan)"};
  const bool infinity = text == "inf" || text == "infinity" || text == "Infinity";
  if (!infinity && !text.empty())
    if (const auto number = constant_formula(text, constants)) return *number;
  std::string names;
  for (const auto& constant : constants) names += (names.empty() ? "" : ", ") + constant.first;
  throw BadValue{"is " + value.description() + "; expected a number" +
                 (names.empty() ? "" : ", or a formula of the constants " + names) +
                 (infinity ? " (infinity is .inf)" : "")};
}

int to_int(const Value& value, const std::map<std::string, double>& constants) {
  const std::string& text = scalar(value, "a whole number");
  const auto plain = parse_number(text);
  const auto number = plain ? plain : constant_formula(text, constants);
  // a formula may miss a whole number by its round-off; a plain number may not
  const double slack = plain ? 0.0 : 1e-9;
  if (!number || std::abs(*number - std::round(*number)) > slack * std::max(1.0, std::abs(*number)) ||
      std::abs(*number) > 2147483647.0)
    throw BadValue{"is " + value.description() + "; expected a whole number"};
  return static_cast<int>(std::lround(*number));
}

bool to_bool(const Value& value) {
  const std::string& text = scalar(value, "true or false");
  if (text == "true" || text == "yes" || text == "on") return true;
  if (text == "false" || text == "no" || text == "off") return false;
  throw BadValue{"is " + value.description() + "; expected true or false"};
}

Formula to_formula(const Value& value, const std::map<std::string, double>& constants) {
  return Formula(scalar(value, "a number or a formula of x, y, z, t"), constants);
}

const std::vector<Value>& list_of(const Value& value, const std::string& type, std::size_t size = 0) {
  if (value.kind != Value::Kind::list || (size > 0 && value.items.size() != size))
    throw BadValue{"is " + value.description() + "; expected " + type};
  return value.items;
}

std::string show(double value) { return format_number(value); }
std::string show(int value) { return std::to_string(value); }
std::string show(const std::string& value) { return quoted(value); }
std::string show(const Formula& value) {
  return parse_number(value.text()) ? value.text() : quoted(value.text());
}
template <class Items>
std::string show_list(const Items& items) {
  std::string out;
  for (const auto& item : items) out += (out.empty() ? "" : ", ") + show(item);
  return "[" + out + "]";
}

int to_choice(const Value& value, const std::vector<std::pair<std::string, int>>& words) {
  std::vector<std::string> names;
  for (const auto& word : words) names.push_back(word.first);
  const std::string& text = scalar(value, "one of " + joined(names));
  for (const auto& word : words)
    if (word.first == text) return word.second;
  const std::string guess = nearest(text, names);
  throw BadValue{"is " + value.description() + "; expected one of " + joined(names) +
                 (guess.empty() ? "" : ". Did you mean '" + guess + "'?")};
}

std::string word_of(int value, const std::vector<std::pair<std::string, int>>& words) {
  for (const auto& word : words)
    if (word.second == value) return word.first;
  return "";
}

std::string alternatives(const std::vector<std::pair<std::string, int>>& words) {
  std::string out;
  for (const auto& word : words) out += (out.empty() ? "" : " | ") + word.first;
  return out;
}

}  // namespace

// Begins a Key; the lambdas refer to the member that the caller keeps alive until doc().
#define LITTORAL_KEY(TYPE)                   \
  Key key;                                   \
  key.impl_ = std::make_shared<Key::Impl>(); \
  Key::Impl& k = *key.impl_;                 \
  k.binder = impl_.get();                    \
  k.name = name;                             \
  k.type = TYPE

Binder::Key Binder::key(const std::string& name, double& value) {
  LITTORAL_KEY("a number");
  k.read = [&value, this](const Value& v) { value = to_double(v, impl_->constants); };
  k.show = [&value] { return show(value); };
  k.numbers = [&value] { return std::vector<double>{value}; };
  return key;
}

Binder::Key Binder::key(const std::string& name, int& value) {
  LITTORAL_KEY("a whole number");
  k.read = [&value, this](const Value& v) { value = to_int(v, impl_->constants); };
  k.show = [&value] { return show(value); };
  k.numbers = [&value] { return std::vector<double>{static_cast<double>(value)}; };
  return key;
}

Binder::Key Binder::key(const std::string& name, bool& value) {
  LITTORAL_KEY("true | false");
  k.read = [&value](const Value& v) { value = to_bool(v); };
  k.show = [&value] { return std::string(value ? "true" : "false"); };
  return key;
}

Binder::Key Binder::key(const std::string& name, std::string& value) {
  LITTORAL_KEY("a text");
  k.read = [&value](const Value& v) { value = scalar(v, "a text"); };
  k.show = [&value] { return show(value); };
  return key;
}

Binder::Key Binder::key(const std::string& name, std::array<double, 3>& value) {
  LITTORAL_KEY("three numbers [x, y, z]");
  k.read = [&value, this, type = k.type](const Value& v) {
    const auto& items = list_of(v, type, 3);
    for (std::size_t d = 0; d < 3; ++d) value[d] = to_double(items[d], impl_->constants);
  };
  k.show = [&value] { return show_list(value); };
  k.numbers = [&value] { return std::vector<double>(value.begin(), value.end()); };
  return key;
}

Binder::Key Binder::key(const std::string& name, std::array<int, 3>& value) {
  LITTORAL_KEY("three whole numbers [x, y, z]");
  k.read = [&value, this, type = k.type](const Value& v) {
    const auto& items = list_of(v, type, 3);
    for (std::size_t d = 0; d < 3; ++d) value[d] = to_int(items[d], impl_->constants);
  };
  k.show = [&value] { return show_list(value); };
  k.numbers = [&value] { return std::vector<double>(value.begin(), value.end()); };
  return key;
}

Binder::Key Binder::key(const std::string& name, std::vector<double>& value) {
  LITTORAL_KEY("a list of numbers");
  k.read = [&value, this, type = k.type](const Value& v) {
    value.clear();
    for (const auto& item : list_of(v, type)) value.push_back(to_double(item, impl_->constants));
  };
  k.show = [&value] { return show_list(value); };
  k.numbers = [&value] { return value; };
  return key;
}

Binder::Key Binder::key(const std::string& name, std::vector<std::string>& value) {
  LITTORAL_KEY("a list of texts");
  k.read = [&value, type = k.type](const Value& v) {
    value.clear();
    for (const auto& item : list_of(v, type)) value.push_back(scalar(item, "a text"));
  };
  k.show = [&value] { return show_list(value); };
  return key;
}

Binder::Key Binder::key(const std::string& name, Formula& value) {
  LITTORAL_KEY("a number or a formula of x, y, z, t");
  k.read = [&value, this](const Value& v) { value = to_formula(v, impl_->constants); };
  k.show = [&value] { return show(value); };
  k.numbers = [&value] {
    return value.is_constant() ? std::vector<double>{value(0, 0, 0, 0)} : std::vector<double>{};
  };
  return key;
}

Binder::Key Binder::key(const std::string& name, std::optional<double>& value) {
  LITTORAL_KEY("a number or auto");
  k.read = [&value, this](const Value& v) {
    value.reset();
    const bool none = v.kind == Value::Kind::null || (v.kind == Value::Kind::scalar && v.text == "auto");
    if (!none) value = to_double(v, impl_->constants);
  };
  k.show = [&value] { return value ? show(*value) : std::string("auto"); };
  k.numbers = [&value] { return value ? std::vector<double>{*value} : std::vector<double>{}; };
  return key;
}

Binder::Key Binder::key(const std::string& name, std::optional<Formula>& value) {
  LITTORAL_KEY("a number or a formula of x, y, z, t; may be left out");
  k.read = [&value, this](const Value& v) {
    value.reset();
    if (v.kind != Value::Kind::null) value = to_formula(v, impl_->constants);
  };
  k.show = [&value] { return value ? show(*value) : std::string(); };
  return key;
}

Binder::Key Binder::choice_impl(const std::string& name, int current,
                                const std::vector<std::pair<std::string, int>>& words,
                                const std::function<void(int)>& assign) {
  LITTORAL_KEY(alternatives(words));
  k.read = [words, assign](const Value& v) { assign(to_choice(v, words)); };
  k.show = [words, current] { return word_of(current, words); };
  return key;
}

Binder::Key Binder::choices_impl(const std::string& name, std::array<int, 2> current,
                                 const std::vector<std::pair<std::string, int>>& words,
                                 const std::function<void(std::array<int, 2>)>& assign) {
  LITTORAL_KEY("[lower, upper], each " + alternatives(words));
  k.read = [words, assign, type = k.type](const Value& v) {
    if (v.kind == Value::Kind::scalar) {
      const int both = to_choice(v, words);
      return assign(std::array<int, 2>{both, both});
    }
    const auto& items = list_of(v, type, 2);
    assign(std::array<int, 2>{to_choice(items[0], words), to_choice(items[1], words)});
  };
  k.show = [words, current] {
    return "[" + word_of(current[0], words) + ", " + word_of(current[1], words) + "]";
  };
  return key;
}

#undef LITTORAL_KEY

void Binder::numbers(const std::string& name, const std::string& doc, std::map<std::string, double>& values) {
  const Value* value = impl_->declare(name);
  const std::string path = impl_->path_of(name);
  if (impl_->mode == Mode::help) {
    impl_->write(name + ": {}  # names and numbers. " + doc);
    return;
  }
  if (impl_->mode == Mode::resolved) {
    impl_->write(name + ":" + (values.empty() ? " {}" : ""));
    impl_->indent += 2;
    for (const auto& [entry, number] : values) impl_->write(entry + ": " + format_number(number));
    impl_->indent -= 2;
    return;
  }
  if (!value || value->kind == Value::Kind::null) return;
  if (value->kind != Value::Kind::map) {
    impl_->report(value->place, path,
                  "'" + path + "' is a map of names and numbers; found " + value->description() + ".");
    return;
  }
  std::map<std::string, double> names = impl_->constants;
  for (const auto& [entry, content] : value->entries) {
    const std::string full = path + "." + entry;
    const bool word =
        !entry.empty() && !(entry[0] >= '0' && entry[0] <= '9') &&
        entry.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_") ==
            std::string::npos;
    const bool taken = entry == "x" || entry == "y" || entry == "z" || entry == "t" || entry == "pi" ||
                       entry == "e" || impl_->constants.count(entry) > 0;
    if (!word || taken) {
      impl_->report(content.place, full,
                    "'" + full + "': " +
                        (word ? "this name is already taken." : "a name has letters, digits and _ only."));
      continue;
    }
    try {
      const Formula formula = to_formula(content, names);
      if (!formula.is_constant()) throw BadValue{"depends on x, y, z or t; expected a number"};
      const double number = formula(0, 0, 0, 0);
      if (!std::isfinite(number))
        throw BadValue{"is " + format_number(number) + "; expected a finite number"};
      values[entry] = names[entry] = number;
    } catch (const BadValue& bad) {
      impl_->report(content.place, full, "'" + full + "' " + bad.text + ".");
    } catch (const ConfigError& bad) {
      impl_->report(content.place, full, "'" + full + "': " + bad.what());
    }
  }
  if (name == "constants") impl_->constants.insert(values.begin(), values.end());
}

}  // namespace littoral::support
