#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace littoral::sph {

using Vector3 = std::array<double, 3>;

inline Vector3 operator+(const Vector3& a, const Vector3& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Vector3 operator-(const Vector3& a, const Vector3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Vector3 operator*(double s, const Vector3& a) { return {s * a[0], s * a[1], s * a[2]}; }
inline double dot(const Vector3& a, const Vector3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline double norm(const Vector3& a) { return std::sqrt(dot(a, a)); }
inline Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// A rotation, as the unit quaternion (w, x, y, z).
struct Rotation {
  double w = 1.0;
  Vector3 v = {0, 0, 0};

  /// By `angle` [rad] |axis| about the axis.
  static Rotation about(const Vector3& axis) {
    const double angle = norm(axis);
    if (angle == 0.0) return {};
    return {std::cos(0.5 * angle), (std::sin(0.5 * angle) / angle) * axis};
  }
  /// First b, then this.
  Rotation operator*(const Rotation& b) const {
    return {w * b.w - dot(v, b.v), w * b.v + b.w * v + cross(v, b.v)};
  }
  Vector3 operator()(const Vector3& x) const {
    const Vector3 t = 2.0 * cross(v, x);
    return x + w * t + cross(v, t);
  }
  Rotation inverse() const { return {w, -1.0 * v}; }
  Rotation normalised() const {
    const double s = 1.0 / std::sqrt(w * w + dot(v, v));
    return {s * w, s * v};
  }
};

}  // namespace littoral::sph
