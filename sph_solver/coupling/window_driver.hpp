#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>

#include "coupling/coupling_config.hpp"
#include "coupling/coupling_hooks.hpp"
#include "coupling/exterior.hpp"
#include "coupling/rank_part.hpp"
#include "coupling/samples.hpp"
#include "littoral/coupler/partner.hpp"
#include "littoral/support/scene.hpp"
#include "physics/dynamics.hpp"

namespace littoral::sph {

/// The particle side of a coupling window: donors in, M substeps, samples out, ledger; the order of calls is
/// that of FvPartner. Also keeps what a checkpoint of the coupling must hold.
template <int D>
class WindowDriver {
 public:
  WindowDriver(const support::Scene& scene, const CouplingConfig& config, const Numerics<D>& numerics,
               coupler::FvPartner& partner);

  const Layers<D>& layers() const { return hooks_.layers(); }
  CouplingHooks<D>& hooks() { return hooks_; }
  const CouplingHooks<D>& hooks() const { return hooks_; }

  /// Zones of the particles as they stand, and the start of the ledger. At a restart both are the
  /// checkpoint's.
  void begin(Particles<D>& particles);

  /// Several ranks: each has a part of space, from which follow its elements, donors and targets. To be
  /// called before begin() or announce(), and anew when space was divided anew. null: there are none
  void divide_among(OtherRanks<D>* others);

  /// Tells the partner where donors are needed and samples can be had, and takes its geometry and targets;
  /// the hints of earlier searches are void. At the start and whenever an agreement says region_changed.
  /// comm: collective, talks to the partner. throws CouplingError: no donors around an open face
  void announce(Particles<D>& particles);

  /// The searches' memory is void: the next ones start afresh. After a checkpoint, so that this run goes on
  /// as the restarted one will.
  void forget_hints(Particles<D>& particles);

  /// One window; every pass of the schedule starts from the same particles.
  /// comm: collective, talks to the partner. throws CouplingError, StabilityError (also: the ledger's defect)
  void advance(const coupler::Agreement& agreement, Particles<D>& particles, Dynamics<D>& dynamics);

  /// The points the partner wants values at, and their surroundings: the halo must be complete there.
  RankBox<D> interest() const {
    return box_of_targets<D>(partner_.targets(),
                             with_phi_ ? surface_reach() + k_surface_kernel * spacing_ : 0.0);
  }

  const coupler::Ledger& ledger() const { return ledger_; }  ///< summed over ranks, of the last window

 private:
  /// How far from a target surface particles matter [m].
  double surface_reach() const {
    return std::max(phi_band_, (k_surface_depth + 1.0 + k_surface_kernel) * spacing_);
  }
  void send_samples(const coupler::Window& window, Particles<D>& particles, Dynamics<D>& dynamics);

  coupler::FvPartner& partner_;
  int passes_;
  bool with_phi_;
  SampleRules sample_rules_;
  double spacing_;
  double phi_band_;
  bool level_follows_fv_;      // no free surface that fixes the pressure the pair loops take off
  double reference_pressure_;  // [Pa] p0
  double skin_;                // [m] of the neighbour lists: a particle strays so far before it migrates
  DomainBox<D> domain_;
  OtherRanks<D>* others_ = nullptr;
  DonorField donors_;
  CouplingHooks<D> hooks_;
  coupler::Samples samples_;
  coupler::Ledger ledger_;
};

/// The particles of the layers and of the free surface as FV may ask for them. pure
template <int D>
coupler::ParticleStates particle_states(const Particles<D>& particles, double time);

}  // namespace littoral::sph
