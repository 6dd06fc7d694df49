#include "solver.hpp"

#include <omp.h>

#include <algorithm>
#include <limits>
#include <sstream>

#include "coupling/bodies_in_layers.hpp"
#include "littoral/coupler/job.hpp"
#include "littoral/error.hpp"
#include "littoral/support/checkpoint.hpp"
#include "littoral/support/due.hpp"
#include "littoral/support/summary.hpp"
#include "littoral/support/timers.hpp"
#include "parallel/gather_mpi.hpp"
#include "particles/lattice.hpp"
#include "particles/relaxation.hpp"
#include "prediction.hpp"

namespace littoral::sph {

namespace {

/// The other ranks, or null where there are none.
template <int D>
std::unique_ptr<MpiRanks<D>> ranks_of(MPI_Comm comm, const DomainBox<D>& box) {
  int size = 1;
  MPI_Comm_size(comm, &size);
  return size > 1 ? std::make_unique<MpiRanks<D>>(comm, box) : nullptr;
}

}  // namespace

template <int D>
Solver<D>::Solver(const RunConfig& config, const std::string& folder, support::Log& log,
                  std::unique_ptr<coupler::FvPartner> partner, const std::string& restart, MPI_Comm comm)
    : config_(config),
      folder_(folder),
      log_(log),
      partner_(std::move(partner)),
      ranks_(ranks_of<D>(comm, domain_of<D>(config))),
      layers_(region_of<D>(config, partner_ != nullptr)),
      dynamics_(numerics_of<D>(config), domain_of<D>(config), ranks_.get(),
                walls_of<D>(config, layers_.boxes()[0].outer_lower)),
      restart_(restart.empty() ? std::nullopt : std::optional(read_run_state(restart, config.scene))),
      output_(folder, config, restart_, ranks_.get(), dynamics_.walls()) {
  if (partner_) driver_.emplace(config.scene, config.sph.coupling, dynamics_.numerics(), *partner_);
  // with a partner space is divided anew between windows only, when the partner can be told
  if (ranks_ && !partner_) ranks_->balance_with_migration(config.sph.load_drift);
  if (restart_) {
    read_particles(restart);
    time_ = last_checkpoint_ = restart_->time;
    window_ = restart_->window;
    dynamics_.set_most_acceleration(restart_->most_acceleration);
    log_.info("restart from " + restart + ", window " + std::to_string(window_));
  } else {
    place_particles();
  }
  n_particles_ = n_particles();
  log_.info(describe());
}

template <int D>
void Solver<D>::read_particles(const std::string& restart) {
  const CheckpointShare share = ranks_ ? CheckpointShare{ranks_->rank(), ranks_->size()} : CheckpointShare{};
  read_checkpoint(restart, config_.scene, particles_, driver_ ? &driver_->hooks().exchange() : nullptr,
                  share);
  if (!ranks_) return;
  if (restart_->rank_counts.size() == static_cast<std::size_t>(share.size)) {
    ranks_->set_regions(Regions<D>::unpack(restart_->regions));
    ranks_->set_load(restart_->load);
  } else {
    ranks_->balance(particles_);
  }
}

template <int D>
std::int64_t Solver<D>::n_particles() {
  return ranks_ ? ranks_->total(particles_) : static_cast<std::int64_t>(particles_.n_owned);
}

template <int D>
void Solver<D>::place_particles() {
  const LatticeShare share = ranks_ ? LatticeShare{ranks_->rank(), ranks_->size()} : LatticeShare{};
  sph::place_particles<D>(config_, layers_, dynamics_.walls(), particles_, share);
  if (starts_empty(config_, particles_, partner_ != nullptr)) log_.warn(k_starts_empty);
  if (ranks_) ranks_->balance(particles_);
  if (config_.sph.initial_distribution != Config::InitialDistribution::relaxed) return;
  relax(particles_, dynamics_.numerics(), domain_of<D>(config_), ranks_.get());
  set_start_states(config_.scene, dynamics_.numerics().eos, particles_);
}

template <int D>
std::string Solver<D>::describe() {
  const auto& numerics = dynamics_.numerics();
  std::ostringstream text;
  text << config_.scene.title << ": " << n_particles_ << " particles in " << D << "-D, spacing "
       << numerics.spacing << " m, kernel radius " << numerics.kernel_radius << " m, dt "
       << dynamics_.stable_time_step() << " s, "
       << (ranks_ ? std::to_string(ranks_->size()) + " ranks of " : "") << omp_get_max_threads()
       << " threads, " << (partner_ ? partner_->description() : "alone");
  return text.str();
}

template <int D>
void Solver<D>::begin() {
  if (driver_) {
    driver_->divide_among(ranks_.get());
    if (!restart_) driver_->begin(particles_);
    announce();
  }
  if (restart_) return;
  keep_layers_clear();
  dynamics_.prepare(particles_, time_, hooks(), dynamics_.stable_time_step());
  output_.write_rows(moment({}), particles_, dynamics_, layers_);
  output_.write_fields(time_, particles_);
}

template <int D>
void Solver<D>::keep_layers_clear() {
  if (!driver_ || dynamics_.walls() == nullptr) return;
  const std::string fault =
      body_in_the_layers<D>(*dynamics_.walls(), layers_, driver_->hooks().exchange().elements());
  if (fault.empty()) return;
  std::ostringstream text;
  text << "t = " << time_ << " s: " << fault;
  throw ConfigError(text.str());
}

template <int D>
void Solver<D>::announce() {
  driver_->announce(particles_);
  if (!ranks_) return;
  const RankBox<D> interest = driver_->interest();
  dynamics_.ghosts().set_interest(interest.lower, interest.upper);
  dynamics_.forget_lists();
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
  divide_anew_ = ranks_ && partner_ && ranks_->unbalanced(particles_, config_.sph.load_drift);
  mine.region_changed = divide_anew_;
  if (partner_) return partner_->agree(mine);  // which also counts time.max_windows
  const std::int64_t first_window = restart_ ? restart_->window : 0;
  if (end.max_windows >= 0 && window_ >= first_window + end.max_windows)
    mine.stop = true, mine.reason = "time.max_windows is reached";
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
    if (divide_anew_) {
      ranks_->balance(particles_);
      driver_->divide_among(ranks_.get());
    }
    if (agreement.region_changed) announce();
    driver_->advance(agreement, particles_, dynamics_);
    keep_layers_clear();
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
  // for the next step as well, which then finds lists and surface as they are
  dynamics_.prepare(particles_, time_, hooks(), dynamics_.stable_time_step());
  output_.write_rows(moment(window), particles_, dynamics_, layers_);
  n_particles_ = n_particles();
  warn_of_layers();
  if (agreement.write) output_.write_fields(time_, particles_);
  if (agreement.checkpoint) write_checkpoint();
  std::ostringstream details;
  details << "dt " << window.substep_dt() << " s, " << n_particles_ << " particles";
  log_.progress(time_, config_.scene.time.end, details.str());
}

template <int D>
void Solver<D>::warn_of_layers() {
  if (!driver_) return;
  std::size_t without = driver_->hooks().layer_count().unreached;
  if (ranks_) {
    auto of_all = static_cast<double>(without);
    ranks_->take_sum(&of_all, 1);
    without = static_cast<std::size_t>(of_all);
  }
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
  const std::string path = support::checkpoint_path(folder_, window_);
  if (!ranks_) {
    sph::write_checkpoint(path, run, particles_, exchange);
    return;
  }
  run.regions = ranks_->regions().pack();
  run.load = ranks_->load();
  const Particles<D> all = gather_on_root(particles_, ranks_->comm(), &run.rank_counts);
  if (ranks_->rank() == 0) sph::write_checkpoint(path, run, all, exchange);
}

/// What one rank did, summed or the slowest's: on all ranks.
template <int D>
WorkCount Solver<D>::work_of_all(std::vector<double>& seconds, support::ProcessUse& use) {
  WorkCount work = dynamics_.work();
  if (!ranks_) return work;
  std::array<double, 6> parts = {static_cast<double>(work.particle_steps),
                                 static_cast<double>(work.pairs),
                                 static_cast<double>(work.mirrored_back),
                                 static_cast<double>(work.kept_out),
                                 use.cpu_seconds,
                                 use.peak_memory};
  ranks_->take_sum(parts.data(), parts.size());
  ranks_->take_largest(seconds.data(), seconds.size());
  work.particle_steps = static_cast<std::int64_t>(parts[0]);
  work.pairs = static_cast<std::int64_t>(parts[1]);
  work.mirrored_back = static_cast<std::int64_t>(parts[2]);
  work.kept_out = static_cast<std::int64_t>(parts[3]);
  use = {parts[4], parts[5]};
  return work;
}

template <int D>
void Solver<D>::write_summary(double wall_time) {
  support::Summary summary;
  summary.program = "sph_solver";
  summary.version = LITTORAL_VERSION;
  summary.threads = omp_get_max_threads();
  summary.wall_time = wall_time;
  std::vector<double> seconds;
  for (std::size_t phase = 0; phase < k_phase_names.size(); ++phase)
    seconds.push_back(dynamics_.seconds()[phase]);
  seconds.insert(seconds.end(), {output_.seconds(), partner_ ? partner_->waited() : 0.0});
  support::ProcessUse use = support::process_use();
  const WorkCount work = work_of_all(seconds, use);
  for (std::size_t phase = 0; phase < k_phase_names.size(); ++phase)
    summary.phases.emplace_back(k_phase_names[phase], seconds[phase]);
  summary.phases.emplace_back("output", seconds[k_phase_names.size()]);
  summary.phases.emplace_back("wait", seconds[k_phase_names.size() + 1]);
  const double loops =
      seconds[static_cast<std::size_t>(Phase::gradients)] + seconds[static_cast<std::size_t>(Phase::fluxes)];
  const double pairs_per_second = loops > 0.0 ? static_cast<double>(work.pairs) / loops : 0.0;
  const double waited = seconds.back(), worked = wall_time - waited;
  const double particle_steps_per_second = static_cast<double>(work.particle_steps) / std::max(1e-9, worked);
  summary.results = {{"particles", static_cast<double>(n_particles_)},
                     {"steps", static_cast<double>(work.steps)},
                     {"end_time", time_},
                     {"list_builds", static_cast<double>(work.list_builds)},
                     {"mirrored_back", static_cast<double>(work.mirrored_back)},
                     {"kept_out", static_cast<double>(work.kept_out)},
                     {"cpu_seconds", use.cpu_seconds},
                     {"peak_memory", use.peak_memory},
                     {"most_without_donors", static_cast<double>(most_without_donors_)},
                     {"pairs_per_second", pairs_per_second},
                     {"particle_steps_per_second", particle_steps_per_second}};
  if (ranks_) add_ranks(summary);
  summary.notes = {{"scene", config_.scene.title},
                   {"digest", config_.scene.digest},
                   {"stopped because", stopped_because_}};
  if (ranks_ && ranks_->rank() != 0) return;
  summary.write(folder_ + "/summary.json");
  std::ostringstream text;
  text << work.steps << " steps in " << worked << " s";
  if (partner_) text << " and " << waited << " s of waiting";
  text << ": " << particle_steps_per_second * 1e-3 << " thousand particle-steps/s, "
       << pairs_per_second * 1e-6 << " million pairs/s (gradients and fluxes), lists built "
       << work.list_builds << " times";
  log_.info(text.str());
  if (work.mirrored_back > 0)
    log_.warn(
        std::to_string(work.mirrored_back) +
        " times a particle had crossed a symmetry plane by less than half a spacing and was mirrored back");
  if (work.kept_out > 0)
    log_.warn(std::to_string(work.kept_out) +
              " times a particle had entered a body by less than half a spacing and was put back");
}

template <int D>
void Solver<D>::add_ranks(support::Summary& summary) {
  summary.ranks = ranks_->size();
  const auto& halo = ranks_->halo();
  const HaloTraffic& traffic = halo.traffic();
  std::array<double, 6> most = {traffic.seconds,
                                static_cast<double>(halo.size()),
                                static_cast<double>(halo.n_neighbors()),
                                static_cast<double>(particles_.n_owned),
                                traffic.bytes,
                                static_cast<double>(traffic.messages)};
  std::array<double, 1> migrated = {static_cast<double>(ranks_->n_migrated())};
  ranks_->take_largest(most.data(), most.size());
  ranks_->take_sum(migrated.data(), migrated.size());
  const char* names[] = {"halo_seconds",   "halo_particles", "halo_neighbors",
                         "rank_particles", "halo_bytes",     "halo_messages"};
  for (std::size_t k = 0; k < most.size(); ++k) summary.results[std::string(names[k]) + "_most"] = most[k];
  summary.results["halo_refreshes"] = static_cast<double>(traffic.refreshes);
  summary.results["migrated"] = migrated[0];
  summary.results["bisections"] = static_cast<double>(ranks_->n_balanced());
}

template class Solver<2>;
template class Solver<3>;

}  // namespace littoral::sph
