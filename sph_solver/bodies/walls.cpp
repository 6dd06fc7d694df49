#include "bodies/walls.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include "bodies/nearest_image.hpp"
#include "bodies/wall_gradients.hpp"
#include "bodies/wall_view.hpp"
#include "bodies/wall_viscosity.hpp"
#include "littoral/error.hpp"
#include "physics/kernel.hpp"

namespace littoral::sph {
namespace {

std::vector<BodyState> states_of(const std::vector<Body>& bodies) {
  std::vector<BodyState> states;
  for (const Body& body : bodies) states.push_back(body.state());
  return states;
}

/// A state of its own for each dummy of a wall that bends gives energy to water which slides along it, at any
/// spacing.
template <int D>
void require_plane_walls(const std::vector<Body>& bodies, const Dummies<D>& dummies) {
  for (std::size_t e = 0; e < dummies.size(); ++e)
    if (dummies[e].patch >= 0)
      throw ConfigError("wall_states: extrapolated is for plane walls only, and body '" +
                        bodies[static_cast<std::size_t>(dummies[e].body)].name() +
                        "' is curved: water sliding along it would gain energy. Use linear.");
}

}  // namespace

template <int D>
Walls<D>::Walls(std::vector<Body> bodies, const Numerics<D>& numerics, const DomainBox<D>& box,
                const Lattice<D>& lattice)
    : numerics_(numerics),
      box_(box),
      bodies_(std::move(bodies)),
      most_reach_(numerics.kernel_radius + 2.5 * numerics.skin),
      sheets_(bodies_),
      dummies_(bodies_, box, lattice, numerics.kernel_radius),
      loads_(bodies_.size()) {
  for (const Body& body : bodies_) {
    sticks_.push_back(body.sticks() && numerics.viscosity > 0.0);
    any_sticks_ = any_sticks_ || sticks_.back();
    any_moves_ = any_moves_ || body.moves();
  }
  dummies_.place(bodies_, most_reach_);
  at_step_ = states_of(bodies_);
  if (numerics.wall_states == WallStates::extrapolated) require_plane_walls<D>(bodies_, dummies_);
}

template <int D>
void Walls<D>::move_to(double t) {
  if (!any_moves_ || t == time_) return;  // stages of one time follow each other
  time_ = t;
  for (Body& body : bodies_) body.move_to(t);
  dummies_.refresh(bodies_);
  for (std::size_t e = 0; e < dummies_.size(); ++e) {
    const auto u = dummies_[e].u;
    const double speed = std::sqrt(dot_of<D>(u, u));
    if (speed <= numerics_.eos.c) continue;
    std::ostringstream text;
    text << "t = " << t << " s: body '" << bodies_[static_cast<std::size_t>(dummies_[e].body)].name()
         << "' moves at " << speed << " m/s, faster than sound (" << numerics_.eos.c
         << " m/s). Weakly compressible water allows about a tenth of it: a higher fluid.sound_speed, or a "
            "slower "
            "motion.";
    throw StabilityError(text.str());
  }
}

template <int D>
bool Walls<D>::outdated() const {
  if (!built_) return true;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    if (!bodies_[b].moves()) continue;
    // corners of its box and its origin: with them every point of the body has moved by at most half a skin
    auto corners = bodies_[b].local_bounds();
    if constexpr (D == 2) corners[0][1] = corners[1][1] = 0.0;
    const BodyState &now = bodies_[b].state(), &then = at_build_[b];
    for (std::size_t k = 0; k < 8; ++k) {
      const Vector3 c = {corners[k & 1][0], corners[(k >> 1) & 1][1], corners[k >> 2][2]};
      const Vector3 moved = now.position + now.rotation(c) - then.position - then.rotation(c);
      if (!(norm(moved) <= 0.5 * numerics_.skin)) return true;
    }
  }
  return false;
}

template <int D>
void Walls<D>::build(const Particles<D>& particles, double way) {
  if (any_moves_) dummies_.place(bodies_, most_reach_);
  // Where bodies move these are made anew besides, when particles may already be at one end of their way, and
  // live until a body has moved by half a skin.
  const double further = any_moves_ ? 2.0 * way + 0.5 * numerics_.skin : way;
  list_.build(particles, dummies_, bodies_, sheets_, numerics_.kernel_radius + further);
  if (numerics_.wall_states == WallStates::extrapolated) states_.build(list_, dummies_);
  at_build_ = states_of(bodies_);
  built_ = true;
}

namespace {

/// The surface of `body` that a particle has gone through in a step from `start`, if it has: its distance
/// [m] < 0.
template <int D>
std::optional<SurfacePoint> gone_through(const Body& body, const BodyState& at_start, const Vector3& start,
                                         const Vector3& x) {
  if (!body.is_sheet()) {
    const SurfacePoint wall = body.closest_wall(x);
    return wall.distance < 0.0 ? std::optional(wall) : std::nullopt;
  }
  const Vector3 from = at_start.rotation.inverse()(start - at_start.position), to = body.to_local(x);
  if (Body::side(from) == Body::side(to) || !body.passage(from, to)) return std::nullopt;
  const Vector3 normal = body.state().rotation(Vector3{0.0, 0.0, -Body::side(from)});
  const double depth = std::fabs(to[2]);
  return SurfacePoint{x - depth * normal, normal, -depth, -1};
}

}  // namespace

template <int D>
std::size_t Walls<D>::keep_out(Particles<D>& particles, const std::array<std::vector<double>, D>& start,
                               double tolerance, double time) {
  const auto in_front = [&](std::size_t e, std::size_t i) {
    double d = 0.0;
    for (std::size_t k = 0; k < D; ++k)
      d += (dummies_[e].wall[k] - particles.x[k][i]) * dummies_[e].normal[k];
    return d >= 0.0;
  };
  std::vector<char> suspect(list_.n_rows(), 0);  // behind the plane of one of its dummies
  const auto n = static_cast<std::ptrdiff_t>(list_.n_rows());
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t k = 0; k < n; ++k) {
    const auto row = static_cast<std::size_t>(k);
    for (std::size_t pair = list_.begin(row); pair < list_.end(row) && !suspect[row]; ++pair)
      suspect[row] = !in_front(list_.dummy(pair), list_.particle(row));
  }
  std::size_t n_put_back = 0;
  for (std::size_t row = 0; row < list_.n_rows(); ++row) {
    if (!suspect[row]) continue;
    const std::size_t i = list_.particle(row);
    std::int32_t last = -1;
    for (std::size_t pair = list_.begin(row); pair < list_.end(row); ++pair) {
      const std::size_t e = list_.dummy(pair);
      if (dummies_[e].body == last) continue;  // tested already
      if (in_front(e, i)) continue;
      last = dummies_[e].body;
      const auto b = static_cast<std::size_t>(last);
      const Vector3 here = in_scene<D>(at<D>(particles.x, i)),
                    across = to_nearest_image<D>(box_, bodies_[b], here), x = here + across;
      const auto wall = gone_through<D>(bodies_[b], at_step_[b], in_scene<D>(at<D>(start, i)) + across, x);
      if (!wall) continue;
      const Vector3 u = in_scene<D>(at<D>(particles.u, i));
      if (!(-wall->distance <= tolerance)) {
        std::ostringstream text;
        text << "t = " << time << " s: particle " << particles.id[i] << " at (" << here[0] << ", " << here[1]
             << ", " << here[2] << ") m, velocity (" << u[0] << ", " << u[1] << ", " << u[2] << ") m/s, went "
             << -wall->distance << " m deep into body '" << bodies_[b].name()
             << "', more than half a spacing (" << tolerance
             << " m). Try a lower time.cfl, a higher fluid.sound_speed or a smaller spacing.";
        throw StabilityError(text.str());
      }
      const double into = dot(u - bodies_[b].state().velocity_at(wall->point), wall->normal);
      const Vector3 back = 2.0 * std::max(0.0, into) * wall->normal;
      const auto to = in_plane<D>(here + 2.0 * wall->distance * wall->normal), slower = in_plane<D>(u - back);
      for (std::size_t d = 0; d < D; ++d) {
        particles.x[d][i] = to[d];
        particles.u[d][i] = slower[d];
      }
      const Vector3 force = (particles.m[i] / dt_) * back;
      loads_[b].pressure = loads_[b].pressure + force;
      loads_[b].pressure_moment =
          loads_[b].pressure_moment + cross(wall->point - bodies_[b].state().position, force);
      ++n_put_back;
    }
  }
  return n_put_back;
}

template <int D>
void Walls<D>::begin_stage(const Particles<D>& particles, double t, OtherRanks<D>* others) {
  mass_force_.assign(list_.n_rows(), numerics_.gravity);
  if (numerics_.body_force) {
    const auto n = static_cast<std::ptrdiff_t>(list_.n_rows());
#pragma omp parallel
    {
      auto mine = *numerics_.body_force;  // a formula remembers its arguments: each thread needs its own
#pragma omp for schedule(static)
      for (std::ptrdiff_t k = 0; k < n; ++k) {
        const auto row = static_cast<std::size_t>(k);
        const Vector3 x = in_scene<D>(at<D>(particles.x, list_.particle(row)));
        for (std::size_t d = 0; d < D; ++d) mass_force_[row][d] += mine[d](x[0], x[1], x[2], t);
      }
    }
  }
  if (numerics_.wall_states == WallStates::extrapolated)
    states_.extrapolate(particles, dummies_, list_, mass_force_, numerics_.kernel_radius, others);
}

template <int D>
const KnownSlopes<D>& Walls<D>::known_slopes(const Particles<D>& particles) {
  find_known_slopes<D>(particles, bodies_, dummies_, list_, mass_force_, numerics_.kernel_radius, known_);
  return known_;
}

template <int D>
void Walls<D>::add_rates(const Particles<D>& particles, double level, Rate<D>& rate) {
  level_ = level;
  add_wall_fluxes<D>(particles, gradients_, bodies_, dummies_, states_, list_, mass_force_, numerics_, level,
                     bodies_.size(), rate, pressure_);
  if (any_sticks_)
    add_wall_friction<D>(particles, gradients_, bodies_, dummies_, list_, numerics_, sticks_, rate,
                         friction_);
}

template <int D>
void Walls<D>::find_support(const Particles<D>& particles, const NeighborList<D>& neighbors) {
  support_.find(particles, neighbors, bodies_, box_, dummies_, list_, numerics_.spacing,
                numerics_.free_surface);
}

template <int D>
void Walls<D>::begin_step(double dt) {
  at_step_ = states_of(bodies_);
  sensors_.begin_step();
  loads_.assign(bodies_.size(), {});
  dt_ = dt;
}

template <int D>
void Walls<D>::add_stage_loads(const Particles<D>& particles, double weight) {
  const std::size_t n_bodies = bodies_.size();
  const auto add = [&](const RowForces<D>& forces, Vector3 BodyLoad::*force, Vector3 BodyLoad::*moment) {
    for (std::size_t row = 0; row < list_.n_rows(); ++row) {
      const Vector3 x = in_scene<D>(at<D>(particles.x, list_.particle(row)));
      for (std::size_t b = 0; b < n_bodies; ++b) {
        const Vector3 f = weight * in_scene<D>(forces[row * n_bodies + b]);
        loads_[b].*force = loads_[b].*force + f;
        // the reaction to a force that acts at the particle: angular momentum is kept as well
        const Vector3 arm = nearest_image<D>(box_, bodies_[b], x) - bodies_[b].state().position;
        loads_[b].*moment = loads_[b].*moment + cross(arm, f);
      }
    }
  };
  add(pressure_, &BodyLoad::pressure, &BodyLoad::pressure_moment);
  if (any_sticks_) add(friction_, &BodyLoad::viscous, &BodyLoad::viscous_moment);
  sensors_.add(particles, list_, pressure_, n_bodies, weight);
}

template <int D>
double Walls<D>::coverage(const std::array<double, D>& x) const {
  const Kernel<D> kernel(numerics_.kernel_radius);
  double sum = 0.0;
  list_.for_each_near(x, kernel.R + numerics_.skin, [&](std::size_t e) {
    if (!sheets_.none() && !sheets_.shows(bodies_, dummies_, e, x)) return;
    double r2 = 0.0;
    for (std::size_t d = 0; d < D; ++d) r2 += (dummies_[e].x[d] - x[d]) * (dummies_[e].x[d] - x[d]);
    sum += dummies_.volume() * kernel.value(std::sqrt(r2));
  });
  return sum;
}

template <int D>
const Body* Walls<D>::holder(const std::array<double, D>& x) const {
  const Vector3 place = in_scene<D>(x);
  const auto found = std::find_if(bodies_.begin(), bodies_.end(), [&](const Body& body) {
    return body.closest_wall(nearest_image<D>(box_, body, place)).distance <= k_on_body * numerics_.spacing;
  });
  return found == bodies_.end() ? nullptr : &*found;
}

template <int D>
bool Walls<D>::inside(const std::array<double, D>& x) const {
  return holder(x) != nullptr;
}

template class Walls<2>;
template class Walls<3>;

}  // namespace littoral::sph
