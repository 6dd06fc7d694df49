// What a declaration does when it is complete: reads and checks, or writes its line.
#include <cmath>

#include "binder_impl.hpp"
#include "littoral/error.hpp"
#include "numbers.hpp"

namespace littoral::support {

std::string Binder::Key::Impl::range() const {
  std::string out;
  const auto add = [&out](const std::string& sign, const std::optional<double>& bound) {
    if (bound) out += (out.empty() ? "" : " and ") + sign + " " + format_number(*bound);
  };
  add(">=", lowest);
  add(">", above);
  add("<=", highest);
  add("<", below);
  return out;
}

void Binder::Key::Impl::check_range(const Value& value) {
  for (const double number : numbers()) {
    if (std::isinf(number) && !infinite)
      throw BadValue{"is " + value.description() + "; expected a finite number"};
    const bool good = (!lowest || number >= *lowest) && (!above || number > *above) &&
                      (!highest || number <= *highest) && (!below || number < *below);
    if (!good)
      throw BadValue{"is " + format_number(number) + (unit.empty() || unit == "-" ? "" : " " + unit) +
                     "; expected a value " + range()};
  }
}

void Binder::Key::Impl::read_value() {
  const Value* value = binder->declare(name);
  const std::string path = binder->path_of(name);
  if (!value) {
    if (required) binder->report_missing(name, type);
    return;
  }
  try {
    read(*value);
    check_range(*value);
  } catch (const BadValue& bad) {
    binder->report(value->place, path, "'" + path + "' " + bad.text + ".");
  } catch (const ConfigError& bad) {  // of a formula
    binder->report(value->place, path, "'" + path + "': " + bad.what());
  }
}

void Binder::Key::Impl::close(const std::string& sentence) {
  closed = true;
  if (binder->mode == Mode::read) return read_value();
  binder->declare(name);
  const std::string dimension = unit.empty() ? "" : "[" + unit + "]";
  if (binder->mode == Mode::resolved) {
    const std::string value = show();
    if (!value.empty()) binder->write_key(name, value, dimension);
    return;
  }
  std::string comment = dimension;
  const auto add = [&comment](const std::string& part) {
    if (!part.empty()) comment += (comment.empty() ? "" : ", ") + part;
  };
  add(type);
  add(range());
  if (required) add("required");
  if (!sentence.empty()) comment += ". " + sentence;
  binder->write_key(name, required ? "" : show(), comment);
}

Binder::Key& Binder::Key::unit(const std::string& text) { return impl_->unit = text, *this; }
Binder::Key& Binder::Key::required() { return impl_->required = true, *this; }
Binder::Key& Binder::Key::min(double lowest) { return impl_->lowest = lowest, *this; }
Binder::Key& Binder::Key::exclusive_min(double bound) { return impl_->above = bound, *this; }
Binder::Key& Binder::Key::max(double highest) { return impl_->highest = highest, *this; }
Binder::Key& Binder::Key::exclusive_max(double bound) { return impl_->below = bound, *this; }
Binder::Key& Binder::Key::may_be_infinite() { return impl_->infinite = true, *this; }
Binder::Key& Binder::Key::doc(const std::string& sentence) { return impl_->close(sentence), *this; }

}  // namespace littoral::support
