#pragma once

#include <string>
#include <vector>

#include "dual_time/stepper.hpp"
#include "io/state_file.hpp"
#include "littoral/coupler/fields.hpp"

namespace littoral::fv {

/// What the samples last received gave to a cell.
enum Known : std::uint8_t { known_state = 1, known_phi = 2 };

/// The cells that take values from the particles (fringe or forced), and those values: now, before, and their
/// trend, from which a schedule extrapolates. With a free surface phi is one of them.
template <int D>
class TargetCells {
 public:
  /// All cells of the given status, in the order block by block, direction 0 fastest.
  TargetCells(const Stepper<D>& stepper, CellStatus status);

  coupler::Targets& targets() { return targets_; }
  const coupler::Targets& targets() const { return targets_; }

  /// Values at time() + dt along a straight line: through the last and the last but two, whose slope does not
  /// see what alternates from window to window (a line through neighbours triples it, and `predicted` with
  /// ten substeps a window then feeds the column's acoustic mode). At the start along the cells' own rates.
  /// One entry a block.
  std::vector<Imposed<D>> extrapolated(double dt) const;
  /// Puts samples in the order of the targets. Cells without a sample keep what they had, and are no longer
  /// known. A cell where the particles have no water is air, whatever phi says: a jet too thin for the grid.
  /// Coupling I (`required`): every one must be ok, or air.
  /// throws CouplingError naming cell, place, status and coverage
  std::vector<Imposed<D>> received(const std::vector<Block<D>>& blocks, const coupler::Samples& samples,
                                   bool required);
  /// Known bits, in the order of a block's targets.
  const std::vector<std::uint8_t>& known(std::size_t block) const { return known_[block]; }
  /// The window is over: `values` are those of its end, dt its length.
  void accept(std::vector<Imposed<D>> values, double dt);

  void save(StateWriter<D>& file) const;  // comm collective
  void load(const support::CheckpointReader& file);

 private:
  CellStatus status_;
  bool with_phi_;
  Layout<D> layout_;
  coupler::Targets targets_;
  std::vector<Imposed<D>> now_, rate_;                  // values and their slope in time
  std::vector<Imposed<D>> before_;                      // values one window ago
  using Mask = std::vector<std::vector<std::uint8_t>>;  // of Known bits
  Mask known_, known_now_, known_before_;               // of the samples last received, of now_, of before_
  double dt_before_ = 0.0;                              // [s] that window's length; 0: there was none
};

}  // namespace littoral::fv
