#pragma once

#include <cmath>

namespace littoral::sph {

/// Sum that carries its own rounding error (Neumaier 1974): the mass ledger adds 10^7 small numbers to a
/// large one and is compared at round-off.
class Compensated {
 public:
  Compensated() = default;
  explicit Compensated(double sum, double carry = 0.0) : sum_(sum), carry_(carry) {}
  Compensated& operator+=(double value) {
    const double t = sum_ + value;
    carry_ += std::fabs(sum_) >= std::fabs(value) ? (sum_ - t) + value : (value - t) + sum_;
    sum_ = t;
    return *this;
  }
  Compensated& operator-=(double value) { return *this += -value; }
  Compensated& operator+=(const Compensated& other) {
    *this += other.sum_;
    return *this += other.carry_;
  }
  double value() const { return sum_ + carry_; }
  double sum() const { return sum_; }      ///< with carry(): the exact state, for checkpoints
  double carry() const { return carry_; }  ///<

 private:
  double sum_ = 0.0;
  double carry_ = 0.0;
};

}  // namespace littoral::sph
