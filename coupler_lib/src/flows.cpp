#include <cmath>

#include "littoral/coupler/analytic.hpp"

namespace littoral::coupler {

Flow uniform_stream(const Vec3& velocity, double pressure) {
  return [=](const Vec3&, double) {
    FlowState state;
    state.p = pressure;
    state.u = velocity;
    return state;
  };
}

Flow hydrostatic(double density, double gravity, double level, double reference_pressure) {
  return [=](const Vec3& x, double) {
    FlowState state;
    state.p = reference_pressure - density * gravity * (x[2] - level);
    state.phi = x[2] - level;
    return state;
  };
}

Flow taylor_vortex(double density, double speed, double wavelength, double viscosity, const Vec3& stream) {
  const double k = 2.0 * std::acos(-1.0) / wavelength;
  return [=](const Vec3& x, double t) {
    const double a = k * (x[0] - stream[0] * t), c = k * (x[2] - stream[2] * t);
    const double decay = std::exp(-2.0 * viscosity * k * k * t);
    FlowState state;
    state.u = {stream[0] - speed * decay * std::cos(a) * std::sin(c), stream[1],
               stream[2] + speed * decay * std::sin(a) * std::cos(c)};
    state.p = -0.25 * density * speed * speed * decay * decay * (std::cos(2.0 * a) + std::cos(2.0 * c));
    return state;
  };
}

Flow standing_wave(double density, double gravity, double depth, double wavenumber, double amplitude) {
  const double k = wavenumber;
  const double omega = std::sqrt(gravity * k * std::tanh(k * depth));
  const double potential = amplitude * omega / (k * std::sinh(k * depth));
  return [=](const Vec3& x, double t) {
    const double ch = std::cosh(k * (x[2] + depth)), sh = std::sinh(k * (x[2] + depth));
    const double cosine = std::cos(k * x[0]), sine = std::sin(k * x[0]);
    FlowState state;
    state.u = {-potential * k * sine * ch * std::cos(omega * t), 0.0,
               potential * k * cosine * sh * std::cos(omega * t)};
    state.p = -density * gravity * x[2] + density * potential * omega * cosine * ch * std::sin(omega * t);
    state.phi = x[2] - amplitude * cosine * std::sin(omega * t);
    return state;
  };
}

}  // namespace littoral::coupler
