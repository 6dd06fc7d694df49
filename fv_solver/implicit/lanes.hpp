#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace littoral::fv {

/// Lines solved together, one per vector lane: float fills a 256-bit register.
inline constexpr int k_lanes = 8;

/// One number a lane. GCC's and Clang's vector extension: arithmetic, comparison and ?: work lane by lane.
template <class Real>
struct LanesOf {
  typedef Real type __attribute__((vector_size(k_lanes * sizeof(Real))));
};
template <class Real>
using Lanes = typename LanesOf<Real>::type;

/// How the cells of a bundle's lines lie in memory: anywhere, side by side, or every second one (zebra along
/// direction 0). The last two are loaded without picking lane by lane.
enum class LanePattern : std::uint8_t { any, one, two };

inline Lanes<float> every_second(const Lanes<float>& low, const Lanes<float>& high) {
  typedef std::int32_t Mask __attribute__((vector_size(k_lanes * sizeof(std::int32_t))));
  return __builtin_shuffle(low, high, Mask{0, 2, 4, 6, 8, 10, 12, 14});
}
inline Lanes<double> every_second(const Lanes<double>& low, const Lanes<double>& high) {
  typedef std::int64_t Mask __attribute__((vector_size(k_lanes * sizeof(std::int64_t))));
  return __builtin_shuffle(low, high, Mask{0, 2, 4, 6, 8, 10, 12, 14});
}

/// x[l] = values[first[l]]
template <LanePattern S, class Real>
inline void load(const Real* values, const std::array<std::ptrdiff_t, k_lanes>& first, Lanes<Real>& x) {
  if constexpr (S == LanePattern::one) {
    std::memcpy(&x, values + first[0], sizeof x);
  } else if constexpr (S == LanePattern::two) {
    Lanes<Real> low, high;
    std::memcpy(&low, values + first[0], sizeof low);
    std::memcpy(&high, values + first[0] + k_lanes, sizeof high);
    x = every_second(low, high);
  } else {
    x = Lanes<Real>{values[first[0]], values[first[1]], values[first[2]], values[first[3]],
                    values[first[4]], values[first[5]], values[first[6]], values[first[7]]};
  }
}

/// values[first[l]] = x[l]
template <LanePattern S, class Real>
inline void store(const Lanes<Real>& x, const std::array<std::ptrdiff_t, k_lanes>& first, Real* values) {
  if constexpr (S == LanePattern::one)
    std::memcpy(values + first[0], &x, sizeof x);
  else if constexpr (S == LanePattern::two)
    for (std::size_t l = 0; l < k_lanes; ++l) values[first[0] + 2 * static_cast<std::ptrdiff_t>(l)] = x[l];
  else
    for (std::size_t l = 0; l < k_lanes; ++l) values[first[l]] = x[l];
}

inline double square_root(double x) { return std::sqrt(x); }
inline Lanes<double> square_root(const Lanes<double>& x) {
  return Lanes<double>{std::sqrt(x[0]), std::sqrt(x[1]), std::sqrt(x[2]), std::sqrt(x[3]),
                       std::sqrt(x[4]), std::sqrt(x[5]), std::sqrt(x[6]), std::sqrt(x[7])};
}

inline void convert(const Lanes<double>& x, Lanes<float>& y) { y = __builtin_convertvector(x, Lanes<float>); }
inline void convert(const Lanes<double>& x, Lanes<double>& y) { y = x; }

}  // namespace littoral::fv
