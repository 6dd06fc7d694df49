#include "solver.hpp"

#include <omp.h>

#include <algorithm>
#include <limits>
#include <sstream>

#include "littoral/coupler/job.hpp"
#include "littoral/error.hpp"
#include "littoral/support/due.hpp"
#include "littoral/support/summary.hpp"
#include "littoral/support/timers.hpp"
#include "particles/lattice.hpp"
#include "particles/relaxation.hpp"
#include "prediction.hpp"

namespace littoral::sph {

template <int D>
Solver<D>::Solver(const RunConfig& config, const std::string& folder, support::Log& log,
                  std::unique_ptr<coupler::FvPartner> partner, const std::string& restart)
    : config_(config),
      folder_(folder),
      log_(log),
      partner_(std::move(partner)),
      dynamics_(numerics_of<D>(config), domain_of<D>(config)),
      layers_(region_of<D>(config, partner_ != nullptr)),
      restart_(restart.empty() ? std::nullopt : std::optional(read_run_state(restart, config.scene))),
      output_(folder, config, restart_) {
  if (partner_) driver_.emplace(config.scene, config.sph.coupling, dynamics_.numerics(), *partner_);
  if (restart_) {
    read_checkpoint(restart, config.scene, particles_, driver_ ? &driver_->hooks().exchange() : nullptr);
    time_ = last_checkpoint_ = restart_->time;
    window_ = restart_->window;
    dynamics_.set_most_acceleration(restart_->most_acceleration);
    log_.info("restart from " + restart + ", window " + std::to_string(window_));
  } else {
    place_particles();
  }
  log_.info(describe());
}

template <int D>
void Solver<D>::place_particles() {
  sph::place_particles<D>(config_, layers_, particles_);
  if (config_.sph.initial_distribution != Config::InitialDistribution::relaxed) return;
  relax(particles_, dynamics_.numerics(), domain_of<D>(config_));
  set_start_states(config_.scene, dynamics_.numerics().eos, particles_);
}

template <int D>
std::string Solver<D>::describe() const {
  const auto& numerics = dynamics_.numerics();
  std::ostringstream text;
  text << config_.scene.title << ": " << particles_.n_owned << " particles in " << D << "-D, spacing "
       << numerics.spacing << " m, kernel radius " << numerics.kernel_radius << " m, dt "
       << dynamics_.stable_time_step() << " s, " << omp_get_max_threads() << " threads, "
       << (partner_ ? partner_->description() : "alone");
  return text.str();
}

template <int D>
void Solver<D>::begin() {
  if (driver_) {
    if (!restart_) driver_->begin(particles_);
    driver_->announce(particles_);
  }
  if (restart_) return;
  dynamics_.prepare(particles_, time_, hooks());
  output_.write_rows(moment({}), particles_, dynamics_, layers_);
  output_.write_fields(time_, particles_);
}

template <int D>
void Solver<D>::run() {
  const double wall_begin = support::Timers::now();
  begin();
  for (;;) {
    const coupler::Agreement agreement = agree();
    if (agreement.stop) {
      stopped_because_ = agreement.reason;
      break;
    }
    coupler::set_place(agreement.window.index, agreement.window.t_begin);
    advance(agreement);
    write(agreement);
  }
  output_.write_fields_once(time_, particles_);
  if (partner_) partner_->goodbye(stopped_because_);
  write_summary(support::Timers::now() - wall_begin);
}

template <int D>
StepHooks<D>* Solver<D>::hooks() {
  return driver_ ? &driver_->hooks() : nullptr;
}

template <int D>
typename Output<D>::Moment Solver<D>::moment(const coupler::Window& window) const {
  typename Output<D>::Moment now;
  now.time = time_;
  now.dt = window.substep_dt();
  now.substeps = window.substeps;
  if (partner_) now.waited = partner_->waited();
  if (driver_) {
    now.ledger = driver_->ledger();
    now.exchanged = driver_->hooks().exchange().counts();
    now.layers = driver_->hooks().layer_count();
  }
  return now;
}

template <int D>
coupler::Agreement Solver<D>::agree() {
  const auto& end = config_.scene.time;
  coupler::Proposal mine;
  mine.dt_stable = dynamics_.stable_time_step();
  const int substeps = partner_ ? config_.scene.coupling.window.substeps : 1;
  const double next = support::expected_end(config_.scene, time_, substeps * mine.dt_stable);
  mine.write = output_.fields_due(next);
  mine.checkpoint = support::due(last_checkpoint_, next, end.checkpoint_interval);
  if (time_ >= end.end * (1.0 - 1e-12))
    mine.stop = true, mine.reason = "the end of the scene's time is reached";
  const std::int64_t first_window = restart_ ? restart_->window : 0;
  if (end.max_windows >= 0 && window_ >= first_window + end.max_windows)
    mine.stop = true, mine.reason = "time.max_windows is reached";
  if (partner_) return partner_->agree(mine);
  if (mine.stop) {
    coupler::Agreement last;
    last.stop = true;
    last.reason = mine.reason;
    return last;
  }
  coupler::Proposal nobody;
  nobody.dt_stable = std::numeric_limits<double>::infinity();
  return coupler::agree(mine, nobody, {std::nullopt, 1}, window_, time_, end.end);
}

template <int D>
void Solver<D>::advance(const coupler::Agreement& agreement) {
  const auto& window = agreement.window;
  if (driver_) {
    if (agreement.region_changed) driver_->announce(particles_);
    driver_->advance(agreement, particles_, dynamics_);
  } else {
    for (int k = 0; k < window.substeps; ++k)
      step(window.t_begin + k * window.substep_dt(), window.substep_dt());
  }
  time_ = window.t_end;
  window_ = window.index + 1;
}

template <int D>
void Solver<D>::write(const coupler::Agreement& agreement) {
  const auto& window = agreement.window;
  dynamics_.prepare(particles_, time_, hooks());
  output_.write_rows(moment(window), particles_, dynamics_, layers_);
  warn_of_layers();
  if (agreement.write) output_.write_fields(time_, particles_);
  if (agreement.checkpoint) write_checkpoint();
  std::ostringstream details;
  details << "dt " << window.substep_dt() << " s, " << particles_.n_owned << " particles";
  log_.progress(time_, config_.scene.time.end, details.str());
}

template <int D>
void Solver<D>::warn_of_layers() {
  const std::size_t without = driver_ ? driver_->hooks().layer_count().unreached : 0;
  const bool first = most_without_donors_ == 0;
  most_without_donors_ = std::max(most_without_donors_, without);
  if (without == 0 || !first) return;
  std::ostringstream text;
  text << "t = " << time_ << " s: " << without
       << " particles of the coupling layers lie where the partner has no water; they move freely until they "
          "reach it. Their number from now on: n_without_donors in scalars.csv";
  log_.warn(text.str());
}

template <int D>
void Solver<D>::write_checkpoint() {
  last_checkpoint_ = time_;
  RunState run;
  run.time = time_;
  run.window = window_;
  run.last_fields = output_.last_fields();
  run.most_acceleration = dynamics_.most_acceleration();
  run.scene_title = config_.scene.title;
  run.scene_digest = config_.scene.restart_digest;
  // what a checkpoint does not hold, this run makes anew as the restarted one will
  dynamics_.forget_lists();
  particles_.drop_ghosts();
  if (driver_) driver_->forget_hints(particles_);
  const ParticleExchange<D>* exchange = driver_ ? &driver_->hooks().exchange() : nullptr;
  sph::write_checkpoint(checkpoint_path(folder_, window_), run, particles_, exchange);
}

template <int D>
void Solver<D>::write_summary(double wall_time) {
  support::Summary summary;
  summary.program = "sph_solver";
  summary.version = LITTORAL_VERSION;
  summary.threads = omp_get_max_threads();
  summary.wall_time = wall_time;
  for (std::size_t phase = 0; phase < k_phase_names.size(); ++phase)
    summary.phases.emplace_back(k_phase_names[phase], dynamics_.seconds()[phase]);
  summary.phases.emplace_back("output", output_.seconds());
  summary.phases.emplace_back("wait", partner_ ? partner_->waited() : 0.0);
  const WorkCount& work = dynamics_.work();
  const double loops = dynamics_.seconds()[Phase::gradients] + dynamics_.seconds()[Phase::fluxes];
  const double pairs_per_second = loops > 0.0 ? static_cast<double>(work.pairs) / loops : 0.0;
  const double particle_steps_per_second =
      static_cast<double>(work.particle_steps) / std::max(1e-9, wall_time);
  summary.results = {{"particles", static_cast<double>(particles_.n_owned)},
                     {"steps", static_cast<double>(work.steps)},
                     {"end_time", time_},
                     {"list_builds", static_cast<double>(work.list_builds)},
                     {"mirrored_back", static_cast<double>(work.mirrored_back)},
                     {"most_without_donors", static_cast<double>(most_without_donors_)},
                     {"pairs_per_second", pairs_per_second},
                     {"particle_steps_per_second", particle_steps_per_second}};
  summary.notes = {{"scene", config_.scene.title},
                   {"digest", config_.scene.digest},
                   {"stopped because", stopped_because_}};
  summary.write(folder_ + "/summary.json");
  std::ostringstream text;
  text << work.steps << " steps in " << wall_time << " s: " << particle_steps_per_second * 1e-3
       << " thousand particle-steps/s, " << pairs_per_second * 1e-6
       << " million pairs/s (gradients and fluxes), lists built " << work.list_builds << " times";
  log_.info(text.str());
  if (work.mirrored_back > 0)
    log_.warn(
        std::to_string(work.mirrored_back) +
        " times a particle had crossed a symmetry plane by less than half a spacing and was mirrored back");
}

template class Solver<2>;
template class Solver<3>;

}  // namespace littoral::sph
