#pragma once

#include <optional>
#include <string>

namespace littoral::support {

/// The whole text as a number, YAML's `.inf` included; nothing where it is none, or too large for a double.
std::optional<double> parse_number(const std::string& text);
/// Shortest decimal text that reads back as the same double; `.inf` and `.nan` as in YAML.
std::string format_number(double value);
/// A double-quoted YAML (and JSON) string.
std::string quoted(const std::string& text);

}  // namespace littoral::support
