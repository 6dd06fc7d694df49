#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "config.hpp"
#include "coupling/window_driver.hpp"
#include "coupling/zones.hpp"
#include "io/checkpoint.hpp"
#include "io/output.hpp"
#include "littoral/coupler/partner.hpp"
#include "littoral/support/log.hpp"
#include "littoral/support/process_use.hpp"
#include "littoral/support/summary.hpp"
#include "parallel/ranks_mpi.hpp"
#include "particles/particles.hpp"
#include "physics/dynamics.hpp"

namespace littoral::sph {

/// A run of the particle solver, alone or with a partner.
template <int D>
class Solver {
 public:
  /// Places the particles, or reads them from the checkpoint `restart` (empty: none). folder: OUT/sph;
  /// partner: the grid side, or null; comm: the ranks of this program, which all make it together.
  /// throws ConfigError (no particle at all, unsuitable domain, checkpoint of another scene), IoError
  Solver(const RunConfig& config, const std::string& folder, support::Log& log,
         std::unique_ptr<coupler::FvPartner> partner, const std::string& restart = "",
         MPI_Comm comm = MPI_COMM_SELF);

  /// To the end of the scene's time. throws StabilityError, IoError, CouplingError
  void run();
  /// One step of the particles from `t` to `t + dt`, without a partner and without output.
  void step(double t, double dt) { dynamics_.step(particles_, t, dt, nullptr); }

  const Particles<D>& particles() const { return particles_; }
  const Dynamics<D>& dynamics() const { return dynamics_; }

 private:
  void begin();
  void announce();
  void keep_layers_clear();  ///< throws ConfigError: a body reaches into the coupling layers
  coupler::Agreement agree();
  void advance(const coupler::Agreement& agreement);
  void write(const coupler::Agreement& agreement);
  void place_particles();
  void read_particles(const std::string& restart);
  void warn_of_layers();
  void write_checkpoint();
  StepHooks<D>* hooks();
  typename Output<D>::Moment moment(const coupler::Window& window) const;
  void write_summary(double wall_time);
  WorkCount work_of_all(std::vector<double>& seconds, support::ProcessUse& use);
  void add_ranks(support::Summary& summary);
  std::int64_t n_particles();  ///< of all ranks; collective
  std::string describe();

  RunConfig config_;
  std::string folder_;
  support::Log& log_;
  std::unique_ptr<coupler::FvPartner> partner_;
  std::unique_ptr<MpiRanks<D>> ranks_;  // null on one rank
  Particles<D> particles_;
  Layers<D> layers_;
  Dynamics<D> dynamics_;
  std::optional<WindowDriver<D>> driver_;  // of the coupling, with a partner only
  std::optional<RunState> restart_;        // where this run goes on
  Output<D> output_;
  double time_ = 0.0;                    // [s]
  std::int64_t window_ = 0;              // of the next window
  std::int64_t n_particles_ = 0;         // of all ranks, at the end of the last window
  double last_checkpoint_ = 0.0;         // [s]
  std::size_t most_without_donors_ = 0;  // particles of the layers, at the end of a window
  bool divide_anew_ = false;             // among the ranks, when the next window begins
  std::string stopped_because_;
};

extern template class Solver<2>;
extern template class Solver<3>;

}  // namespace littoral::sph
