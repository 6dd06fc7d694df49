#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

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

/// The lanes of x at every second place, the others as they were.
inline void set_every_second(const Lanes<float>& x, Lanes<float>& low, Lanes<float>& high) {
  typedef std::int32_t Mask __attribute__((vector_size(k_lanes * sizeof(std::int32_t))));
  low = __builtin_shuffle(low, x, Mask{8, 1, 9, 3, 10, 5, 11, 7});
  high = __builtin_shuffle(high, x, Mask{12, 1, 13, 3, 14, 5, 15, 7});
}
inline void set_every_second(const Lanes<double>& x, Lanes<double>& low, Lanes<double>& high) {
  typedef std::int64_t Mask __attribute__((vector_size(k_lanes * sizeof(std::int64_t))));
  low = __builtin_shuffle(low, x, Mask{8, 1, 9, 3, 10, 5, 11, 7});
  high = __builtin_shuffle(high, x, Mask{12, 1, 13, 3, 14, 5, 15, 7});
}

/// values[first[l]] = x[l]; what lies between may be written by other threads meanwhile
template <LanePattern S, class Real>
inline void store(const Lanes<Real>& x, const std::array<std::ptrdiff_t, k_lanes>& first, Real* values) {
  if constexpr (S == LanePattern::one)
    std::memcpy(values + first[0], &x, sizeof x);
  else if constexpr (S == LanePattern::two)
    for (std::size_t l = 0; l < k_lanes; ++l) values[first[0] + 2 * static_cast<std::ptrdiff_t>(l)] = x[l];
  else
    for (std::size_t l = 0; l < k_lanes; ++l) values[first[l]] = x[l];
}

/// The same where nobody writes what lies between: it is stored as it was.
template <LanePattern S, class Real>
inline void store_between(const Lanes<Real>& x, const std::array<std::ptrdiff_t, k_lanes>& first,
                          Real* values) {
  if constexpr (S == LanePattern::two) {
    Lanes<Real> low, high;
    std::memcpy(&low, values + first[0], sizeof low);
    std::memcpy(&high, values + first[0] + k_lanes, sizeof high);
    set_every_second(x, low, high);
    std::memcpy(values + first[0], &low, sizeof low);
    std::memcpy(values + first[0] + k_lanes, &high, sizeof high);
  } else {
    store<S>(x, first, values);
  }
}

inline double square_root(double x) { return std::sqrt(x); }
template <class V>
inline V square_root(const V& x) {
  return V{std::sqrt(x[0]), std::sqrt(x[1]), std::sqrt(x[2]), std::sqrt(x[3]),
           std::sqrt(x[4]), std::sqrt(x[5]), std::sqrt(x[6]), std::sqrt(x[7])};
}

/// The type of one number of T, a number or lanes of them.
template <class T>
struct LaneRealOf {
  using type = std::decay_t<decltype(std::declval<T&>()[0])>;
};
template <>
struct LaneRealOf<double> {
  using type = double;
};
template <class T>
using LaneReal = typename LaneRealOf<T>::type;

inline void convert(const Lanes<double>& x, Lanes<float>& y) { y = __builtin_convertvector(x, Lanes<float>); }
inline void convert(const Lanes<double>& x, Lanes<double>& y) { y = x; }
inline void convert(const Lanes<float>& x, Lanes<double>& y) {
  y = __builtin_convertvector(x, Lanes<double>);
}

}  // namespace littoral::fv
