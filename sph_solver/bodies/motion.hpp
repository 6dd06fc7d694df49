#pragma once

#include <array>
#include <string>
#include <vector>

#include "bodies/vector3.hpp"
#include "littoral/support/body.hpp"

namespace littoral::sph {

/// Where a rigid body is and how it moves.
struct BodyState {
  Vector3 position{};      // [m] of its origin
  Rotation rotation{};     // from its own frame to the scene's
  Vector3 velocity{};      // [m/s]
  Vector3 acceleration{};  // [m/s^2]
  Vector3 spin{};          // [rad/s]
  Vector3 spin_rate{};     // [rad/s^2]

  Vector3 velocity_at(const Vector3& x) const { return velocity + cross(spin, x - position); }
  Vector3 acceleration_at(const Vector3& x) const {
    const Vector3 r = x - position;
    return acceleration + cross(spin_rate, r) + cross(spin, cross(spin, r));
  }
};

/// Prescribed motion of a rigid body: a function of time alone, whatever steps asked for it, so that a
/// continued run finds the body where the interrupted one left it. Velocities are integrated by Simpson's
/// rule over intervals of fixed length from t = 0 on.
class Motion {
 public:
  Motion(const support::BodySpec& spec, double interval);
  bool moves() const { return moves_; }
  BodyState at(double t);
  /// The first of the formulas' keys that has no finite value at t, or next to it where it is differentiated;
  /// empty: all have.
  std::string not_finite_at(double t) const;

 private:
  Vector3 velocity(double t) const;
  Vector3 spin(double t) const;
  struct Place {
    Vector3 position;
    Rotation rotation;
  };
  Place advance(const Place& from, double t, double dt) const;

  support::BodySpec::Motion formulas_;
  bool moves_;
  double interval_;            // [s]
  double h_;                   // [s] of difference quotients
  Vector3 start_;              // [m]
  std::vector<Place> passed_;  // at k interval
};

}  // namespace littoral::sph
