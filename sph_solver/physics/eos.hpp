#pragma once

namespace littoral::sph {

/// Linear equation of state:  p = c^2 (rho - rho0) + p0.
struct LinearEos {
  double rho0 = 1000.0;  // [kg/m^3]
  double c = 0.0;        // [m/s]
  double p0 = 0.0;       // [Pa]

  double pressure(double rho) const { return c * c * (rho - rho0) + p0; }
  double density(double p) const { return rho0 + (p - p0) / (c * c); }
};

}  // namespace littoral::sph
