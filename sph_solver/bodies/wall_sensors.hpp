#pragma once

#include <string>
#include <vector>

#include "bodies/body.hpp"
#include "bodies/disc_places.hpp"
#include "bodies/dummies.hpp"
#include "bodies/wall_fluxes.hpp"
#include "bodies/wall_list.hpp"
#include "boundary/domain_box.hpp"

namespace littoral::sph {

/// A disc in a wall. normal: out of the water.
struct WallDisc {
  std::string name;
  Vector3 centre, normal;
  double diameter;  // [m]
};

/// What the water presses on discs of walls, from the forces that particles and bodies exchange. At a place s
/// of a wall
///   p(s) = sum_i (f_i . n) w(s - s_i) / integral of t w,
/// s_i: foot of particle i, f_i: its push on the body, w: the kernel's shape along the wall; t: what the body
/// gives, in front of each place, of the push of an endless wall under one pressure: 1, but within a kernel
/// radius of another body's wall, which carries a part, or of an edge. A dry part counts as p0.
template <int D>
class WallSensors {
 public:
  WallSensors() = default;
  /// throws ConfigError: a disc that lies in no wall, or in one that moves
  WallSensors(const std::vector<WallDisc>& discs, const std::vector<Body>& bodies, const Dummies<D>& dummies,
              const DomainBox<D>& box, double spacing, double kernel_radius);

  void begin_step() { mean_.assign(discs_.size(), 0.0); }
  /// forces: of the rows of `list` on each body, of one stage, which counts with `weight`
  void add(const Particles<D>& particles, const WallList<D>& list, const RowForces<D>& forces,
           std::size_t n_bodies, double weight);
  /// Mean of the last step above the pressure level [Pa], a disc a value; from the owned particles.
  const std::vector<double>& mean() const { return mean_; }

 private:
  struct Disc {
    DiscFrame frame;
    double radius;
    std::size_t body;
    std::vector<DiscPlace> places;  // weight: over the integral of t w
  };

  double R_ = 0.0, spacing_ = 0.0;  // [m]
  std::vector<Disc> discs_;
  std::vector<double> mean_;
};

extern template class WallSensors<2>;
extern template class WallSensors<3>;

}  // namespace littoral::sph
