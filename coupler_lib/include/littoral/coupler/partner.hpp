#pragma once

#include <memory>
#include <string>

#include "littoral/coupler/fields.hpp"
#include "littoral/coupler/types.hpp"
#include "littoral/coupler/window.hpp"

namespace littoral::coupler {

/// The grid side, as a particle solver sees it. One object per rank; all calls are made by every rank of the
/// program in the same order. Order of a run:
///
///     announce(zone)                                    again whenever an agreement says region_changed
///     loop:
///       agreement = agree(proposal)                     stop: leave the loop
///       for pass in 0 .. sph_passes-1:
///         receive(window, donors)  ... substeps ...  send(window, samples)
///       [send_particles(window, states) if agreement.wants_particles]
///       exchange(window, ledger)
///     goodbye(reason)
///
/// Every call may throw CouplingError: partner late (names partner, message, window awaited), left, aborted,
/// or sent something that does not fit.
class FvPartner {
 public:
  virtual ~FvPartner() = default;

  /// Declares where this rank needs donors (`needs`: its driven and blending layers, with a skin) and where
  /// it holds particles to sample (`covers`). Either may be empty. Then geometry and targets are current.
  /// comm: collective over the program, talks to the partner
  virtual void announce(const Box& needs, const Box& covers) = 0;
  virtual const DonorGeometry& donor_geometry() const = 0;
  virtual const Targets& targets() const = 0;

  /// comm: collective over the program (the result is the same on all ranks), talks to the partner
  virtual Agreement agree(const Proposal& mine) = 0;

  /// comm: talks to the partner's ranks in contact
  virtual void receive(const Window& window, DonorValues& donors) = 0;
  virtual void send(const Window& window, const Samples& samples) = 0;
  virtual void send_particles(const Window& window, const ParticleStates& states) = 0;

  /// Sums this program's parts and joins the partner's. comm: collective, talks to the partner
  virtual Ledger exchange(const Window& window, const Ledger& mine) = 0;

  /// After this no call is legal. comm: collective, talks to the partner
  virtual void goodbye(const std::string& reason) = 0;

  virtual double waited() const { return 0.0; }  ///< wall time spent waiting for the partner so far [s]
  virtual std::string description()
      const = 0;  ///< for the log: "fv_solver on 2 ranks", "analytic: uniform stream"
};

/// The particle side, as a grid solver sees it. Same rules; order of a run:
///
///     offer(geometry, targets)                          again whenever an agreement says region_changed
///     loop:
///       agreement = agree(proposal)
///       for pass in 0 .. sph_passes-1:
///         send(window, donors)  [concurrent: advance here]  receive(window, samples)
///       [receive_particles(window, states)]
///       exchange(window, ledger)
///     goodbye(reason)
class SphPartner {
 public:
  virtual ~SphPartner() = default;

  /// Declares the donor cells this rank holds (all of its blocks; what a contact does not need is not sent)
  /// and the points where it wants SPH values.
  virtual void offer(const DonorGeometry& donors, const Targets& targets) = 0;
  virtual Agreement agree(const Proposal& mine) = 0;
  virtual void send(const Window& window, const DonorValues& donors) = 0;
  /// Samples in the order of the offered targets. Where several SPH ranks answer, the best coverage wins.
  virtual void receive(const Window& window, Samples& samples) = 0;
  virtual void receive_particles(const Window& window, ParticleStates& states) = 0;
  virtual Ledger exchange(const Window& window, const Ledger& mine) = 0;
  virtual void goodbye(const std::string& reason) = 0;
  virtual double waited() const { return 0.0; }
  virtual std::string description() const = 0;
};

/// What a partner needs to know of the run, to agree on windows.
struct RunPlan {
  SchedulePolicy schedule;
  WindowPolicy window;
  double start_time = 0.0;  // [s]
  std::int64_t start_window = 0;
  double end_time = 0.0;          // [s]
  std::int64_t max_windows = -1;  // counted from start_window; -1: no limit
  double deadline = 600.0;        // [s]
  bool with_phi = false;          // a level set crosses
};

}  // namespace littoral::coupler
