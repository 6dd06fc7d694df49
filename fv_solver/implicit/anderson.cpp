#include "implicit/anderson.hpp"

#include <cmath>

namespace littoral::fv {

void Anderson::mix(const std::vector<double>& q, const std::vector<double>& r, std::vector<double>& d) {
  if (depth_ <= 0) return;
  const std::size_t n = q.size(), m = history_.size();
  Entry now{q, r, d};

  // least squares || r - sum_i gamma_i (r - r_i) ||_w by normal equations: m <= depth is 2 or 3
  std::vector<std::vector<double>> a(m, std::vector<double>(m + 1, 0.0));
  for (std::size_t i = 0; i < m; ++i) {
    const auto& ri = history_[i].r;
    for (std::size_t j = 0; j <= i; ++j) {
      const auto& rj = history_[j].r;
      double sum = 0.0;
      for (std::size_t k = 0; k < n; ++k) sum += weights_[k] * (r[k] - ri[k]) * (r[k] - rj[k]);
      a[i][j] = a[j][i] = sum;
    }
    for (std::size_t k = 0; k < n; ++k) a[i][m] += weights_[k] * (r[k] - ri[k]) * r[k];
  }
  constexpr double k_regular = 1e-12;  // differences that are parallel to round-off share their weight
  for (std::size_t i = 0; i < m; ++i) a[i][i] *= 1.0 + k_regular;
  std::vector<double> gamma(m, 0.0);
  bool usable = true;
  for (std::size_t i = 0; i < m && usable; ++i) {  // symmetric positive: elimination without pivoting
    usable = a[i][i] > 0.0;
    for (std::size_t k = i + 1; k < m && usable; ++k) {
      const double f = a[k][i] / a[i][i];
      for (std::size_t j = i; j <= m; ++j) a[k][j] -= f * a[i][j];
    }
  }
  for (std::size_t i = m; i-- > 0 && usable;) {
    double sum = a[i][m];
    for (std::size_t j = i + 1; j < m; ++j) sum -= a[i][j] * gamma[j];
    gamma[i] = sum / a[i][i];
    usable = std::isfinite(gamma[i]);
  }
  if (usable)
    for (std::size_t i = 0; i < m; ++i) {
      const Entry& old = history_[i];
      const double g = gamma[i];
      for (std::size_t k = 0; k < n; ++k) d[k] -= g * ((q[k] - old.q[k]) + (now.d[k] - old.d[k]));
    }
  history_.push_front(std::move(now));
  if (history_.size() > static_cast<std::size_t>(depth_)) history_.pop_back();
}

}  // namespace littoral::fv
