#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace littoral::coupler {

/// Always x, y, z. In 2-D the plane is (x, z) and y is 0 everywhere.
using Vec3 = std::array<double, 3>;

/// Which side of the coupling a program plays.
enum class Role : std::uint8_t { sph = 0, fv = 1 };
const char* name(Role role);  ///< "sph", "fv"

/// Axis-aligned box [m]. lower > upper in any direction: empty, meets nothing.
struct Box {
  Vec3 lower{};
  Vec3 upper{};
  static Box nothing() { return {{1, 1, 1}, {-1, -1, -1}}; }
  bool empty() const { return lower[0] > upper[0] || lower[1] > upper[1] || lower[2] > upper[2]; }
  bool contains(const Vec3& x) const {
    for (std::size_t d = 0; d < 3; ++d)
      if (x[d] < lower[d] || x[d] > upper[d]) return false;
    return true;
  }
  bool meets(const Box& other) const {
    if (empty() || other.empty()) return false;
    for (std::size_t d = 0; d < 3; ++d)
      if (upper[d] < other.lower[d] || other.upper[d] < lower[d]) return false;
    return true;
  }
  Box grown(double skin) const;
};

}  // namespace littoral::coupler
