#include "physics/dynamics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "littoral/error.hpp"
#include "physics/riemann_fluxes.hpp"

namespace littoral::sph {
namespace {

constexpr double k_mirror_tolerance = 0.5;  // of dx: how far through a symmetry plane a particle may stray

template <int D>
bool is_closed(const DomainBox<D>& box) {
  for (const auto& sides : box.sides)
    for (const auto side : sides)
      if (side == support::Scene::Side::open) return false;
  return true;
}

template <int D>
bool any_moves(const Walls<D>* walls) {
  if (walls == nullptr) return false;
  const auto& bodies = walls->bodies();
  return std::any_of(bodies.begin(), bodies.end(), [](const Body& body) { return body.moves(); });
}

}  // namespace

template <int D>
Dynamics<D>::Dynamics(const Numerics<D>& numerics, const DomainBox<D>& box, OtherRanks<D>* others,
                      std::unique_ptr<Walls<D>> walls)
    : numerics_(numerics),
      others_(others),
      ghosts_(box, others),
      neighbors_(numerics.kernel_radius, numerics.skin),
      shifting_(numerics.reference_velocity),
      walls_(std::move(walls)),
      level_follows_(!numerics.free_surface),
      closed_(is_closed(box) && !any_moves(walls_.get())),
      may_be_open_water_(!numerics.free_surface && walls_ == nullptr &&
                         numerics.reconstruction != Reconstruction::first_order),
      pressure_level_(numerics.eos.p0) {
  if (numerics.precision == Precision::mixed) rows_.template emplace<PairRows<D, float>>();
  double g = 0.0;
  for (double component : numerics.gravity) g += std::fabs(component);
  if (g > 0.0) terms_.push_back(std::make_unique<Gravity<D>>(numerics.gravity));
  if (numerics.body_force) terms_.push_back(std::make_unique<BodyForce<D>>(*numerics.body_force));
  if (numerics.tension == Tension::switched) {
    auto term = std::make_unique<TensionSwitch<D>>(numerics.eos.p0);
    tension_ = term.get();
    terms_.push_back(std::move(term));
  }
  if (numerics.viscosity > 0.0)
    terms_.push_back(std::make_unique<Viscosity<D>>(numerics.eos.rho0 * numerics.viscosity));
}

template <int D>
double Dynamics<D>::stable_time_step() const {
  const double R = numerics_.kernel_radius;
  double dt = numerics_.cfl * R / numerics_.eos.c;
  if (numerics_.viscosity > 0.0) dt = std::min(dt, numerics_.viscous_cfl * R * R / numerics_.viscosity);
  if (most_acceleration_ > 0.0) dt = std::min(dt, numerics_.force_cfl * std::sqrt(R / most_acceleration_));
  return dt;
}

/// Lists are made anew on all ranks at once, when one of them needs it.
template <int D>
bool Dynamics<D>::outdated(const Particles<D>& particles, double t, double ahead) {
  const bool here = neighbors_.outdated(particles, t, ahead);
  return others_ != nullptr ? others_->any(here) : here;
}

namespace {

/// Side of the lists' cells that suits all particles of all ranks.
template <int D>
double cell_side(const Particles<D>& particles, double least, OtherRanks<D>* others) {
  std::array<double, 2 * D> bounds;  // - lower, upper
  bounds.fill(-std::numeric_limits<double>::infinity());
  for (std::size_t d = 0; d < D; ++d)
    for (std::size_t i = 0; i < particles.n_owned; ++i) {
      bounds[d] = std::max(bounds[d], -particles.x[d][i]);
      bounds[D + d] = std::max(bounds[D + d], particles.x[d][i]);
    }
  auto n = static_cast<double>(particles.n_owned);
  if (others != nullptr) {
    others->take_largest(bounds.data(), bounds.size());
    others->take_sum(&n, 1);
  }
  std::array<double, D> lower, upper;
  for (std::size_t d = 0; d < D; ++d) lower[d] = -bounds[d], upper[d] = bounds[D + d];
  return suitable_cell_side<D>(lower, upper, n, least);
}

}  // namespace

/// How far ahead the lists about to be made look: a step where particles come and go all the time.
template <int D>
void Dynamics<D>::look_ahead(const Particles<D>& particles, double dt, bool others_came) {
  double speed2 = 0.0, shift2 = 0.0;
  const auto n = static_cast<std::ptrdiff_t>(particles.n_owned);
#pragma omp parallel for schedule(static) reduction(max : speed2, shift2)
  for (std::ptrdiff_t row = 0; row < n; ++row) {
    const auto i = static_cast<std::size_t>(row);
    double u2 = 0.0, s2 = 0.0;
    for (std::size_t d = 0; d < D; ++d) {
      u2 += particles.u[d][i] * particles.u[d][i];
      s2 += particles.shift[d][i] * particles.shift[d][i];
    }
    if (!std::isfinite(u2)) continue;  // the end of the step names it
    speed2 = std::max(speed2, u2);
    shift2 = std::max(shift2, s2);
  }
  std::array<double, 3> most = {std::sqrt(speed2), std::sqrt(shift2), others_came ? 1.0 : 0.0};
  if (others_ != nullptr) others_->take_largest(most.data(), most.size());
  MotionBounds bounds;
  bounds.speed = most[0];
  bounds.shift = most[1];
  bounds.acceleration = most_acceleration_;
  if (most[2] > 0.0) bounds.steps = 1;
  neighbors_.set_outlook(suitable_outlook<D>(numerics_.kernel_radius, dt, bounds, numerics_.skin));
}

template <int D>
void Dynamics<D>::build_lists(Particles<D>& particles, double t) {
  ghosts_.create(particles, neighbors_.reach());
  neighbors_.build(particles, t, cell_side(particles, neighbors_.least_cell_side(), others_));
  if (walls_) {
    walls_->part(particles, neighbors_);
    walls_->build(particles, neighbors_.outlook().way());
  }
  ++work_.list_builds;
}

template <int D>
void Dynamics<D>::prepare(Particles<D>& particles, double t, StepHooks<D>* hooks, double dt) {
  {
    const PhaseSeconds::Scope scope(seconds_, Phase::lists);
    if (walls_) walls_->move_to(t);
    // Lists that would become outdated in the middle of the step are built now: only here can particles that
    // left through a periodic face be brought back, so that none goes further than the skin.
    if (outdated(particles, t, dt)) {
      const bool others_came = neighbors_.others_came(particles);  // migration apart
      work_.mirrored_back +=
          static_cast<std::int64_t>(ghosts_.bring_back(particles, k_mirror_tolerance * numerics_.spacing, t));
      if (others_ != nullptr) others_->migrate(particles);
      look_ahead(particles, dt > 0.0 ? dt : stable_time_step(), others_came);
      particles.permute(neighbors_.space_order(particles));
      build_lists(particles, t);
      surface_current_ = false;
    } else {
      ghosts_.refresh(particles);
      if (walls_ && walls_->outdated()) {
        walls_->build(particles, neighbors_.outlook().way());
        surface_current_ = false;  // the walls' support belongs to their rows
      }
    }
  }
  if (surface_current_) return;
  surface_current_ = true;
  if (walls_ && (numerics_.free_surface || numerics_.shifting)) {
    const PhaseSeconds::Scope scope(seconds_, Phase::walls);
    walls_->find_support(particles, neighbors_);
  }
  if (numerics_.free_surface) {
    const PhaseSeconds::Scope scope(seconds_, Phase::surface);
    // a step's shift is due next, of the same positions
    crowding_known_ = numerics_.shifting && dt > 0.0;
    surface_.detect(particles, neighbors_, ghosts_, walls_ ? &walls_->support() : nullptr, crowding_known_);
    if (hooks != nullptr) hooks->adjust_surface(particles, t);
    surface_.mark_near(particles, neighbors_, ghosts_);
  }
}

template <int D>
template <class Real>
void Dynamics<D>::pair_loops(const Particles<D>& particles, PairRows<D, Real>& rows) {
  const bool second_order = numerics_.reconstruction != Reconstruction::first_order;
  const KnownSlopes<D>* known = nullptr;
  if (walls_ && second_order) {
    const PhaseSeconds::Scope scope(seconds_, Phase::walls);
    known = &walls_->known_slopes(particles);
  }
  {
    const PhaseSeconds::Scope scope(seconds_, Phase::gradients);
    rows.pack_states(particles, Kernel<D>(numerics_.kernel_radius), pressure_level_);
    if (second_order) {
      compute_gradients(rows, neighbors_, known,
                        known != nullptr ? &walls_->gradients() : nullptr);  // (S3), (S13)
      ghosts_.refresh(rows);
    }
  }
  const PhaseSeconds::Scope scope(seconds_, Phase::fluxes);
  riemann_fluxes(particles, rows, neighbors_, numerics_.eos, numerics_.reconstruction, numerics_.riemann,
                 rate_);  // (S4)-(S7)
  work_.pairs += static_cast<std::int64_t>(neighbors_.n_pairs());
}

template <int D>
void Dynamics<D>::right_hand_side(Particles<D>& particles, double t) {
  {
    const PhaseSeconds::Scope scope(seconds_, Phase::lists);
    ghosts_.refresh(particles);
    if (outdated(particles, t, 0.0))
      build_lists(particles, t);  // in the middle of a step: no sorting
    else if (walls_ && walls_->outdated())
      walls_->build(particles, neighbors_.outlook().way());
  }
  if (walls_) {
    const PhaseSeconds::Scope scope(seconds_, Phase::walls);
    walls_->begin_stage(particles, t, others_);
  }
  std::visit([&](auto& rows) { pair_loops(particles, rows); }, rows_);
  if (walls_) {
    const PhaseSeconds::Scope scope(seconds_, Phase::walls);
    walls_->add_rates(particles, pressure_level_, rate_);  // (S12), (S14)
  }
  const PhaseSeconds::Scope scope(seconds_, Phase::terms);
  for (const auto& term : terms_) term->add(particles, neighbors_, t, rate_);
}

template <int D>
void Dynamics<D>::step(Particles<D>& particles, double t, double dt, StepHooks<D>* hooks) {
  if (hooks != nullptr) {
    const PhaseSeconds::Scope scope(seconds_, Phase::hooks);
    hooks->before_step(particles, t, dt);
  }
  prepare(particles, t, hooks, dt);
  if (numerics_.shifting) {
    const PhaseSeconds::Scope scope(seconds_, Phase::shift);
    shifting_.compute(particles, neighbors_, numerics_.free_surface ? &surface_ : nullptr,
                      walls_ ? &walls_->support() : nullptr, crowding_known_);  // (S10)
    crowding_known_ = false;
    if (hooks != nullptr) hooks->adjust_shift(particles, t);
  }
  remember_start(particles);
  const Stages stages = stages_of(numerics_.integrator);
  if (walls_) walls_->begin_step(dt);
  for (std::size_t k = 0; k < stages.count; ++k) {
    if (walls_) walls_->move_to(stages.time(k, t, dt));
    if (level_follows_) take_off(middle_pressure(particles));
    right_hand_side(particles, stages.time(k, t, dt));  // (S3)-(S8), (S12)-(S14)
    if (level_follows_ ? closed_ : may_be_open_water_) keep_volume(particles, !level_follows_);
    if (walls_) walls_->add_stage_loads(particles, stages[k].weight);
    const bool last = k + 1 == stages.count;
    {
      const PhaseSeconds::Scope scope(seconds_, Phase::update);
      update(particles, stages[k].advance, stages[k].weight, last, dt);
    }
    if (hooks != nullptr) {
      const PhaseSeconds::Scope scope(seconds_, Phase::hooks);
      hooks->after_stage(particles, t + stages[k].advance * dt);
    }
  }
  check(particles, t, dt);
  if (walls_) {
    const PhaseSeconds::Scope scope(seconds_, Phase::walls);
    walls_->move_to(t + dt);
    const std::size_t put_back =
        walls_->keep_out(particles, x_start_, k_mirror_tolerance * numerics_.spacing, t + dt);
    work_.kept_out += static_cast<std::int64_t>(put_back);
    if (put_back > 0 && walls_->any_sheet())
      neighbors_.forget();  // they may have been made while it was on the wrong side of a sheet
  }
  if (others_ != nullptr) others_->take_largest(&most_acceleration_, 1);
  ++work_.steps;
  work_.particle_steps += static_cast<std::int64_t>(particles.n_owned);
  if (hooks != nullptr) {
    const PhaseSeconds::Scope scope(seconds_, Phase::hooks);
    hooks->after_step(particles, t, dt);
  }
}

/// Takes the mean off the volumes' rates: water that fills a closed domain keeps its volume. (9) does not see
/// to that, for of each pair V_i V_j (u_j - u_i) . grad W_ij is left, which a flow that arranges its
/// particles (shear, strain) keeps above zero; the water would become denser and denser. In open faces, where
/// water comes and goes, what is taken off is the mean of the inside beyond that of div u by (S3), which no
/// arrangement changes; layers follow the partner whatever their rates.
template <int D>
void Dynamics<D>::keep_volume(const Particles<D>& particles, bool in_open_faces) {
  std::array<double, 2> sums{};  // of the rates, of V; in the order of the particles, whatever the threads
  const auto add_up = [&](const auto& rows) {
    for (std::size_t i = 0; i < particles.n_owned; ++i) {
      if (in_open_faces && particles.zone[i] != Zone::interior) continue;
      sums[0] += rate_.volume[i];
      if (in_open_faces) sums[0] -= particles.V[i] * rows.divergence(i);
      sums[1] += particles.V[i];
    }
  };
  std::visit(add_up, rows_);
  if (others_ != nullptr) others_->take_sum(sums.data(), sums.size());
  const double mean = sums[1] > 0.0 ? sums[0] / sums[1] : 0.0;
  for (std::size_t i = 0; i < particles.n_owned; ++i) rate_.volume[i] -= mean * particles.V[i];
}

/// Between the least and the largest pressure of all particles [Pa]: unlike a mean the same to the bit on any
/// number of ranks.
template <int D>
double Dynamics<D>::middle_pressure(const Particles<D>& particles) const {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  const auto n = static_cast<std::ptrdiff_t>(particles.n_owned);
#pragma omp parallel for schedule(static) reduction(min : low) reduction(max : high)
  for (std::ptrdiff_t row = 0; row < n; ++row) {
    const auto i = static_cast<std::size_t>(row);
    low = std::min(low, particles.p[i]);
    high = std::max(high, particles.p[i]);
  }
  std::array<double, 2> ends = {-low, high};
  if (others_ != nullptr) others_->take_largest(ends.data(), ends.size());
  return 0.5 * (ends[1] - ends[0]);
}

template <int D>
void Dynamics<D>::remember_start(const Particles<D>& particles) {
  const std::size_t n = particles.n_owned;
  const auto owned = [n](const std::vector<double>& column, std::vector<double>& copy) {
    copy.assign(column.begin(), column.begin() + static_cast<std::ptrdiff_t>(n));
  };
  for (std::size_t d = 0; d < D; ++d) {
    owned(particles.x[d], x_start_[d]);
    owned(particles.u[d], u_start_[d]);
    x_sum_[d].assign(n, 0.0);
    u_sum_[d].assign(n, 0.0);
  }
  owned(particles.V, V_start_);
  V_sum_.assign(n, 0.0);
}

template <int D>
void Dynamics<D>::update(Particles<D>& particles, double advance, double weight, bool last, double dt) {
  const auto n = static_cast<std::ptrdiff_t>(particles.n_owned);
  const LinearEos eos = numerics_.eos;
  surface_current_ = false;
  double most = 0.0;
#pragma omp parallel for schedule(static) reduction(max : most)
  for (std::ptrdiff_t row = 0; row < n; ++row) {
    const auto i = static_cast<std::size_t>(row);
    double a2 = 0.0;
    for (std::size_t d = 0; d < D; ++d) {
      const double dx = particles.u[d][i] + particles.shift[d][i];  // (8), (13)
      const double du = rate_.acceleration[d][i];
      x_sum_[d][i] += weight * dx;
      u_sum_[d][i] += weight * du;
      particles.x[d][i] = x_start_[d][i] + dt * (last ? x_sum_[d][i] : advance * dx);
      particles.u[d][i] = u_start_[d][i] + dt * (last ? u_sum_[d][i] : advance * du);
      a2 += du * du;
    }
    V_sum_[i] += weight * rate_.volume[i];
    particles.V[i] = V_start_[i] + dt * (last ? V_sum_[i] : advance * rate_.volume[i]);
    particles.rho[i] = particles.m[i] / particles.V[i];
    particles.p[i] = eos.pressure(particles.rho[i]);
    if (particles.zone[i] != Zone::driven) most = std::max(most, a2);  // a driven one is moved by FV
  }
  most_acceleration_ = std::sqrt(most);
}

template <int D>
void Dynamics<D>::check(const Particles<D>& particles, double t, double dt) const {
  const auto n = static_cast<std::ptrdiff_t>(particles.n_owned);
  std::ptrdiff_t first_bad = n;
#pragma omp parallel for schedule(static) reduction(min : first_bad)
  for (std::ptrdiff_t row = 0; row < n; ++row) {
    const auto i = static_cast<std::size_t>(row);
    double sum = particles.p[i];
    for (std::size_t d = 0; d < D; ++d) sum += particles.x[d][i] + particles.u[d][i];
    if (!(particles.V[i] > 0.0) || !std::isfinite(sum)) first_bad = std::min(first_bad, row);
  }
  if (first_bad == n) return;
  const auto i = static_cast<std::size_t>(first_bad);
  std::ostringstream text;
  text << "t = " << t + dt << " s: particle " << particles.id[i] << " started the step at (";
  for (std::size_t d = 0; d < D; ++d) text << (d ? ", " : "") << x_start_[d][i];
  text << ") m with velocity (";
  for (std::size_t d = 0; d < D; ++d) text << (d ? ", " : "") << u_start_[d][i];
  text << ") m/s and left it with volume " << particles.V[i] << " m^" << D << ", pressure " << particles.p[i]
       << " Pa. dt was " << dt
       << " s; try a lower time.cfl, or a higher sound speed if velocities come near it.";
  throw StabilityError(text.str());
}

template class Dynamics<2>;
template class Dynamics<3>;

}  // namespace littoral::sph
