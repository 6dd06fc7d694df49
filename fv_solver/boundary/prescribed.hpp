#pragma once

#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "boundary/window.hpp"
#include "littoral/error.hpp"
#include "littoral/support/formula.hpp"

namespace littoral::fv {

/// A user's formula as a function of place and time that complains where it has no value, which a formula may
/// lose in the course of a run, as sqrt(0.05-t) does.
/// what: the key and where it stands, for the message. The result throws StabilityError; not for OpenMP loops
inline Prescribed prescribed(const support::Formula& formula, std::string what) {
  return [f = formula, what = std::move(what)](const std::array<double, 3>& x, double t) {
    const double value = f(x[0], x[1], x[2], t);
    if (std::isfinite(value)) return value;
    std::array<char, 160> at{};
    std::snprintf(at.data(), at.size(), "' is %g at (%.6g, %.6g, %.6g) m, t = %.6g s", value, x[0], x[1],
                  x[2], t);
    throw StabilityError(what + ": the formula '" + f.text() + at.data() +
                         "; a formula must be finite wherever and whenever it is used");
  };
}

}  // namespace littoral::fv
