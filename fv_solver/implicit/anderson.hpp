#pragma once

#include <cstddef>
#include <vector>

#include "parallel/ranks.hpp"

namespace littoral::fv {

/// Anderson mixing of a preconditioned fixed-point iteration q <- q + d, where d = M^-1 (-r(q)): the new
/// iterate is the combination of the last `depth` + 1 ones whose combined residual is smallest in the
/// weighted norm sum_i w_i r_i^2. Depth 0 is the plain iteration. The past is kept in float, as differences:
/// they are large beside what is still to be corrected.
class Anderson {
 public:
  static constexpr int k_max_depth = 2;

  /// throws std::invalid_argument where the depth is not 0, 1 or 2
  Anderson(int depth, std::vector<double> weights, const Ranks& ranks = {});

  /// The change to apply to q, from the residual `r` at q and its own correction `d`. The caller applies all
  /// of it before it comes again. in    r residual at the present unknowns, d the preconditioned correction
  /// out   d the change towards the next iterate
  /// comm collective: the unknowns are those of all ranks; OpenMP inside
  template <class Real>
  void mix(const std::vector<Real>& r, std::vector<Real>& d);
  void forget() { known_ = 0; }

 private:
  struct Entry {  // an iterate: its residual and correction, and the way from it to the present one
    std::vector<float> r, d, way;
  };
  int depth_;
  std::vector<float> weights_;
  Ranks ranks_;
  Entry entry_[k_max_depth];
  int newest_ = 0, known_ = 0;
};

}  // namespace littoral::fv
