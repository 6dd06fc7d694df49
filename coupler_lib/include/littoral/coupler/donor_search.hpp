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
  std::array<double, 8> weight;      // trilinear, sum 1; beyond the outermost centres linear extrapolation
  bool found = false;
};

/// Finds donors and interpolates: tree, then walk with Newton inversion of the trilinear map, previous donor
/// first. Exact for linear fields on skewed and stretched patches. A point up to half a cell outside the
/// outermost centres is extrapolated from the last dual cell; further out it is not found. Where patches
/// overlap, the finer usable one wins.
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

/// State of FV at one point and time.
struct DonorState {
  double p = 0.0;
  Vec3 u{};
  double phi = 0.0;
};

/// q = sum_k w_k (q_k + dq_k/dt (t - t_n)), (24) with trilinear weights.
/// throws CouplingError if t lies outside the values' horizon
DonorState interpolate(const DonorValues& values, const Donor& donor, double time);

}  // namespace littoral::coupler
