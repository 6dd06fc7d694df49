#pragma once

#include <array>
#include <memory>
#include <vector>

#include "implicit/level_joins.hpp"
#include "implicit/level_overlap.hpp"
#include "implicit/line_operator.hpp"
#include "implicit/transfer.hpp"

namespace littoral::fv {

struct MultigridOptions {
  int max_levels = 6;
  int pre_sweeps = 1;
  int post_sweeps = 1;      // essential: without post-smoothing the cycle does not pay
  int coarsest_sweeps = 8;  // there and back each; of joined blocks twice as many
  /// Part of the pressure's first-order jump (I8) on the finest level, the next one, and all below. 1: the
  /// exact first-order Jacobian on all levels.
  std::array<double, 3> jump = {0.6, 0.35, 0.5};
};

/// Linear multigrid for the first-order Jacobian of one or several blocks: V-cycles with zebra line sweeps,
/// blocks re-discretised on every level from averaged states. All blocks have the same levels; a block too
/// small to be coarsened further stays as it is while others go on. The correction crosses joins on every
/// level, before each sweep of a colour and before the residual, so that nothing is lost to a single block.
/// Real: float halves the memory traffic and keeps the number of cycles; the state stays double.
template <int D, class Real>
class Multigrid {
 public:
  /// blocks: this rank's own. comm collective, as build and cycle
  Multigrid(std::vector<LevelGrid<D>> blocks, const MultigridOptions& options, const Layout<D>& layout,
            LevelOverlap<D> overlap);
  /// Blocks that have nothing to do with each other, all on this rank.
  Multigrid(std::vector<LevelGrid<D>> blocks, const MultigridOptions& options);
  ~Multigrid();
  Multigrid(Multigrid&&) noexcept;
  Multigrid& operator=(Multigrid&&) noexcept;

  /// Renews all blocks: after a change of dt, of the BDF order, or of the state they are frozen at; states
  /// with ghosts current. forcing: K/delta of each block, null where none is forced; may be empty
  /// phi: level set of each block, ghosts current; null: no free surface
  void build(const std::vector<const State<D>*>& states, const CorrectionPhysics<D>& physics,
             const std::vector<const Field*>& forcing = {}, const std::vector<Field>* phi = nullptr);

  /// Right side and correction of block i on the finest level, scaled as face_jacobian says.
  Correction<D, Real>& right_side(std::size_t i);
  Correction<D, Real>& correction(std::size_t i);

  /// One V-cycle on A e = b, from the present e (from zero if `fresh`).
  void cycle(bool fresh = true);
  /// b - A e on the finest level, into `r`. For tests.
  void residual(std::size_t i, Correction<D, Real>& r);

  /// Nothing anchors the pressure, neither boundaries nor a surface nor compression: its level is free. Of
  /// the last build.
  bool floating() const { return floating_; }
  int n_levels() const;
  const LevelGrid<D>& grid(int level, std::size_t i) const;
  const std::vector<int>& directions(std::size_t i) const;  ///< of the lines, finest level

 private:
  struct BlockLevel;
  struct Level;
  /// from_zero: all of the correction is still 0
  void sweep(Level& level, bool forward, bool from_zero = false);
  /// The correction's ghosts of one level, from periodic images and other blocks, and its interpolated cells
  /// from overlapping blocks: all that crosses between blocks inside the cycle.
  void exchange(Level& level);
  /// Interpolated cells: the right side too, so that their identity rows keep the value.
  void interpolate(Level& level);
  /// Ghosts for the interpolation between levels, edges and corners included. field: of a block; arrays: the
  /// same of all blocks
  void fill_for_transfer(Level& level, Correction<D, Real> BlockLevel::*field,
                         const std::vector<std::vector<Real*>>& arrays);
  void descend(std::size_t l, bool fresh);
  void set_forcing(const std::vector<const Field*>& forcing);
  void set_surface(const std::vector<Field>& phi);
  std::vector<std::unique_ptr<Level>> levels_;
  MultigridOptions options_;
  Owners owners_;
  bool closed_ = false, floating_ = false;  // closed: nothing on the boundaries anchors the pressure
};

}  // namespace littoral::fv
