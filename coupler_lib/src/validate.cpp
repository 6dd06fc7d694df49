#include "validate.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <utility>

#include "littoral/error.hpp"

namespace littoral::coupler {

namespace {

// NaN and infinity have all bits of the exponent set. A test of the bits vectorises.
constexpr std::uint64_t k_exponent = 0x7ff0'0000'0000'0000;

using Column = std::pair<const char*, const std::vector<double>*>;

[[noreturn]] void refuse(const std::string& who, const std::string& what) {
  throw CouplingError(who + ": " + what);
}

void check_length(const std::string& who, const char* field, std::size_t found, std::size_t due) {
  if (found != due)
    refuse(who, std::string(field) + " has " + std::to_string(found) + " values where " +
                    std::to_string(due) + " are due");
}

void check_finite(const std::string& who, const Column& column, const std::uint8_t* matters, const char* of) {
  const std::size_t bad = count_not_finite(column.second->data(), column.second->size(), matters);
  if (bad > 0)
    refuse(who, std::to_string(bad) + " of " + std::to_string(column.second->size()) + " values of " +
                    column.first + " in its " + of + " are NaN or infinite");
}

bool same_time(double a, double b, const Window& window) {
  return std::abs(a - b) <= 1e-9 * window.dt() + 4e-16 * std::abs(b);
}

}  // namespace

std::string text_of(double number) {
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%.9g", number);
  return text.data();
}

bool all_finite(const void* values, std::size_t n) {
  const char* bytes = static_cast<const char*>(values);
  std::uint64_t suspicious = 0;
  for (std::size_t i = 0; i < n; ++i) {
    std::uint64_t bits;
    std::memcpy(&bits, bytes + i * sizeof bits, sizeof bits);
    suspicious |= static_cast<std::uint64_t>((bits & k_exponent) == k_exponent);
  }
  return suspicious == 0;
}

std::size_t count_not_finite(const double* values, std::size_t n, const std::uint8_t* matters) {
  if (all_finite(values, n)) return 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < n; ++i) count += (!matters || matters[i]) && !std::isfinite(values[i]);
  return count;
}

void validate(const DonorGeometry& geometry, const std::string& who) {
  for (const auto& patch : geometry.patches) {
    std::size_t n = 1;
    for (const int cells : patch.n) {
      if (cells < 0) refuse(who, "a donor patch has a negative number of cells");
      n *= static_cast<std::size_t>(cells);
    }
    for (const Column& column : {Column{"x", &patch.x}, {"y", &patch.y}, {"z", &patch.z}}) {
      check_length(who, column.first, column.second->size(), n);
      check_finite(who, column, nullptr, "donor patches");
    }
    check_length(who, "usable", patch.usable.size(), n);
  }
}

void validate(const Targets& targets, const std::string& who) {
  for (const Column& column : {Column{"x", &targets.x}, {"y", &targets.y}, {"z", &targets.z}}) {
    check_length(who, column.first, column.second->size(), targets.size());
    check_finite(who, column, nullptr, "targets");
  }
  check_length(who, "wants", targets.wants.size(), targets.size());
}

void validate(const DonorValues& values, const DonorGeometry& geometry, const Window& window,
              const std::string& who) {
  const std::size_t n = geometry.size();
  std::vector<std::uint8_t> usable;
  usable.reserve(n);
  for (const auto& patch : geometry.patches)
    usable.insert(usable.end(), patch.usable.begin(), patch.usable.end());
  const auto check = [&](const Column& column) {
    check_length(who, column.first, column.second->size(), n);
    check_finite(who, column, usable.data(), "donors");
  };
  for (const Column& column : {Column{"p", &values.p},
                               {"u", &values.u},
                               {"v", &values.v},
                               {"w", &values.w},
                               {"dp_dt", &values.dp_dt},
                               {"du_dt", &values.du_dt},
                               {"dv_dt", &values.dv_dt},
                               {"dw_dt", &values.dw_dt}})
    check(column);
  check_length(who, "dphi_dt", values.dphi_dt.size(), values.phi.size());
  if (!values.phi.empty()) {
    check({"phi", &values.phi});
    check({"dphi_dt", &values.dphi_dt});
  }
  validate_horizon(values, window, who);
}

void validate_horizon(const DonorValues& values, const Window& window, const std::string& who) {
  const bool holds =
      (values.horizon_begin <= window.t_begin || same_time(values.horizon_begin, window.t_begin, window)) &&
      (values.horizon_end >= window.t_end || same_time(values.horizon_end, window.t_end, window));
  if (!holds)
    refuse(who, "its donors hold from " + text_of(values.horizon_begin) + " to " +
                    text_of(values.horizon_end) + " s, window " + std::to_string(window.index) +
                    " reaches from " + text_of(window.t_begin) + " to " + text_of(window.t_end) + " s");
}

void validate(const Samples& samples, const Targets& targets, const Window& window, const std::string& who) {
  const std::size_t n = targets.size();
  check_length(who, "status", samples.status.size(), n);
  std::vector<std::uint8_t> is_ok(n), has_phi(n);
  for (std::size_t i = 0; i < n; ++i) {
    if (samples.status[i] > SampleStatus::uncovered) refuse(who, "a sample has an unknown status");
    is_ok[i] = samples.status[i] == SampleStatus::ok;
    has_phi[i] = samples.status[i] != SampleStatus::uncovered && (targets.wants[i] & wants_phi);
  }
  for (const Column& column :
       {Column{"p", &samples.p}, {"u", &samples.u}, {"v", &samples.v}, {"w", &samples.w}}) {
    check_length(who, column.first, column.second->size(), n);
    check_finite(who, column, is_ok.data(), "samples");
  }
  check_length(who, "coverage", samples.coverage.size(), n);
  check_finite(who, {"coverage", &samples.coverage}, nullptr, "samples");
  if (!samples.phi.empty()) {
    check_length(who, "phi", samples.phi.size(), n);
    check_finite(who, {"phi", &samples.phi}, has_phi.data(), "samples");
  }
  if (!same_time(samples.time, window.t_end, window))
    refuse(who, "its samples belong to t = " + text_of(samples.time) + " s, window " +
                    std::to_string(window.index) + " ends at " + text_of(window.t_end) + " s");
}

}  // namespace littoral::coupler
