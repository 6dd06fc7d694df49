#pragma once

#include <memory>
#include <optional>
#include <string>

#include "config.hpp"
#include "coupling/drive_layers.hpp"
#include "coupling/particle_exchange.hpp"
#include "coupling/zones.hpp"
#include "io/body_output.hpp"
#include "io/checkpoint.hpp"
#include "io/energies.hpp"
#include "littoral/coupler/partner.hpp"
#include "littoral/support/series.hpp"
#include "parallel/ranks_mpi.hpp"
#include "particles/particles.hpp"
#include "physics/dynamics.hpp"

namespace littoral::sph {

/// Everything a run writes as it goes: scalars.csv and gauges.csv each window, fields when they are due.
template <int D>
class Output {
 public:
  /// folder: OUT/sph; restart: where the run goes on, or absent. Rows later than that are cut off. ranks:
  /// null on one rank; else rank 0 writes for all, and every write is collective. walls: null without bodies.
  /// throws IoError
  Output(const std::string& folder, const RunConfig& config, const std::optional<RunState>& restart = {},
         MpiRanks<D>* ranks = nullptr, const Walls<D>* walls = nullptr);

  /// True if a field is due at `time`.
  bool fields_due(double time) const;

  struct Moment {
    double time = 0.0;    // [s]
    double dt = 0.0;      // of a particle step [s]
    int substeps = 0;     // M
    double waited = 0.0;  // wall time spent waiting for the partner so far [s]
    coupler::Ledger ledger;
    ExchangeCounts exchanged;  // by cause, since the start
    LayerCount layers;         // as the last stage found them on this rank
  };
  /// pre: copies and lists current (Dynamics::prepare)
  void write_rows(const Moment& now, const Particles<D>& particles, const Dynamics<D>& dynamics,
                  const Layers<D>& layers);
  void write_fields(double time, const Particles<D>& particles);
  /// Unless they were already written at this time.
  void write_fields_once(double time, const Particles<D>& particles) {
    if (time > last_fields_) write_fields(time, particles);
  }

  double last_fields() const { return last_fields_; }  ///< time of the last fields [s]
  double seconds() const { return seconds_; }          ///< wall time spent writing so far [s]

 private:
  /// Of all ranks, on every rank.
  void add_up(Totals& sum, LayerCount& layers) const;
  void write_points(double time, const Particles<D>& particles);
  /// Values of the gauges, on the rank that writes.
  std::vector<double> gauge_row(const Particles<D>& particles, const NeighborList<D>& neighbors) const;

  RunConfig config_;
  MpiRanks<D>* ranks_;
  const Walls<D>* walls_;
  std::array<double, D> gravity_{};
  // of the rank that writes
  std::optional<support::CsvSeries> scalars_;
  std::optional<support::CsvSeries> gauges_;
  std::optional<support::FieldSeries> fields_;
  std::optional<BodyPoints<D>> bodies_;
  double last_fields_ = 0.0;
  double seconds_ = 0.0;
};

extern template class Output<2>;
extern template class Output<3>;

}  // namespace littoral::sph
