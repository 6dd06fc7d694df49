// Maps of free names to numbers, as `constants:`.
#include <cmath>

#include "binder_impl.hpp"
#include "littoral/error.hpp"
#include "numbers.hpp"

namespace littoral::support {
namespace {

Formula of_constants(const Value& value, const std::map<std::string, double>& constants) {
  if (value.kind != Value::Kind::scalar)
    throw BadValue{"is " + value.description() +
                   "; expected a number or a formula of the constants before it"};
  return Formula(value.text, constants);
}

}  // namespace

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
      const Formula formula = of_constants(content, names);
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
