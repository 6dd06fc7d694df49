#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace littoral::sph {

/// Four doubles or eight floats that a pair loop works on at once: one neighbour a lane. Written out as
/// vectors of the compiler rather than left to its loop vectoriser, so that a loop can be written once over
/// the dimension and keeps its lanes. 256 bits: wider ones were slower here (README, Speed).
template <class Real>
struct LaneTypes;

template <>
struct LaneTypes<double> {
  static constexpr std::size_t k_count = 4;
  static constexpr std::size_t k_unit = 2;  // values read at once from a row
  typedef double Value __attribute__((vector_size(32)));
};

template <>
struct LaneTypes<float> {
  static constexpr std::size_t k_count = 8;
  static constexpr std::size_t k_unit = 4;
  typedef float Value __attribute__((vector_size(32)));
  typedef std::int32_t Integer __attribute__((vector_size(32)));
  typedef std::uint32_t Bits __attribute__((vector_size(32)));
};

template <class Real>
using Lanes = typename LaneTypes<Real>::Value;

template <class Real>
constexpr std::size_t k_lanes = LaneTypes<Real>::k_count;

/// The same number in every lane.
template <class Real>
inline Lanes<Real> broadcast(Real value) {
  return Lanes<Real>{} + value;
}

inline Lanes<double> sqrt(Lanes<double> v) {
  return Lanes<double>{std::sqrt(v[0]), std::sqrt(v[1]), std::sqrt(v[2]), std::sqrt(v[3])};
}
inline Lanes<float> sqrt(Lanes<float> v) {
  return Lanes<float>{std::sqrt(v[0]), std::sqrt(v[1]), std::sqrt(v[2]), std::sqrt(v[3]),
                      std::sqrt(v[4]), std::sqrt(v[5]), std::sqrt(v[6]), std::sqrt(v[7])};
}

/// The larger of both, lane by lane.
template <class Vector>
inline Vector largest(Vector a, Vector b) {
  return a > b ? a : b;
}

/// Sum of the lanes, in an order of its own that is always the same.
inline double sum(Lanes<double> v) { return (v[0] + v[2]) + (v[1] + v[3]); }
inline double sum(Lanes<float> v) {
  const auto low = __builtin_shufflevector(v, v, 0, 1, 2, 3),
             high = __builtin_shufflevector(v, v, 4, 5, 6, 7);
  return sum(__builtin_convertvector(low, Lanes<double>) + __builtin_convertvector(high, Lanes<double>));
}

/// Values 0 .. n-1 of the rows j[0], j[1], ... of a table, rows turned into lanes: q[a] lane k = row j[k],
/// value a. n is a multiple of the unit. Loads of whole units and a few shuffles: cheaper than n gathers.
template <std::size_t n, std::size_t stride>
inline void load_rows(const double* table, const std::int32_t* j, Lanes<double>* q) {
  typedef double Pair __attribute__((vector_size(16), may_alias));
  const double* row[4];
  for (std::size_t k = 0; k < 4; ++k) row[k] = table + static_cast<std::size_t>(j[k]) * stride;
  for (std::size_t a = 0; a < n; a += 2) {
    Pair part[4];
    for (std::size_t k = 0; k < 4; ++k) part[k] = *reinterpret_cast<const Pair*>(row[k] + a);
    const auto even = __builtin_shufflevector(part[0], part[2], 0, 1, 2, 3);
    const auto odd = __builtin_shufflevector(part[1], part[3], 0, 1, 2, 3);
    q[a] = __builtin_shufflevector(even, odd, 0, 4, 2, 6);
    q[a + 1] = __builtin_shufflevector(even, odd, 1, 5, 3, 7);
  }
}

template <std::size_t n, std::size_t stride>
inline void load_rows(const float* table, const std::int32_t* j, Lanes<float>* q) {
  typedef float Quad __attribute__((vector_size(16), may_alias));
  const float* row[8];
  for (std::size_t k = 0; k < 8; ++k) row[k] = table + static_cast<std::size_t>(j[k]) * stride;
  for (std::size_t a = 0; a < n; a += 4) {
    Lanes<float> both[4];
    for (std::size_t k = 0; k < 4; ++k)
      both[k] =
          __builtin_shufflevector(*reinterpret_cast<const Quad*>(row[k] + a),
                                  *reinterpret_cast<const Quad*>(row[k + 4] + a), 0, 1, 2, 3, 4, 5, 6, 7);
    const auto lo02 = __builtin_shufflevector(both[0], both[2], 0, 8, 1, 9, 4, 12, 5, 13);
    const auto hi02 = __builtin_shufflevector(both[0], both[2], 2, 10, 3, 11, 6, 14, 7, 15);
    const auto lo13 = __builtin_shufflevector(both[1], both[3], 0, 8, 1, 9, 4, 12, 5, 13);
    const auto hi13 = __builtin_shufflevector(both[1], both[3], 2, 10, 3, 11, 6, 14, 7, 15);
    q[a] = __builtin_shufflevector(lo02, lo13, 0, 8, 1, 9, 4, 12, 5, 13);
    q[a + 1] = __builtin_shufflevector(lo02, lo13, 2, 10, 3, 11, 6, 14, 7, 15);
    q[a + 2] = __builtin_shufflevector(hi02, hi13, 0, 8, 1, 9, 4, 12, 5, 13);
    q[a + 3] = __builtin_shufflevector(hi02, hi13, 2, 10, 3, 11, 6, 14, 7, 15);
  }
}

/// One value of four particles, from a column.
inline Lanes<double> gather(const double* column, const std::int32_t* j) {
  return Lanes<double>{column[j[0]], column[j[1]], column[j[2]], column[j[3]]};
}

/// Calls f(j) for the neighbours `list` of particle `self`, as many at a time as there are lanes; the last
/// group is filled up with the particle itself, whose distance 0 makes every pair term vanish.
template <class Real, class F>
inline __attribute__((always_inline)) void for_each_group(const std::int32_t* list, std::size_t count,
                                                          std::size_t self, const F& f) {
  constexpr std::size_t lanes = k_lanes<Real>;
  for (std::size_t k = 0; k < count; k += lanes) {
    const std::int32_t* j = list + k;
    std::int32_t last[lanes];
    if (k + lanes > count) {
      for (std::size_t l = 0; l < lanes; ++l)
        last[l] = k + l < count ? j[l] : static_cast<std::int32_t>(self);
      j = last;
    }
    f(j);
  }
}

}  // namespace littoral::sph
