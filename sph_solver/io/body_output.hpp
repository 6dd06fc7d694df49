#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bodies/walls.hpp"
#include "littoral/support/series.hpp"

namespace littoral::sph {

/// Columns of scalars.csv for each body: NAME.fx, all of the force; NAME.pressure_fx, NAME.viscous_fx its
/// parts; NAME.mx, likewise the moment about the body's origin. In 2-D x and z of forces, y of moments.
std::vector<std::string> body_columns(const std::vector<support::BodySpec>& bodies, int dimension);
/// Their values, in N and N m (2-D: per metre): means over the last step, from this rank's particles.
std::vector<double> body_values(const std::vector<BodyLoad>& loads, int dimension);

/// The bodies' dummies as points beside those of the particles: bodies.xdmf. Of fixed bodies once.
template <int D>
class BodyPoints {
 public:
  BodyPoints(const std::string& folder, bool restarted, double restart_time);
  void write(double time, const Walls<D>& walls);

 private:
  support::FieldSeries series_;
  bool written_;
};

extern template class BodyPoints<2>;
extern template class BodyPoints<3>;

}  // namespace littoral::sph
