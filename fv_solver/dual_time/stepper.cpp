#include "dual_time/stepper.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "boundary/ghosts.hpp"
#include "grid/between.hpp"
#include "grid/loops.hpp"
#include "grid/small_matrix.hpp"
#include "grid/space.hpp"
#include "littoral/error.hpp"

namespace littoral::fv {
namespace {

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

template <int D>
std::string place(const std::array<double, D>& x) {
  std::string text;
  for (const double value : x) {
    char number[32];
    std::snprintf(number, sizeof number, "%s%.4g", text.empty() ? "" : ", ", value);
    text += number;
  }
  return text;
}

const char* const k_advice = "try a smaller step, or the limiter.";

}  // namespace

template <int D>
Stepper<D>::Stepper(std::vector<Block<D>> blocks, const Equations<D>& equations,
                    std::unique_ptr<StepSolver<D>> inner, const InnerTolerance& tolerance,
                    const OversetLinks<D>& overset)
    : Stepper(std::move(blocks), Exchange<D>(blocks, overset), equations, std::move(inner), tolerance) {}

template <int D>
Stepper<D>::Stepper(std::vector<Block<D>>&& blocks, Exchange<D> exchange, const Equations<D>& equations,
                    std::unique_ptr<StepSolver<D>> inner, const InnerTolerance& tolerance)
    : blocks_(std::move(blocks)),
      exchange_(std::move(exchange)),
      equations_(equations),
      inner_(std::move(inner)),
      tolerance_(tolerance),
      forcing_(blocks_.size()),
      history_(blocks_.size()) {
  for (auto& block : blocks_) {
    check_windows(block);
    set_reference_pressure(block, equations_.fluid);
  }
  exchange_.share_references(blocks_);
  for (auto& level : level_) {
    level.resize(blocks_.size());
    for (std::size_t b = 0; b < blocks_.size(); ++b) level[b].resize(blocks_[b].extent.size);
  }
}

template <int D>
void Stepper<D>::initialise(const FlowFunction<D>& flow, double t) {
  time_ = t;
  known_ = 1;
  steps_ = 0;
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    State<D>& q = level_[0][b];
    for (std::size_t c = 0; c < blocks_[b].extent.size; ++c) {
      const PointState<D> s = flow(centre(blocks_[b], c), t);
      q.p[c] = s.p;
      for (std::size_t k = 0; k < D; ++k) q.u[k][c] = s.u[k];
    }
    evaluate_windows(blocks_[b], equations_, t);
  }
  exchange_.states(blocks_, level_[0]);
  check("This is the initial state: look at the scene's initial formulas.");
}

template <int D>
void Stepper<D>::set_surface(const Prescribed& surface, const LevelSetOptions& options) {
  for (auto& block : blocks_) evaluate_surface_windows(block, time_);
  surface_ = std::make_unique<FreeSurface<D>>(options);
  surface_->initialise(blocks_, exchange_, equations_, surface, time_, level_[0]);
}

template <int D>
void Stepper<D>::set_sponges(std::vector<Sponge<D>> sponges) {
  sponges_ = std::move(sponges);
  damping_.assign(blocks_.size(), {});
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const Block<D>& block = blocks_[b];
    Field rate(block.extent.size, 0.0);
    bool any = false;
    for_each_index<D>({}, block.extent.n, [&](const std::array<int, D>& index) {
      const std::ptrdiff_t c = block.extent.at(index);
      for (const Sponge<D>& sponge : sponges_)
        rate[static_cast<std::size_t>(c)] += sponge.strength(centre_in_space<D>(block, c));
      any = any || rate[static_cast<std::size_t>(c)] > 0.0;
    });
    if (any) damping_[b] = std::move(rate);
  }
}

/// u* at time t; where sponges overlap, the mean weighted with their strengths. The partner's cells are its
/// own.
template <int D>
void Stepper<D>::aim_sponges(double t) {
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    if (damping_[b].empty()) continue;
    const Block<D>& block = blocks_[b];
    if (!forcing_[b].active()) {  // else a partner's rates and targets stand there
      forcing_[b].rate.assign(block.extent.size, 0.0);
      forcing_[b].target.resize(block.extent.size);
    }
    for_each_index<D>({}, block.extent.n, [&](const std::array<int, D>& index) {
      const std::ptrdiff_t offset = block.extent.at(index);
      const auto c = static_cast<std::size_t>(offset);
      if (damping_[b][c] == 0.0 || block.status[c] == CellStatus::forced) return;
      forcing_[b].rate[c] = damping_[b][c];
      const coupler::Vec3 x = centre_in_space<D>(block, offset);
      for (std::size_t k = 0; k < D; ++k) {
        double sum = 0.0;
        for (const Sponge<D>& sponge : sponges_)
          if (sponge.velocity[k]) sum += sponge.strength(x) * sponge.velocity[k](x, t);
        forcing_[b].target.u[k][c] = sum / damping_[b][c];
      }
    });
  }
}

/// phi* at time t in the band; where zones overlap, the mean weighted with their strengths.
template <int D>
void Stepper<D>::aim_surface_sponges(double t) {
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    if (damping_[b].empty()) continue;
    const Block<D>& block = blocks_[b];
    SurfaceForcing& forcing = surface_->level_set().forcing[b];
    forcing.rate.resize(block.extent.size, 0.0);
    forcing.target.resize(block.extent.size, 0.0);
    for (const std::ptrdiff_t c : surface_->level_set().band.cells(b)) {
      const auto i = static_cast<std::size_t>(c);
      if (damping_[b][i] == 0.0 || block.status[i] == CellStatus::forced) continue;
      const coupler::Vec3 x = centre_in_space<D>(block, c);
      double rate = 0.0, sum = 0.0;
      for (const Sponge<D>& sponge : sponges_) {
        const double strength = sponge.surface ? sponge.strength(x) : 0.0;
        if (strength == 0.0) continue;
        rate += strength;
        sum += strength * distance_to<D>(sponge.surface, x, t, std::pow(block.volume[i], 1.0 / D));
      }
      forcing.rate[i] = rate;
      if (rate > 0.0) forcing.target[i] = sum / rate;
    }
  }
}

template <int D>
BackwardDifference Stepper<D>::scheme(double dt) const {
  return known_ > 1 ? BackwardDifference::second_order(dt, dt_[0]) : BackwardDifference::first_order(dt);
}

template <int D>
void Stepper<D>::set_history(const BackwardDifference& s, double t) {
  const Fluid<D>& fluid = equations_.fluid;
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const Block<D>& block = blocks_[b];
    const State<D>& now = level_[0][b];
    const State<D>& before = level_[1][b];  // weighted by a2, which is 0 in the first step
    History<D>& h = history_[b];
    h.resize(block.extent.size);
    for_each_index<D>({}, block.extent.n, [&](const std::array<int, D>& index) {
      const auto c = static_cast<std::size_t>(block.extent.at(index));
      const double reference = block.reference_pressure[c];
      h.mass[c] = fluid.inverse_c2 * (s.a1 * (now.p[c] - reference) + s.a2 * (before.p[c] - reference));
      const double m1 = s.a1 * fluid.rho(now.p[c]), m2 = s.a2 * fluid.rho(before.p[c]);
      for (std::size_t k = 0; k < D; ++k) h.momentum[k][c] = m1 * now.u[k][c] + m2 * before.u[k][c];
      if (!source_) return;
      const Source<D> source = source_(centre(block, c), t);
      h.mass[c] -= source.mass;
      for (std::size_t k = 0; k < D; ++k) h.momentum[k][c] -= source.momentum[k];
    });
  }
}

template <int D>
StepReport Stepper<D>::advance(double dt, const std::vector<Imposed<D>>& imposed, bool from_last_try) {
  if (!(dt > 0.0) || !std::isfinite(dt)) throw StabilityError("a time step of " + std::to_string(dt) + " s");
  const BackwardDifference s = scheme(dt);
  const double t = time_ + dt;
  set_history(s, t);

  const double w = known_ > 1 ? dt / dt_[0] : 0.0;
  std::vector<State<D>> next = std::move(level_[3]);  // holds the last try where that was given up
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    if (!from_last_try) next[b].p = level_[0][b].p;
    for (std::size_t k = 0; k < D && !from_last_try; ++k)
      for (std::size_t c = 0; c < next[b].p.size(); ++c)
        next[b].u[k][c] = level_[0][b].u[k][c] + w * (level_[0][b].u[k][c] - level_[1][b].u[k][c]);
    if (b < imposed.size()) {
      const Imposed<D>& values = imposed[b];
      for (std::size_t i = 0; i < values.cell.size(); ++i) {
        next[b].p[values.cell[i]] = values.p[i];
        for (std::size_t k = 0; k < D; ++k) next[b].u[k][values.cell[i]] = values.u[k][i];
      }
    }
    evaluate_windows(blocks_[b], equations_, t);
    carry_windows(blocks_[b], equations_, s, level_[0][b], level_[1][b]);
    if (surface_) evaluate_surface_windows(blocks_[b], t);
  }
  if (surface_) surface_->begin(blocks_, exchange_, s, w, imposed);
  if (!sponges_.empty()) aim_sponges(t);
  if (surface_ && damps_surface()) aim_surface_sponges(t);
  level_[3] = std::move(level_[2]);
  level_[2] = std::move(level_[1]);
  level_[1] = std::move(level_[0]);
  level_[0] = std::move(next);
  for (std::size_t k = 3; k > 0; --k) dt_[k] = dt_[k - 1];
  dt_[0] = dt;
  known_ = std::min(known_ + 1, 4);
  time_before_ = time_;
  time_ = t;
  ++steps_;

  const StepProblem<D> problem{blocks_,  exchange_,      equations_, s,       history_,
                               forcing_, surface_.get(), t,          &phases_};
  StepReport report;
  try {
    report = inner_->solve(problem, tolerance_, level_[0]);
  } catch (const StabilityError& lost) {
    check(size_of_step(dt) + "; " + k_advice);  // names place and state where they show it
    throw StabilityError(std::string(lost.what()) + "; " + size_of_step(dt));
  }
  if (surface_)
    problem.timed(StepPhases::surface, [&] { surface_->end(blocks_, exchange_, equations_, level_[0]); });
  check(size_of_step(dt) + "; " + k_advice);
  return report;
}

/// For a message: a step that lets the surface pass several cells is what most often ends a run.
template <int D>
std::string Stepper<D>::size_of_step(double dt) const {
  std::string text = "dt was " + number(dt) + " s";
  if (surface_)
    text += ", " + number(dt * surface_->rate()) + " surface Courant numbers with the velocities before it";
  return text;
}

template <int D>
void Stepper<D>::restore() {
  std::vector<State<D>> spare = std::move(level_[0]);
  for (std::size_t k = 0; k < 3; ++k) {
    level_[k] = std::move(level_[k + 1]);
    dt_[k] = dt_[k + 1];
  }
  level_[3] = std::move(spare);
  // the oldest level was overwritten if the ring was full; what a step and its derivative need is still there
  known_ = std::min(known_ - 1, 3);
  time_ = time_before_;
  --steps_;
  for (auto& block : blocks_) evaluate_windows(block, equations_, time_);
  if (surface_) surface_->restore(blocks_, exchange_);
}

template <int D>
void Stepper<D>::time_derivative(std::size_t b, State<D>& rate) const {
  const Block<D>& block = blocks_[b];
  const State<D>& now = level_[0][b];
  rate.resize(block.extent.size);
  if (known_ > 1) {
    const BackwardDifference s = known_ > 2 ? BackwardDifference::second_order(dt_[0], dt_[1])
                                            : BackwardDifference::first_order(dt_[0]);
    const auto combine = [&](Field& out, const Field& q0, const Field& q1, const Field& q2) {
      for (std::size_t c = 0; c < out.size(); ++c) out[c] = s.a0 * q0[c] + s.a1 * q1[c] + s.a2 * q2[c];
    };
    combine(rate.p, now.p, level_[1][b].p, level_[2][b].p);
    for (std::size_t k = 0; k < D; ++k) combine(rate.u[k], now.u[k], level_[1][b].u[k], level_[2][b].u[k]);
    return;
  }
  History<D> none;
  none.resize(block.extent.size);
  Residual<D> r;
  if (surface_) {
    const BlockSurface<D> cut = surface_->block(b);
    equations_.residual(block, now, BackwardDifference::steady(), none, Forcing<D>{}, r, &cut);
  } else {
    equations_.residual(block, now, BackwardDifference::steady(), none, Forcing<D>{}, r);
  }
  const Fluid<D>& fluid = equations_.fluid;
  for_each_index<D>({}, block.extent.n, [&](const std::array<int, D>& index) {
    const auto c = static_cast<std::size_t>(block.extent.at(index));
    // without a pressure in balance the incompressible residual is no acceleration: leave the rates at 0
    if (fluid.inverse_c2 == 0.0) return;
    const double density_rate = -r.mass[c] / block.volume[c];
    rate.p[c] = density_rate / fluid.inverse_c2;
    for (std::size_t k = 0; k < D; ++k)
      rate.u[k][c] = (-r.momentum[k][c] / block.volume[c] - now.u[k][c] * density_rate) / fluid.rho(now.p[c]);
  });
}

template <int D>
void Stepper<D>::recall(const Memory& memory) {
  level_ = memory.level;
  dt_ = memory.dt;
  known_ = memory.known;
  steps_ = memory.steps;
  time_ = memory.time;
  for (auto& block : blocks_) evaluate_windows(block, equations_, time_);
  if (surface_) surface_->recall(blocks_, exchange_, memory.surface);
}

template <int D>
void Stepper<D>::check(const std::string& advice) const {
  try {
    exchange_.ranks().template together<StabilityError>([&] { check_own(advice); });
  } catch (const StabilityError& lost) {  // on all ranks
    throw StabilityError(lost.what() + fastest_before());
  }
}

/// For a message: where a run is lost, all cells of a block are in the same step; a step before, it shows in
/// one.
template <int D>
std::string Stepper<D>::fastest_before() const {
  struct Fastest {
    double speed = 0.0;
    std::array<double, D> x{};
  } here;
  for (std::size_t b = 0; b < blocks_.size(); ++b)
    for_each_index<D>({}, blocks_[b].extent.n, [&](const std::array<int, D>& index) {
      const auto c = static_cast<std::size_t>(blocks_[b].extent.at(index));
      std::array<double, D> u{};
      for (std::size_t k = 0; k < D; ++k) u[k] = level_[1][b].u[k][c];
      const double speed = blocks_[b].solved[c] != 0.0 ? std::sqrt(dot(u, u)) : 0.0;
      if (speed > here.speed) here = {speed, centre<D>(blocks_[b], static_cast<std::ptrdiff_t>(c))};
    });
  Fastest all;
  for (const Fastest& part : exchange_.ranks().gather(std::vector<Fastest>{here}))
    if (part.speed > all.speed) all = part;
  if (!(all.speed > 0.0)) return "";
  return " A step before, the fastest cell had " + number(all.speed) + " m/s, at (" + place<D>(all.x) +
         ") m.";
}

template <int D>
void Stepper<D>::check_own(const std::string& advice) const {
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const Block<D>& block = blocks_[b];
    const State<D>& q = level_[0][b];
    for_each_index<D>({}, block.extent.n, [&](const std::array<int, D>& index) {
      const auto c = static_cast<std::size_t>(block.extent.at(index));
      double speed2 = 0.0;
      for (std::size_t k = 0; k < D; ++k) speed2 += q.u[k][c] * q.u[k][c];
      const double rho = equations_.fluid.rho(q.p[c]);
      if (std::isfinite(speed2) && std::isfinite(rho) && rho > 0.0) return;
      char text[256];
      std::snprintf(
          text, sizeof text,
          "t = %.6g s: density %.3g kg/m^3, p = %.3g Pa, |u| = %.3g m/s in block '%s' cell %s at (%s) m. ",
          time_, rho, q.p[c], std::sqrt(speed2), block.name.c_str(), cell_name<D>(block, index).c_str(),
          place<D>(centre<D>(block, static_cast<std::ptrdiff_t>(c))).c_str());
      throw StabilityError(std::string(text) + advice);
    });
  }
}

template class Stepper<2>;
template class Stepper<3>;

}  // namespace littoral::fv
