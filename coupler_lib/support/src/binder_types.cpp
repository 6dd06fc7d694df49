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

/// The lambdas of a key refer to the member that the caller keeps alive until doc().
Binder::Key Binder::begin(const std::string& name, const std::string& type) {
  Key key;
  key.impl_ = std::make_shared<Key::Impl>();
  key.impl_->binder = impl_.get();
  key.impl_->name = name;
  key.impl_->type = type;
  return key;
}

Binder::Key Binder::key(const std::string& name, double& value) {
  Key key = begin(name, "a number");
  Key::Impl& k = *key.impl_;
  k.read = [&value, this](const Value& v) { value = to_double(v, impl_->constants); };
  k.show = [&value] { return show(value); };
  k.numbers = [&value] { return std::vector<double>{value}; };
  return key;
}

Binder::Key Binder::key(const std::string& name, int& value) {
  Key key = begin(name, "a whole number");
  Key::Impl& k = *key.impl_;
  k.read = [&value, this](const Value& v) { value = to_int(v, impl_->constants); };
  k.show = [&value] { return show(value); };
  k.numbers = [&value] { return std::vector<double>{static_cast<double>(value)}; };
  return key;
}

Binder::Key Binder::key(const std::string& name, bool& value) {
  Key key = begin(name, "true | false");
  Key::Impl& k = *key.impl_;
  k.read = [&value](const Value& v) { value = to_bool(v); };
  k.show = [&value] { return std::string(value ? "true" : "false"); };
  return key;
}

Binder::Key Binder::key(const std::string& name, std::string& value) {
  Key key = begin(name, "a text");
  Key::Impl& k = *key.impl_;
  k.read = [&value](const Value& v) { value = scalar(v, "a text"); };
  k.show = [&value] { return show(value); };
  return key;
}

Binder::Key Binder::key(const std::string& name, std::array<double, 3>& value) {
  Key key = begin(name, "three numbers [x, y, z]");
  Key::Impl& k = *key.impl_;
  k.read = [&value, this, type = k.type](const Value& v) {
    const auto& items = list_of(v, type, 3);
    for (std::size_t d = 0; d < 3; ++d) value[d] = to_double(items[d], impl_->constants);
  };
  k.show = [&value] { return show_list(value); };
  k.numbers = [&value] { return std::vector<double>(value.begin(), value.end()); };
  return key;
}

Binder::Key Binder::key(const std::string& name, std::array<int, 3>& value) {
  Key key = begin(name, "three whole numbers [x, y, z]");
  Key::Impl& k = *key.impl_;
  k.read = [&value, this, type = k.type](const Value& v) {
    const auto& items = list_of(v, type, 3);
    for (std::size_t d = 0; d < 3; ++d) value[d] = to_int(items[d], impl_->constants);
  };
  k.show = [&value] { return show_list(value); };
  k.numbers = [&value] { return std::vector<double>(value.begin(), value.end()); };
  return key;
}

Binder::Key Binder::key(const std::string& name, std::vector<double>& value) {
  Key key = begin(name, "a list of numbers");
  Key::Impl& k = *key.impl_;
  k.read = [&value, this, type = k.type](const Value& v) {
    value.clear();
    for (const auto& item : list_of(v, type)) value.push_back(to_double(item, impl_->constants));
  };
  k.show = [&value] { return show_list(value); };
  k.numbers = [&value] { return value; };
  return key;
}

Binder::Key Binder::key(const std::string& name, std::vector<std::string>& value) {
  Key key = begin(name, "a list of texts");
  Key::Impl& k = *key.impl_;
  k.read = [&value, type = k.type](const Value& v) {
    value.clear();
    for (const auto& item : list_of(v, type)) value.push_back(scalar(item, "a text"));
  };
  k.show = [&value] { return show_list(value); };
  return key;
}

Binder::Key Binder::key(const std::string& name, Formula& value) {
  Key key = begin(name, "a number or a formula of x, y, z, t");
  Key::Impl& k = *key.impl_;
  k.read = [&value, this](const Value& v) { value = to_formula(v, impl_->constants); };
  k.show = [&value] { return show(value); };
  k.numbers = [&value] {
    return value.is_constant() ? std::vector<double>{value(0, 0, 0, 0)} : std::vector<double>{};
  };
  return key;
}

Binder::Key Binder::key(const std::string& name, std::optional<double>& value) {
  Key key = begin(name, "a number or auto");
  Key::Impl& k = *key.impl_;
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
  Key key = begin(name, "a number or a formula of x, y, z, t; may be left out");
  Key::Impl& k = *key.impl_;
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
  Key key = begin(name, alternatives(words));
  Key::Impl& k = *key.impl_;
  k.read = [words, assign](const Value& v) { assign(to_choice(v, words)); };
  k.show = [words, current] { return word_of(current, words); };
  return key;
}

Binder::Key Binder::choices_impl(const std::string& name, std::array<int, 2> current,
                                 const std::vector<std::pair<std::string, int>>& words,
                                 const std::function<void(std::array<int, 2>)>& assign) {
  Key key = begin(name, "[lower, upper], each " + alternatives(words));
  Key::Impl& k = *key.impl_;
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

}  // namespace littoral::support
