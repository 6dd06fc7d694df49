#include "physics/wall_loads.hpp"

#include <algorithm>
#include <cmath>

#include "boundary/boundary_flux.hpp"
#include "boundary/line.hpp"
#include "grid/loops.hpp"
#include "grid/space.hpp"
#include "level_set/volume.hpp"
#include "physics/flux_rows.hpp"

namespace littoral::fv {
namespace {

/// One face of a wall: where it is and what acts on it.
template <int D>
struct WallFace {
  std::array<double, D> at, area;           // [m] centre, [m^(D-1)] out of the water
  std::array<double, D> friction;           // [N] on the wall
  double pressure;                          // [Pa] beyond the reference
  double distance, measure;                 // [m] of the first centre, [m^(D-1)]
  std::array<double, D> tangential_stress;  // [Pa]
};

template <int D>
std::array<double, D> friction_on(const Block<D>& block, const State<D>& q, const Window<D>& w,
                                  std::size_t face, double mu) {
  std::array<double, D> friction{};
  if (mu == 0.0) return friction;
  double unused = 0.0;
  FluxRow<D> traction;
  traction.mass = &unused;
  for (std::size_t k = 0; k < D; ++k) traction.momentum[k] = &friction[k];
  subtract_stress_row<D>(block, q, static_cast<std::size_t>(w.direction), static_cast<std::ptrdiff_t>(face),
                         1, mu, traction);
  if (w.side == 0)
    for (double& f : friction) f = -f;
  return friction;
}

/// Leaves of a wall's face the part below the surface, by the plane of phi on it, and moves its centre there:
/// exact in a plane scene, in space where the surface is parallel to the face's edges. false: all of it is
/// dry
template <int D>
bool keep_wet_part(const Block<D>& block, const Window<D>& w, const Line<D>& line, const Field& phi,
                   WallFace<D>& face) {
  const auto on_wall = [&](std::ptrdiff_t aside) {
    const auto at = [&](std::size_t c) {
      return phi[static_cast<std::size_t>(static_cast<std::ptrdiff_t>(c) + aside)];
    };
    return 0.5 * (at(line.inner[0]) + at(line.ghost[0]));
  };
  std::array<double, D> slope{};  // of phi from the face's centre to its edges
  double reach = 0.0;
  for (std::size_t d = 0; d < D; ++d) {
    if (d == static_cast<std::size_t>(w.direction)) continue;
    slope[d] = 0.25 * (on_wall(block.extent.stride[d]) - on_wall(-block.extent.stride[d]));
    reach += std::abs(slope[d]);
  }
  const double share = wet_share<D>(on_wall(0), slope);
  if (share <= 0.0) return false;
  if (share >= 1.0) return true;
  for (std::size_t d = 0; d < D; ++d) {
    if (slope[d] == 0.0) continue;
    const double part = 0.5 * (1.0 - share) * slope[d] / reach;  // of the way between the centres beside it
    const auto up = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(line.inner[0]) +
                                             block.extent.stride[d]),
               low = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(line.inner[0]) -
                                              block.extent.stride[d]);
    for (std::size_t k = 0; k < D; ++k)
      face.at[k] -= 0.5 * part * (block.centre[k][up] - block.centre[k][low]);
  }
  for (std::size_t k = 0; k < D; ++k) {
    face.area[k] *= share;
    face.friction[k] *= share;
  }
  face.measure *= share;
  return true;
}

template <int D, class Body>
void for_each_wall_face(const std::vector<Block<D>>& blocks, const Equations<D>& equations,
                        const std::vector<State<D>>& q, const std::string& wall,
                        const std::vector<Field>* phi, Body&& body) {
  const double mu = equations.fluid.density * equations.fluid.viscosity;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const Block<D>& block = blocks[b];
    for (const Window<D>& w : block.windows) {
      if (w.name != wall) continue;
      std::array<int, D> lower = w.lower, upper = w.upper;
      const auto d = static_cast<std::size_t>(w.direction);
      lower[d] = w.side == 0 ? 0 : block.extent.n[d] - 1;
      upper[d] = lower[d] + 1;
      for_each_index<D>(lower, upper, [&](const std::array<int, D>& index) {
        const Line<D> line(block, w, block.extent.at(index));
        const FaceFrame<D> frame(block, w, line);
        const auto relative = [&](std::size_t c) { return q[b].p[c] - block.reference_pressure[c]; };
        const double p0 = relative(line.inner[0]), p1 = relative(line.inner[1]);
        WallFace<D> face;
        face.pressure = pressure_on_face(w.condition, p0, p1, frame.d0, frame.outward_slope(p0, p1));
        face.friction = friction_on<D>(block, q[b], w, line.face, mu);
        face.distance = frame.d0;
        face.measure = frame.measure;
        double normal_force = 0.0;
        for (std::size_t k = 0; k < D; ++k) normal_force += face.friction[k] * frame.normal[k];
        for (std::size_t k = 0; k < D; ++k) {
          face.at[k] = 0.5 * (block.centre[k][line.inner[0]] + block.centre[k][line.ghost[0]]);
          face.area[k] = -frame.normal[k] * frame.measure;
          face.tangential_stress[k] = (face.friction[k] - normal_force * frame.normal[k]) / frame.measure;
        }
        if (phi == nullptr || keep_wet_part<D>(block, w, line, (*phi)[b], face)) body(w, face);
      });
    }
  }
}

template <int D>
void add(Load& load, const std::array<double, D>& at, const std::array<double, D>& push,
         const coupler::Vec3& about) {
  const coupler::Vec3 f = vector_in_space<D>(push), x = vector_in_space<D>(at);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
    load.force[k] += f[k];
    load.moment[k] += (x[l] - about[l]) * f[m] - (x[m] - about[m]) * f[l];
  }
}

}  // namespace

Load operator+(const Load& a, const Load& b) {
  Load sum = a;
  for (std::size_t k = 0; k < 3; ++k) {
    sum.force[k] += b.force[k];
    sum.moment[k] += b.moment[k];
  }
  return sum;
}

template <int D>
WallLoads wall_loads(const std::vector<Block<D>>& blocks, const Equations<D>& equations,
                     const std::vector<State<D>>& q, const std::string& wall, const coupler::Vec3& about,
                     const Ranks& ranks, const std::vector<Field>* phi) {
  WallLoads loads;
  const Fluid<D>& fluid = equations.fluid;
  for_each_wall_face<D>(blocks, equations, q, wall, phi, [&](const Window<D>&, const WallFace<D>& face) {
    const double reference = fluid.hydrostatic(face.at) - fluid.reference_pressure;
    std::array<double, D> push, weight;
    for (std::size_t k = 0; k < D; ++k) {
      push[k] = face.pressure * face.area[k];
      weight[k] = reference * face.area[k];
    }
    add<D>(loads.pressure, face.at, push, about);
    add<D>(loads.viscous, face.at, face.friction, about);
    add<D>(loads.hydrostatic, face.at, weight, about);
  });
  for (Load* load : {&loads.pressure, &loads.viscous, &loads.hydrostatic}) {
    ranks.sum(load->force);
    ranks.sum(load->moment);
  }
  return loads;
}

template <int D>
WallUnits wall_units(const std::vector<Block<D>>& blocks, const Equations<D>& equations,
                     const std::vector<State<D>>& q, const std::string& wall, const Ranks& ranks) {
  WallUnits units;
  const Fluid<D>& fluid = equations.fluid;
  if (fluid.viscosity == 0.0) return units;
  double measure = 0.0;
  for_each_wall_face<D>(
      blocks, equations, q, wall, nullptr, [&](const Window<D>& w, const WallFace<D>& face) {
        if (w.condition != Condition::wall) return;
        double stress2 = 0.0;
        for (const double t : face.tangential_stress) stress2 += t * t;
        const double y = face.distance * std::sqrt(std::sqrt(stress2) / fluid.density) / fluid.viscosity;
        units.largest = std::max(units.largest, y);
        units.mean += y * face.measure;
        measure += face.measure;
      });
  units.largest = ranks.largest(units.largest);
  std::array<double, 2> mean{units.mean, measure};
  ranks.sum(mean);
  units.mean = mean[1] > 0.0 ? mean[0] / mean[1] : 0.0;
  return units;
}

template WallLoads wall_loads<2>(const std::vector<Block<2>>&, const Equations<2>&,
                                 const std::vector<State<2>>&, const std::string&, const coupler::Vec3&,
                                 const Ranks&, const std::vector<Field>*);
template WallLoads wall_loads<3>(const std::vector<Block<3>>&, const Equations<3>&,
                                 const std::vector<State<3>>&, const std::string&, const coupler::Vec3&,
                                 const Ranks&, const std::vector<Field>*);
template WallUnits wall_units<2>(const std::vector<Block<2>>&, const Equations<2>&,
                                 const std::vector<State<2>>&, const std::string&, const Ranks&);
template WallUnits wall_units<3>(const std::vector<Block<3>>&, const Equations<3>&,
                                 const std::vector<State<3>>&, const std::string&, const Ranks&);

}  // namespace littoral::fv
