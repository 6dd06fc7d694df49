#include "littoral/support/summary.hpp"

#include <cmath>
#include <functional>

#include "numbers.hpp"
#include "output_file.hpp"

namespace littoral::support {
namespace {

std::string number(double value) { return std::isfinite(value) ? format_number(value) : "null"; }

/// The members of an object or array, one a line.
template <class Items, class Line>
std::string lines(const Items& items, const Line& line) {
  std::string out;
  for (const auto& item : items) out += (out.empty() ? "\n    " : ",\n    ") + line(item);
  return out.empty() ? out : out + "\n  ";
}

}  // namespace

std::string Summary::json() const {
  const auto named_number = [](const auto& item) { return quoted(item.first) + ": " + number(item.second); };
  const auto named_text = [](const auto& item) { return quoted(item.first) + ": " + quoted(item.second); };
  const auto text = [](const std::string& item) { return quoted(item); };
  return "{\n  \"program\": " + quoted(program) + ",\n  \"version\": " + quoted(version) +
         ",\n  \"ranks\": " + std::to_string(ranks) + ",\n  \"threads\": " + std::to_string(threads) +
         ",\n  \"wall_time\": " + number(wall_time) + ",\n  \"phases\": {" + lines(phases, named_number) +
         "},\n  \"results\": {" + lines(results, named_number) + "},\n  \"notes\": {" +
         lines(notes, named_text) + "},\n  \"warnings\": [" + lines(warnings, text) + "]\n}\n";
}

void Summary::write(const std::string& path) const { replace_file(path, json()); }

}  // namespace littoral::support
