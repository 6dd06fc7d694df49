#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "coupling/compensated.hpp"
#include "coupling/exterior.hpp"
#include "coupling/face_elements.hpp"
#include "coupling/injection_place.hpp"
#include "coupling/zones.hpp"
#include "littoral/coupler/fields.hpp"
#include "particles/particles.hpp"
#include "physics/eos.hpp"

namespace littoral::sph {

/// When a particle leaves the region, and when one comes.
///   crossing  a particle beyond the outer face goes, its mass is credited to the element it crossed; where
///             water flows in one comes when its centre crosses, that is with half its mass m0 on the
///             element. What is inside then differs from the water there by half a row at most (waiting for
///             all of m0 lags up to a row). Where water flows out a particle is due only because another
///             left early, beside its element: it waits for all of m0
///   nearest   the paper: below -m0 on an element, the particle nearest to it goes, one comes at m0; one that
///             has strayed more than a spacing beyond the face goes as under `crossing`
enum class Removal { crossing, nearest };

/// Particles that appeared or vanished, by cause.
struct ExchangeCounts {
  std::int64_t injected = 0;
  std::int64_t removed_crossing = 0;
  std::int64_t removed_nearest = 0;
  /// By face: 2 axis + side, axes (x, y, z) of space, sides lower and upper; boxes together.
  std::array<std::int64_t, 6> injected_through{}, removed_through{};
};

/// Injection and removal of particles at the outer faces, and the ledger of mass: what is in particles and on
/// the face elements is what was there at the start and what flowed in since.
/// Copyable: a copy is the complete state, to repeat a window from.
template <int D>
class ParticleExchange {
 public:
  ParticleExchange() = default;
  /// m0 = rho0 dx^D is the mass of an injected particle, where rows follow the level times its row's share.
  ParticleExchange(const Layers<D>& layers, const LinearEos& eos, double spacing, Removal removal,
                   FaceRows rows = FaceRows::level);

  /// On several ranks every rank keeps the whole ledger and takes the same decisions in the same order; what
  /// one rank alone knows (its particles near the faces, FV's state at its elements) it tells the others.
  /// null: there are none. To be called anew when space was divided anew.
  void divide_among(OtherRanks<D>* others);

  /// Takes the present particles as the start of the ledger. comm: collective
  void start(const Particles<D>& particles);

  /// After a step from `time` to `time + dt`, positions of the end: integrates the face elements over the
  /// step (18), (19), removes, injects. Ghosts are dropped if particles changed. returns  true if
  /// particles appeared or vanished: indices and neighbour lists are void then comm: collective. throws
  /// CouplingError: no donors where a particle has to appear
  bool step(Particles<D>& particles, const Exterior& fv, double time, double dt);

  /// This rank's part of the ledger: what all ranks know is rank 0's part. throws nothing
  coupler::Ledger ledger(const Particles<D>& particles) const;
  const ExchangeCounts& counts() const { return counts_; }
  const FaceElements<D>& elements() const { return elements_; }
  FaceElements<D>& elements() { return elements_; }

  std::vector<double> pack() const;
  std::vector<std::int64_t> pack_counts() const;
  void unpack(const std::vector<double>& packed, const std::vector<std::int64_t>& counts);

 private:
  /// A particle that leaves, of whatever rank.
  struct Leaver {
    double id, mass, element;
    double distance2;  // [m^2] from the element's centre, for `nearest`
  };
  /// Those of all ranks, by element and id.
  std::vector<Leaver> of_all_ranks(std::vector<Leaver> mine) const;
  void credit(const Leaver& leaver);
  void doom(std::size_t i);
  void find_crossed(const Particles<D>& particles, double margin);
  void find_nearest(const Particles<D>& particles);
  /// A particle that was born, as all ranks must know it.
  struct Birth {
    std::size_t due;       // place of its element among the due ones
    std::size_t sequence;  // of the element's births
    Point<D> x;
  };
  void add_particles_near(const std::vector<std::size_t>& due, const Particles<D>& particles,
                          std::vector<PresentParticles<D>>& present) const;
  void inject_at(std::size_t k, std::size_t element, Particles<D>& particles, const Exterior& fv, double time,
                 PresentParticles<D>& around, std::vector<Birth>& births);
  void hear_of(const std::vector<Birth>& mine, const std::vector<std::size_t>& due,
               std::vector<PresentParticles<D>>& present, std::vector<Birth>& all);
  /// [kg] of its particles
  double mass_of(std::size_t element) const { return elements_[element].share * m0_; }
  /// [kg] with so much on it a particle comes
  double mass_due(std::size_t element) const;
  bool inject(Particles<D>& particles, const Exterior& fv, double time);

  Layers<D> layers_;
  LinearEos eos_;
  double spacing_ = 0.0;
  double m0_ = 0.0;
  Removal removal_ = Removal::crossing;
  FaceElements<D> elements_;
  OtherRanks<D>* others_ = nullptr;
  Compensated start_mass_, injected_, removed_;
  ExchangeCounts counts_;
  std::vector<char> doomed_;  // of the step at hand
  std::size_t n_doomed_ = 0;
};

}  // namespace littoral::sph
