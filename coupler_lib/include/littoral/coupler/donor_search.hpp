#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "littoral/coupler/fields.hpp"

namespace littoral::coupler {

/// Where a point lies among the donors: the eight (four in a plane) cell centres around it and their weights.
struct Donor {
  std::array<std::int32_t, 8> cell;  // index into DonorValues; unused corners repeat with weight 0
  std::array<double, 8> weight;      // sum 1; beyond the outermost centres linear extrapolation
  bool found = false;
};

/// Finds donors. Weights are trilinear in a dual cell (the cube of eight neighbouring centres), found by a
/// walk with Newton inversion from an earlier dual cell, else by a tree of boxes: the result never depends on
/// the hint. Exact for linear fields on skewed and stretched patches. In this order a point is served by
///   1. a dual cell around it whose corners are all usable (where patches overlap, the finest),
///   2. a dual cell around it with some unusable corners: linear fit through the usable ones (if they span
///   space),
///   3. the closest complete dual cell up to half a cell away: its map extended;
/// further out it is not found. Patches need two cells or more in each direction in play; a planar patch (one
/// cell in any one direction) serves a planar run in (x, z).
class DonorSearch {
 public:
  explicit DonorSearch(const DonorGeometry& geometry, int dimension);
  ~DonorSearch();
  DonorSearch(DonorSearch&&) noexcept;
  DonorSearch& operator=(DonorSearch&&) noexcept;

  /// hint: dual cell of an earlier search near x (-1: none); updated. thread-safe
  Donor find(const Vec3& x, std::int64_t& hint) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// State of FV at one point and time. phi is k_deep where no level set crosses.
struct DonorState {
  double p = 0.0;
  Vec3 u{};
  double phi = 0.0;
};
inline constexpr double k_deep = -1.0e30;  // [m] water everywhere

/// q = sum_k w_k (q_k + dq_k/dt (t - t_n)), Di Mascio et al. 2021, (24), with the weights of `donor`.
/// throws CouplingError if t lies outside the values' horizon
DonorState interpolate(const DonorValues& values, const Donor& donor, double time);

}  // namespace littoral::coupler
