#pragma once

#include <cstddef>
#include <deque>
#include <vector>

namespace littoral::fv {

/// Anderson mixing of a preconditioned fixed-point iteration q <- q + d, where d = M^-1 (-r(q)): the new
/// iterate is the combination of the last `depth` + 1 ones whose combined residual is smallest in the
/// weighted norm sum_i w_i r_i^2. Depth 0 is the plain iteration.
class Anderson {
 public:
  Anderson(int depth, std::vector<double> weights) : depth_(depth), weights_(std::move(weights)) {}

  /// The change to apply to q, from q's own correction `d` and residual `r`, all of one length.
  /// in    q present unknowns, r residual there, d the preconditioned correction
  /// out   d the change towards the next iterate
  void mix(const std::vector<double>& q, const std::vector<double>& r, std::vector<double>& d);
  void forget() { history_.clear(); }

 private:
  struct Entry {
    std::vector<double> q, r, d;
  };
  int depth_;
  std::vector<double> weights_;
  std::deque<Entry> history_;  // newest first
};

}  // namespace littoral::fv
