#include "solver.hpp"

#include <omp.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>

#include "checks.hpp"
#include "io/checkpoint.hpp"
#include "littoral/coupler/job.hpp"
#include "littoral/error.hpp"
#include "littoral/support/due.hpp"
#include "littoral/support/process_use.hpp"
#include "littoral/support/scene_warnings.hpp"
#include "setup.hpp"
#include "version.hpp"

namespace littoral::fv {
namespace {

std::string make_folder(const std::string& out, const Ranks& ranks) {
  const std::string folder = out + "/fv";
  if (!ranks.root()) return folder;
  std::error_code problem;
  std::filesystem::create_directories(folder, problem);
  if (problem) throw IoError(folder + ": cannot be made: " + problem.message());
  return folder;
}

void write_text(const std::string& path, const std::string& text) {
  std::ofstream file(path);
  file << text;
  file.close();
  if (!file) throw IoError(path + ": cannot be written (is the disk full?)");
}

template <class... Values>
std::string format(const char* pattern, Values... values) {
  char text[256];
  std::snprintf(text, sizeof text, pattern, values...);
  return text;
}

}  // namespace

template <int D>
Solver<D>::Solver(const FvConfig& config, const support::Scene& scene, const std::string& out,
                  const std::string& restart, const Ranks& ranks)
    : config_(config),
      scene_(scene),
      ranks_(ranks),
      folder_(make_folder(out, ranks)),
      restart_(restart),
      restarted_(!restart.empty()),
      log_("fv_solver", ranks.rank(), ranks.root() ? folder_ + "/log.txt" : ""),
      solve_(timers_.declare("solve")),
      write_(timers_.declare("output")),
      stepper_(make_stepper<D>(config, scene, &grid_notes_, ranks)) {
  if (restarted_) window_ = read_checkpoint<D>(restart, stepper_, scene);
  if (ranks.root()) {
    write_text(folder_ + "/config.yaml", config.resolved());
    write_text(folder_ + "/scene.yaml", scene.resolved());
  }
  last_checkpoint_ = stepper_.time();
}

template <int D>
void Solver<D>::run(Companion<D>& companion) {
  begin_ = support::Timers::now();
  companion.tell = [this](const std::string& message) { log_.info(message); };
  companion.warn = [this](const std::string& message) { log_.warn(message); };
  companion.begin(stepper_);
  check_blocks<D>(stepper_.blocks(), scene_, stepper_.surface() != nullptr);
  if (restarted_) companion.load(support::CheckpointReader(restart_));
  output_ = std::make_unique<Output<D>>(folder_, config_, scene_, stepper_, timers_, restarted_);
  if (restarted_) output_->set_last_fields(support::CheckpointReader(restart_).number("output/last_fields"));
  const Layout<D>& layout = stepper_.exchange().layout();
  log_.info(format("%s: %.0f cells in %zu blocks, %d ranks of %d threads, %s", scene_.title.c_str(), cells(),
                   layout.whole.size(), ranks_.size(), omp_get_max_threads(),
                   companion.description().c_str()));
  for (const std::string& note : grid_notes_) log_.info(note);
  if (const FreeSurface<D>* surface = stepper_.surface(); surface != nullptr && !restarted_)
    for (const std::string& note : SurfaceWarnings::of_start(*surface, scene_.fluid.sound_speed))
      log_.info(note);
  for (const std::string& warning : support::scene_warnings(scene_)) log_.warn(warning);
  if (!restarted_) output_->first(stepper_, companion.waited());

  std::string reason = "end time reached";
  while (const auto agreement = companion.agree(propose())) {
    if (agreement->stop) {
      if (!agreement->reason.empty()) reason = agreement->reason;
      break;
    }
    coupler::set_place(agreement->window.index, agreement->window.t_begin);
    step(*agreement, companion);
  }
  output_->last(stepper_);
  companion.goodbye(reason);
  write_summary(companion, reason);
}

template <int D>
void Solver<D>::step(const coupler::Agreement& agreement, Companion<D>& companion) {
  StepReport outcome;
  {
    const auto timing = timers_.scope(solve_);
    const double waited = companion.waited();
    outcome = companion.advance(agreement.window, stepper_);
    timers_.add(solve_, waited - companion.waited());  // waiting is no work
  }
  window_ = agreement.window.index + 1;
  report(outcome);
  const auto timing = timers_.scope(write_);
  output_->after(agreement, stepper_, outcome, companion.waited());
  if (agreement.checkpoint) {
    write_checkpoint<D>(support::checkpoint_path(output_->folder(), window_), stepper_, window_, scene_,
                        [&](StateWriter<D>& file) {
                          companion.save(file);
                          file.put("output/last_fields", output_->last_fields());
                        });
    last_checkpoint_ = stepper_.time();
  }
}

template <int D>
coupler::Proposal Solver<D>::propose() const {
  coupler::Proposal mine;
  mine.dt_stable = std::numeric_limits<double>::infinity();
  if (config_.time.dt) mine.dt_stable = *config_.time.dt;
  if (config_.time.cfl) {
    // water at rest does not say how long a step may be
    const double least =
        scene_.reference_velocity > 0.0 ? scene_.reference_velocity : stepper_.equations().speeds.c0;
    double rate = 0.0;
    for (std::size_t b = 0; b < stepper_.blocks().size(); ++b)
      rate = std::max(rate, convective_rate<D>(stepper_.blocks()[b], stepper_.state()[b], least));
    if (const FreeSurface<D>* surface = stepper_.surface()) rate = std::max(rate, surface->rate());
    mine.dt_stable = *config_.time.cfl / ranks_.largest(rate);
  }
  // a window whose length the particles decide: as long as the last one
  const double length = scene_.has_region() ? stepper_.last_dt() : mine.dt_stable;
  const double next = support::expected_end(scene_, stepper_.time(), length);
  mine.write = output_->fields_due(next);
  mine.checkpoint = support::due(last_checkpoint_, next, scene_.time.checkpoint_interval);
  return mine;
}

template <int D>
void Solver<D>::report(const StepReport& outcome) {
  ++steps_;
  cycles_ += outcome.cycles;
  std::string line = format("t = %.5g s, dt = %.3g s, %d cycles, drop %.1e", stepper_.time(),
                            stepper_.last_dt(), outcome.cycles, outcome.drop());
  if (const FreeSurface<D>* surface = stepper_.surface())
    line += format(", volume %+.1e", surface->budget().relative_error());
  log_.progress(stepper_.time(), scene_.time.end, line);
  if (config_.dual_time.print_history) {
    std::string history = "inner history [m/s]:";
    for (const double norm : outcome.norms) history += format(" %.3e", norm);
    log_.info(history);
  }
  if (const FreeSurface<D>* surface = stepper_.surface())
    for (const std::string& warning : surface_warnings_.after(stepper_.steps(), *surface)) log_.warn(warning);
  if (outcome.converged) return;
  // the first few and then every hundredth: a run that never converges should not bury its log
  if (++unconverged_ <= 3 || unconverged_ % 100 == 0)
    log_.warn(
        format("step %ld: the inner iteration stopped after %d cycles at a drop of %.1e, not %.1e (%ld "
               "such steps so far); a smaller step or more dual_time.max_cycles helps",
               stepper_.steps(), outcome.cycles, outcome.drop(), config_.dual_time.drop, unconverged_));
}

template <int D>
double Solver<D>::cells() const {
  double n = 0.0;
  for (const auto& shape : stepper_.exchange().layout().shape) n += static_cast<double>(shape.extent.cells());
  return n;
}

template <int D>
void Solver<D>::write_summary(const Companion<D>& companion, const std::string& reason) {
  const Traffic sent = ranks_.traffic() != nullptr ? *ranks_.traffic() : Traffic{};
  const support::ProcessUse use = support::process_use();
  std::array<double, 2> used = {use.cpu_seconds, use.peak_memory};
  ranks_.sum(used);
  const double messages = ranks_.largest(sent.messages), bytes = ranks_.largest(sent.bytes);
  if (!ranks_.root()) return;
  support::Summary summary;
  summary.program = "fv_solver";
  summary.version = k_version;
  summary.threads = omp_get_max_threads();
  summary.wall_time = support::Timers::now() - begin_;
  summary.phases = timers_.table();
  for (const auto& phase : stepper_.phases().table()) summary.phases.push_back(phase);
  summary.phases.emplace_back("coupling", companion.coupling_seconds());  // part of `solve`
  summary.phases.emplace_back("wait", companion.waited());
  const double solved = timers_.seconds(solve_), steps = static_cast<double>(std::max(1L, steps_));
  summary.results = {{"cells", cells()},
                     {"ranks", static_cast<double>(ranks_.size())},
                     {"steps", static_cast<double>(steps_)},
                     {"time", stepper_.time()},
                     {"inner_cycles_per_step", static_cast<double>(cycles_) / steps},
                     {"unconverged_steps", static_cast<double>(unconverged_)},
                     {"microseconds_per_cell_and_step", 1e6 * solved / (cells() * steps)},
                     {"halo_messages_most", messages},  // of any rank
                     {"halo_bytes_most", bytes},
                     {"sums_over_ranks", sent.sums},
                     {"cpu_seconds", used[0]},  // of all ranks, as the memory
                     {"peak_memory", used[1]},
                     {"mass", output_->integrals().mass},
                     {"kinetic_energy", output_->integrals().kinetic_energy},
                     {"potential_energy", output_->integrals().potential_energy}};
  summary.notes = {{"scene", scene_.title},
                   {"digest", scene_.digest},
                   {"companion", companion.description()},
                   {"stopped because", reason}};
  if (const FreeSurface<D>* surface = stepper_.surface())
    summary.results["volume_error"] = surface->budget().relative_error();
  if (unconverged_ > 0)
    summary.warnings.push_back(
        format("%ld of %ld steps did not reach the inner tolerance", unconverged_, steps_));
  summary.write(folder_ + "/summary.json");
  log_.info(format("%s: %ld steps to t = %.6g s in %.2f s, %.1f cycles a step, %.2f us a cell and step",
                   reason.c_str(), steps_, stepper_.time(), summary.wall_time,
                   summary.results["inner_cycles_per_step"],
                   summary.results["microseconds_per_cell_and_step"]));
}

template class Solver<2>;
template class Solver<3>;

}  // namespace littoral::fv
