#include "bodies/motion.hpp"

#include <cmath>
#include <utility>

namespace littoral::sph {
namespace {

// Of the interval, for difference quotients of the formulas: their truncation is below 1e-3 of what changes
// within an interval, their round-off 1e-8 of a displacement over interval^2.
constexpr double k_difference = 0.05;
constexpr double k_degree = 3.14159265358979323846 / 180.0;

double value(const std::optional<support::Formula>& formula, double t) {
  return formula ? (*formula)(0.0, 0.0, 0.0, t) : 0.0;
}

}  // namespace

Motion::Motion(const support::BodySpec& spec, double interval)
    : formulas_(spec.motion),
      moves_(spec.motion.given),
      interval_(interval),
      h_(k_difference * interval),
      start_(spec.position) {
  const auto turn = [&spec](std::size_t d) {
    Vector3 axis{};
    axis[d] = spec.rotation[d] * k_degree;
    return Rotation::about(axis);
  };
  passed_.push_back({start_, turn(2) * turn(1) * turn(0)});
}

Vector3 Motion::velocity(double t) const {
  const auto along = [&](const auto& speed, const auto& place) {
    return place ? (value(place, t + h_) - value(place, t - h_)) / (2.0 * h_) : value(speed, t);
  };
  return {along(formulas_.u, formulas_.x), along(formulas_.v, formulas_.y), along(formulas_.w, formulas_.z)};
}

Vector3 Motion::spin(double t) const {
  return {value(formulas_.rate_x, t), value(formulas_.rate_y, t), value(formulas_.rate_z, t)};
}

std::string Motion::not_finite_at(double t) const {
  const std::pair<const char*, const std::optional<support::Formula>*> keys[] = {
      {"u", &formulas_.u},           {"v", &formulas_.v},           {"w", &formulas_.w},
      {"x", &formulas_.x},           {"y", &formulas_.y},           {"z", &formulas_.z},
      {"rate_x", &formulas_.rate_x}, {"rate_y", &formulas_.rate_y}, {"rate_z", &formulas_.rate_z}};
  for (const auto& [key, formula] : keys)
    for (const double when : {t - h_, t, t + h_})
      if (!std::isfinite(value(*formula, when))) return key;
  return "";
}

Motion::Place Motion::advance(const Place& from, double t, double dt) const {
  const Vector3 mean = (1.0 / 6.0) * (velocity(t) + 4.0 * velocity(t + 0.5 * dt) + velocity(t + dt));
  const Vector3 turn = (1.0 / 6.0) * (spin(t) + 4.0 * spin(t + 0.5 * dt) + spin(t + dt));
  return {from.position + dt * mean, (Rotation::about(dt * turn) * from.rotation).normalised()};
}

BodyState Motion::at(double t) {
  BodyState state;
  if (!moves_) {
    state.position = passed_[0].position;
    state.rotation = passed_[0].rotation;
    return state;
  }
  const auto k = static_cast<std::size_t>(std::max(0.0, std::floor(t / interval_)));
  while (passed_.size() <= k)
    passed_.push_back(
        advance(passed_.back(), static_cast<double>(passed_.size() - 1) * interval_, interval_));
  const double begin = static_cast<double>(k) * interval_;
  const Place place = advance(passed_[k], begin, t - begin);
  state.position = place.position;
  state.rotation = place.rotation;
  if (formulas_.x) state.position[0] = start_[0] + value(formulas_.x, t);
  if (formulas_.y) state.position[1] = start_[1] + value(formulas_.y, t);
  if (formulas_.z) state.position[2] = start_[2] + value(formulas_.z, t);
  state.velocity = velocity(t);
  state.spin = spin(t);
  state.acceleration = (1.0 / (2.0 * h_)) * (velocity(t + h_) - velocity(t - h_));
  state.spin_rate = (1.0 / (2.0 * h_)) * (spin(t + h_) - spin(t - h_));
  return state;
}

}  // namespace littoral::sph
