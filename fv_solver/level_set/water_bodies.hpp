#pragma once

#include <vector>

#include "level_set/band.hpp"
#include "level_set/patches.hpp"

namespace littoral::fv {

/// Separate bodies of water: marked cells that touch across faces, through joins and periodic faces, are one.
template <int D>
class WaterBodies {
 public:
  static constexpr double k_none = 1e300;  // number of cells that are not marked

  /// in marks: 1 where there is water, 0 elsewhere; inner cells are read
  /// comm exchange of a field, as often as a body goes through blocks; collective
  void find(const std::vector<Block<D>>& blocks, const Exchange<D>& exchange,
            const std::vector<Field>& marks);
  std::size_t count() const { return count_; }
  /// Number of the body of each cell, from 0; k_none outside. Ghosts that stand for cells are current.
  const std::vector<Field>& number() const { return number_; }
  /// Of each body, whether one of its cells lies beside an opening or an imposed cell. comm collective
  std::vector<double> open(const std::vector<Block<D>>& blocks, const Ranks& ranks) const;

 private:
  std::vector<Field> number_;  // [block]
  std::size_t count_ = 0;
};

/// Gives each body of water the volume that it had before (level_set.volume_correction: local): phi is
/// shifted by one distance about all of the body's surface, in `before` (phi^n, read) to `phi` (phi^n+1,
/// changed) and in the level that goes with it in the next step's differences. Bodies that have met or parted
/// in the step count as one; those that reach an opening, where water comes and goes, are left alone. A body
/// whose volume has not changed is not touched, whatever others do.
/// pre phi reinitialised, ghosts current; in/out phi, history; ghosts current after
/// comm collective
template <int D>
void restore_volumes(const std::vector<Block<D>>& blocks, const Exchange<D>& exchange, const Band<D>& band,
                     const SurfacePatches<D>& patches, const std::vector<Field>& before,
                     std::vector<Field>& phi, std::vector<Field>& history);

}  // namespace littoral::fv
