#include "implicit/anderson.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "implicit/ordered_sum.hpp"

namespace littoral::fv {

Anderson::Anderson(int depth, std::vector<double> weights, const Ranks& ranks)
    : depth_(depth), weights_(weights.begin(), weights.end()), ranks_(ranks) {
  if (depth < 0 || depth > k_max_depth) throw std::invalid_argument("depth of Anderson mixing: 0, 1 or 2");
  if (depth == 0) return;
  for (Entry& entry : entry_)
    for (auto* field : {&entry.r, &entry.d, &entry.way}) field->assign(weights_.size(), 0.0F);
}

template <class Real>
void Anderson::mix(const std::vector<Real>& r, std::vector<Real>& d) {
  if (depth_ == 0) return;
  const auto n = static_cast<std::ptrdiff_t>(r.size());
  const Real* __restrict now_r = r.data();
  Real* __restrict now_d = d.data();
  const float* __restrict w = weights_.data();
  Entry& first = entry_[newest_];
  Entry& second = entry_[1 - newest_];
  const float* __restrict r1 = first.r.data();
  const float* __restrict r2 = second.r.data();

  // least squares || r - sum_i gamma_i (r - r_i) ||_w by normal equations
  double gamma1 = 0.0, gamma2 = 0.0;
  if (known_ > 0) {
    auto s = ordered_sums<5>(n, [&](std::ptrdiff_t begin, std::ptrdiff_t end, std::array<double, 5>& sum) {
      double a11 = 0.0, a12 = 0.0, a22 = 0.0, b1 = 0.0, b2 = 0.0;
#pragma omp simd reduction(+ : a11, a12, a22, b1, b2)
      for (std::ptrdiff_t i = begin; i < end; ++i) {
        const double now = static_cast<double>(now_r[i]), weight = static_cast<double>(w[i]);
        const double d1 = now - static_cast<double>(r1[i]), d2 = now - static_cast<double>(r2[i]);
        a11 += weight * d1 * d1;
        a12 += weight * d1 * d2;
        a22 += weight * d2 * d2;
        b1 += weight * d1 * now;
        b2 += weight * d2 * now;
      }
      sum = {a11, a12, a22, b1, b2};
    });
    ranks_.sum(s);
    constexpr double k_regular = 1e-12;  // differences that are parallel to round-off share their weight
    const double a11 = s[0] * (1.0 + k_regular), a22 = s[2] * (1.0 + k_regular), a12 = s[1];
    const double det = a11 * a22 - a12 * a12;
    if (known_ == 1) {
      gamma1 = s[3] / a11;
    } else {
      gamma1 = (s[3] * a22 - s[4] * a12) / det;
      gamma2 = (s[4] * a11 - s[3] * a12) / det;
    }
    if (!std::isfinite(gamma1) || !std::isfinite(gamma2)) gamma1 = gamma2 = 0.0;
  }

  // the change, and the present iterate in place of the oldest one
  float* __restrict way1 = first.way.data();
  const float* __restrict d1 = first.d.data();
  float* __restrict way2 = second.way.data();
  float* __restrict d2 = second.d.data();
  float* __restrict keep_r = second.r.data();
  const bool one = known_ > 0, two = known_ > 1;  // what is not known yet may be anything
#pragma omp parallel for simd schedule(static) if (n > k_worth_threads)
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    const auto own = static_cast<double>(now_d[i]);
    const double step1 = static_cast<double>(way1[i]) + own - static_cast<double>(d1[i]);
    const double step2 = static_cast<double>(way2[i]) + own - static_cast<double>(d2[i]);
    const double change = own - (one ? gamma1 * step1 : 0.0) - (two ? gamma2 * step2 : 0.0);
    now_d[i] = static_cast<Real>(change);
    way1[i] += static_cast<float>(change);
    way2[i] = static_cast<float>(change);
    d2[i] = static_cast<float>(own);
    keep_r[i] = static_cast<float>(now_r[i]);
  }
  newest_ = 1 - newest_;
  known_ = std::min(known_ + 1, depth_);
}

template void Anderson::mix(const std::vector<float>&, std::vector<float>&);
template void Anderson::mix(const std::vector<double>&, std::vector<double>&);

}  // namespace littoral::fv
