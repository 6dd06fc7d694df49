#include "coupling/coupled.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "coupling/carve.hpp"
#include "coupling/force_cells.hpp"
#include "grid/space.hpp"
#include "littoral/support/scene_warnings.hpp"
#include "littoral/support/timers.hpp"

namespace littoral::fv {

using coupler::Schedule;

template <int D>
Coupled<D>::Coupled(const support::Scene& scene, double forcing_constant,
                    std::unique_ptr<coupler::SphPartner> partner)
    : scene_(scene),
      forcing_constant_(forcing_constant),
      partner_(std::move(partner)),
      forced_(scene.coupling.kind == support::Scene::CouplingKind::forced) {}

template <int D>
void Coupled<D>::begin(Stepper<D>& stepper) {
  const Exchange<D>& exchange = stepper.exchange();
  const Carving carving = carve<D>(stepper.blocks(), exchange, scene_);
  stepper.seek_donors();
  for (const std::string& note : carving.notes) this->tell(note);
  column_depth_ = carving.column_depth;
  offer_.emplace(stepper.blocks(), exchange);
  check_layers_covered<D>(offer_->geometry(), scene_, exchange.ranks());
  interface_ = FringeFaces<D>(stepper.blocks(), exchange);
  cells_.emplace(stepper, forced_ ? CellStatus::forced : CellStatus::fringe);
  this->tell(forced_ ? std::to_string(carving.n_forced) + " cells forced by the particles"
                     : std::to_string(carving.n_fringe) + " cells imposed by the particles, " +
                           std::to_string(carving.n_blanked) + " blanked");
  offer_->geometry().epoch = cells_->targets().epoch = ++epoch_;
  partner_->offer(offer_->geometry(), cells_->targets());
}

template <int D>
std::optional<coupler::Agreement> Coupled<D>::agree(const coupler::Proposal& mine) {
  const coupler::Agreement agreement = partner_->agree(mine);
  if (agreement.region_changed && !agreement.stop) {  // the particles moved between ranks: they ask anew
    offer_->geometry().epoch = cells_->targets().epoch = ++epoch_;
    partner_->offer(offer_->geometry(), cells_->targets());
  }
  return agreement;
}

template <int D>
StepReport Coupled<D>::advance(const coupler::Window& window, Stepper<D>& stepper) {
  // all of the window that is neither waiting nor a step
  const auto others = [this] { return support::Timers::now() - waited() - stepping_seconds_; };
  const double before = others();
  StepReport report = advance_and_exchange(window, stepper);
  coupling_seconds_ += others() - before;
  return report;
}

template <int D>
StepReport Coupled<D>::advance_and_exchange(const coupler::Window& window, Stepper<D>& stepper) {
  warn_of_long_windows(window.dt());
  warn_of_many_substeps(window);
  const Schedule schedule = scene_.coupling.schedule.schedule;
  const double flux_before = flux_into_region(stepper);
  StepReport total;
  Values values;

  offer_->put_state(stepper, donors_);
  if (schedule == Schedule::predicted) {
    step(window, cells_->extrapolated(window.dt()), stepper, total, Solve::rough);
    offer_->put_state(stepper, result_);
    offer_->put_secant(result_, window.dt(), donors_);
    stepper.restore();
  } else {
    offer_->put_rates(stepper, donors_);
  }
  send(window);
  if (schedule == Schedule::concurrent) step(window, cells_->extrapolated(window.dt()), stepper, total);
  values = receive(window, stepper);
  if (schedule == Schedule::concurrent) {
    stepper.restore();
    step(window, values, stepper, total, Solve::correction);
  } else {
    step(window, values, stepper, total);
  }
  for (int pass = 1; pass < scene_.coupling.schedule.sph_passes(); ++pass) {
    offer_->put_state(stepper, result_);
    offer_->put_secant(result_, window.dt(), donors_);
    send(window);
    values = receive(window, stepper);
    stepper.restore();
    step(window, values, stepper, total);
  }
  cells_->accept(std::move(values), window.dt());

  const double flux_after = flux_into_region(stepper);
  mass_flux_ += 0.5 * window.dt() * (flux_before + flux_after);
  coupler::Ledger mine;
  mine.fv_mass_flux = mass_flux_;
  ledger_ = partner_->exchange(window, mine);
  return total;
}

template <int D>
double Coupled<D>::flux_into_region(const Stepper<D>& stepper) const {
  const FreeSurface<D>* surface = stepper.surface();
  return stepper.exchange().ranks().sum(interface_.flux(stepper.blocks(), stepper.exchange(), stepper.state(),
                                                        surface != nullptr ? &surface->phi() : nullptr,
                                                        &stepper.equations().fluid));
}

template <int D>
void Coupled<D>::send(const coupler::Window& window) {
  donors_.time = donors_.horizon_begin = window.t_begin;
  donors_.horizon_end = window.t_end;
  partner_->send(window, donors_);
}

template <int D>
std::vector<Imposed<D>> Coupled<D>::receive(const coupler::Window& window, const Stepper<D>& stepper) {
  partner_->receive(window, samples_);
  return cells_->received(stepper.blocks(), samples_, !forced_);
}

template <int D>
void Coupled<D>::step(const coupler::Window& window, const Values& values, Stepper<D>& stepper,
                      StepReport& total, Solve solve) {
  const double drop = stepper.tolerance().drop;
  if (solve != Solve::whole) stepper.tolerance().drop = std::sqrt(drop);
  const bool again = solve == Solve::correction;
  if (forced_) force_cells(*cells_, values, forcing_constant_, scene_.velocity_scale(), window.dt(), stepper);
  const Values none;
  const double begin = support::Timers::now();
  StepReport report = stepper.advance(window.dt(), forced_ ? none : values, again);
  stepping_seconds_ += support::Timers::now() - begin;
  stepper.tolerance().drop = drop;
  const int cycles = total.cycles + report.cycles;  // what the window cost, all tries together
  // a rough try is a guess, whatever it reached
  const bool converged =
      solve == Solve::rough || (report.converged && (total.norms.empty() || total.converged));
  total = std::move(report);
  total.cycles = cycles;
  total.converged = converged;
}

/// Extrapolation in time feeds the gravest acoustic mode of the water column, of period 4H/c, when a window
/// is too large a part of it.
template <int D>
void Coupled<D>::warn_of_long_windows(double dt) {
  constexpr double k_enough = 25.0;
  const Schedule schedule = scene_.coupling.schedule.schedule;
  if (warned_ || !(column_depth_ > 0.0) || (schedule != Schedule::serial && schedule != Schedule::concurrent))
    return;
  const double windows = 4.0 * column_depth_ / (scene_.fluid.sound_speed * dt);
  if (windows >= k_enough) return;
  warned_ = true;
  char text[320];
  std::snprintf(
      text, sizeof text,
      "schedule %s with windows of %.3g s: only %.1f of them in 4H/c (H = %.4g m, the water "
      "column); below %.0f extrapolation feeds the column's acoustic mode. Use predicted, or shorter "
      "windows",
      coupler::name(schedule), dt, windows, column_depth_, k_enough);
  this->warn(text);
}

/// Beyond what was ever compared with M = 1: a coupling.dt out of proportion (of substeps the scene itself
/// tells).
template <int D>
void Coupled<D>::warn_of_many_substeps(const coupler::Window& window) {
  if (warned_of_substeps_ || !scene_.coupling.window.dt || window.substeps <= support::k_too_many_substeps)
    return;
  warned_of_substeps_ = true;
  char text[240];
  std::snprintf(
      text, sizeof text,
      "a window of %.3g s takes %d substeps of the particles; up to %d were compared with M = 1. Is "
      "coupling.dt what you mean?",
      window.dt(), window.substeps, support::k_measured_substeps);
  this->warn(text);
}

template <int D>
void Coupled<D>::save(StateWriter<D>& file) const {
  file.put("fv_mass_flux", mass_flux_);
  cells_->save(file);
}

template <int D>
void Coupled<D>::load(const support::CheckpointReader& file) {
  mass_flux_ = file.number("fv_mass_flux");
  cells_->load(file);
}

template class Coupled<2>;
template class Coupled<3>;

}  // namespace littoral::fv
