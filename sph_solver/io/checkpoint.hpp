#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "coupling/particle_exchange.hpp"
#include "littoral/support/scene.hpp"
#include "particles/particles.hpp"

namespace littoral::sph {

/// Where a run stands, beside its particles.
struct RunState {
  double time = 0.0;         // [s]
  std::int64_t window = 0;   // windows completed
  double last_fields = 0.0;  // [s] when fields were written last
  double most_acceleration =
      0.0;  // [m/s^2] of the last right-hand side: the next step's length depends on it
  std::string scene_title;
  std::string scene_digest;
  std::vector<std::int64_t> rank_counts;  // particles of each rank, in the order of the file
  std::vector<double> regions;            // Regions::pack(); empty for one rank
  double load = 1.0;                      // MpiRanks::load()
};

/// The part of a checkpoint's particles that a rank takes: those it had, if there are as many ranks as then,
/// else an even share.
struct CheckpointShare {
  int rank = 0;
  int size = 1;
};

/// Everything a run needs to go on bit for bit: the particles of all ranks in their present order with ids,
/// the face elements' masses and the ledger (exchange may be null: no coupling). Neighbour lists are not
/// stored; the running program makes them anew after a checkpoint, as the restarted one does. throws IoError
/// (disk full, no permission)
template <int D>
void write_checkpoint(const std::string& path, const RunState& run, const Particles<D>& particles,
                      const ParticleExchange<D>* exchange);

/// Where the run of a checkpoint stands, without its particles. throws as read_checkpoint
RunState read_run_state(const std::string& path, const support::Scene& scene);

/// Reads what write_checkpoint wrote.
/// throws IoError: missing, damaged, of the other dimension; ConfigError: of another scene (names both)
template <int D>
RunState read_checkpoint(const std::string& path, const support::Scene& scene, Particles<D>& particles,
                         ParticleExchange<D>* exchange, const CheckpointShare& share = {});

}  // namespace littoral::sph
