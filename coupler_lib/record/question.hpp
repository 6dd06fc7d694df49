#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "littoral/coupler/fields.hpp"
#include "littoral/coupler/types.hpp"

namespace littoral::coupler {

/// Where a program asked for something when it announced itself, kept to see whether it asks there again: for
/// sph the boxes it needs and covers, for fv those around its donors and targets.
struct Question {
  std::array<double, 12> edges{};
  std::array<std::int64_t, 2> counts{};  // fv: donors and targets offered

  static Question of(const Box& first, const Box& second) {
    Question question;
    auto to = question.edges.begin();
    for (const auto* corner : {&first.lower, &first.upper, &second.lower, &second.upper})
      to = std::copy(corner->begin(), corner->end(), to);
    return question;
  }

  static Question of(const DonorGeometry& donors, const Targets& targets) {
    Box cells = Box::nothing(), points = Box::nothing();
    for (const auto& patch : donors.patches) enclose(cells, patch.x, patch.y, patch.z);
    enclose(points, targets.x, targets.y, targets.z);
    Question question = of(cells, points);
    question.counts = {static_cast<std::int64_t>(donors.size()), static_cast<std::int64_t>(targets.size())};
    return question;
  }

  Box box(std::size_t which) const {
    const auto* at = edges.data() + 6 * which;
    return {{at[0], at[1], at[2]}, {at[3], at[4], at[5]}};
  }

 private:
  static void enclose(Box& box, const std::vector<double>& x, const std::vector<double>& y,
                      const std::vector<double>& z) {
    for (std::size_t i = 0; i < x.size(); ++i) {
      const Vec3 point = {x[i], y[i], z[i]};
      if (box.empty()) box = {point, point};
      for (std::size_t d = 0; d < 3; ++d) {
        box.lower[d] = std::min(box.lower[d], point[d]);
        box.upper[d] = std::max(box.upper[d], point[d]);
      }
    }
  }
};

/// The same box up to round-off of its extent; all empty boxes are the same.
inline bool same(const Box& a, const Box& b) {
  if (a.empty() || b.empty()) return a.empty() == b.empty();
  double extent = 0.0;
  for (std::size_t d = 0; d < 3; ++d) extent = std::max(extent, a.upper[d] - a.lower[d]);
  const double tolerance = 1e-9 * extent;
  const auto close = [&](double p, double q) { return p == q || std::abs(p - q) <= tolerance; };
  for (std::size_t d = 0; d < 3; ++d)
    if (!close(a.lower[d], b.lower[d]) || !close(a.upper[d], b.upper[d])) return false;
  return true;
}

}  // namespace littoral::coupler
