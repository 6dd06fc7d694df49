#include "littoral/support/timers.hpp"

#include <chrono>

namespace littoral::support {

Timers::Phase Timers::declare(const std::string& name) {
  for (Phase phase = 0; phase < names_.size(); ++phase)
    if (names_[phase] == name) return phase;
  names_.push_back(name);
  seconds_.push_back(0.0);
  return names_.size() - 1;
}

std::vector<std::pair<std::string, double>> Timers::table() const {
  std::vector<std::pair<std::string, double>> rows;
  for (Phase phase = 0; phase < names_.size(); ++phase) rows.emplace_back(names_[phase], seconds_[phase]);
  return rows;
}

double Timers::now() {
  const auto since = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double>(since).count();
}

}  // namespace littoral::support
