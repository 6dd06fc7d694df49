#include "grid/stretching.hpp"

#include <cmath>
#include <cstdio>

#include "littoral/error.hpp"

namespace littoral::fv {
namespace {

using Toward = Spacing::Toward;

/// One of two equal ends of a geometric series, n cells, widest over narrowest = ratio, narrow at 0.
double geometric(double ratio, double i, double n) {
  if (n <= 1.0 || ratio == 1.0) return i / n;
  const double q = std::pow(ratio, 1.0 / (n - 1.0));
  return std::expm1(i * std::log(q)) / std::expm1(n * std::log(q));
}

double hyperbolic(double strength, double i, double n) {
  return 1.0 - std::tanh(strength * (1.0 - i / n)) / std::tanh(strength);
}

std::string text(double value) {
  char t[32];
  std::snprintf(t, sizeof t, "%.4g", value);
  return t;
}

/// x in [low, high] with f(x) = wanted, f falling.
template <class F>
double solve(F&& f, double wanted, double low, double high) {
  constexpr int k_halvings = 200;  // to the last bit
  for (int i = 0; i < k_halvings; ++i) {
    const double middle = 0.5 * (low + high);
    (f(middle) > wanted ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

double stretched(const Spacing& spacing, int i, int n) {
  const double s = static_cast<double>(i) / n;
  const auto toward = spacing.toward;
  // distances from a refined lower end; the other cases are its mirror images
  const auto from_lower = [&](double index, double count) {
    if (spacing.kind == Spacing::Kind::geometric) return geometric(spacing.ratio, index, count);
    return hyperbolic(spacing.strength, index, count);
  };
  if (spacing.kind == Spacing::Kind::uniform) return s;
  if (toward == Toward::lower) return from_lower(i, n);
  if (toward == Toward::upper) return 1.0 - from_lower(n - i, n);
  const double half = 0.5 * n;
  return s <= 0.5 ? 0.5 * from_lower(i, half) : 1.0 - 0.5 * from_lower(n - i, half);
}

Spacing fitted(const Spacing& spacing, int n, double length, const std::string& where) {
  if (!spacing.first_cell) return spacing;
  Spacing result = spacing;
  const double count = spacing.toward == Toward::both ? 0.5 * n : n;
  const double part = *spacing.first_cell / (spacing.toward == Toward::both ? 0.5 * length : length);
  const auto complain = [&](const std::string& why) {
    throw ConfigError(where + ": first_cell " + text(*spacing.first_cell) + " m does not fit " +
                      std::to_string(n) + " cells over " + text(length) + " m: " + why);
  };
  if (spacing.kind == Spacing::Kind::uniform) complain("cells are uniform; choose kind geometric or tanh");
  if (part * count > 1.0)
    complain("equal cells would be " + text(length / n) + " m, so fewer cells do, or a smaller first one");
  constexpr double k_least = 1e-10;
  if (spacing.kind == Spacing::Kind::geometric) {
    // the growth from cell to cell; ratio is that of the last to the first
    constexpr double k_most = 2.0;
    if (count <= 1.0) return result;
    const auto first = [&](double growth) { return std::expm1(growth) / std::expm1(count * growth); };
    if (first(std::log(k_most)) > part)
      complain("cells would have to grow by more than 2; take more of them");
    result.ratio = std::exp((count - 1.0) * solve(first, part, k_least, std::log(k_most)));
  } else {
    constexpr double k_most = 20.0;  // tanh is 1 to the last bit there
    const auto first = [&](double strength) { return hyperbolic(strength, 1.0, count); };
    if (first(k_most) > part) complain("tanh cannot be that fine there; take more cells, or kind geometric");
    result.strength = solve(first, part, 1e-3, k_most);
  }
  return result;
}

std::vector<double> node_positions(const Stretching& stretching, int n, double lower, double upper,
                                   const std::string& where) {
  std::vector<double> x;
  const auto append = [&](const Spacing& given, int cells, double from, double to, const std::string& place) {
    const Spacing spacing = fitted(given, cells, to - from, place);
    for (int i = x.empty() ? 0 : 1; i < cells; ++i)
      x.push_back(from + (to - from) * stretched(spacing, i, cells));
    x.push_back(to);
  };
  if (stretching.sections.empty()) {
    append(stretching, n, lower, upper, where);
    return x;
  }
  double from = lower;
  int cells = 0;
  for (std::size_t s = 0; s < stretching.sections.size(); ++s) {
    const auto& section = stretching.sections[s];
    const std::string place = where + ", sections[" + std::to_string(s) + "]";
    if (!(section.to > from))
      throw ConfigError(place + ": to = " + text(section.to) + " m is not above " + text(from));
    append(section.spacing, section.cells, from, section.to, place);
    from = section.to;
    cells += section.cells;
  }
  constexpr double k_round_off = 1e-9;
  if (std::abs(from - upper) > k_round_off * (upper - lower) || cells != n)
    throw ConfigError(where + ": the sections end at " + text(from) + " m after " + std::to_string(cells) +
                      " cells, but the block ends at " + text(upper) + " m after " + std::to_string(n));
  return x;
}

}  // namespace littoral::fv
