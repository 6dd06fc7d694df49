#pragma once

#include <vector>

#include "boundary/irregular_faces.hpp"
#include "boundary/links.hpp"
#include "boundary/scalar_ghosts.hpp"
#include "grid/block.hpp"
#include "overset/closed_contour.hpp"
#include "overset/donor_links.hpp"
#include "parallel/layout.hpp"

namespace littoral::fv {

/// What passes between blocks, and the ghosts of each: the one place where values from elsewhere enter a
/// block. Every evaluation of the residual goes through states(); the correction has the same on each of its
/// levels (Multigrid::exchange).
template <int D>
class Exchange {
 public:
  Exchange() = default;
  /// Of all blocks; keeps what concerns those that `layout` gives to this rank, by their numbers among them.
  /// The blocks may change their statuses and windows' values, not their joins. overset: the interpolated
  /// cells of overlapping blocks, if any. comm collective
  Exchange(const std::vector<Block<D>>& blocks, const OversetLinks<D>& overset, Layout<D> layout);
  /// All blocks are here.
  explicit Exchange(const std::vector<Block<D>>& blocks, const OversetLinks<D>& overset = {})
      : Exchange(blocks, overset, layout_of(blocks)) {}

  /// Sets p (beyond hydrostatic) and u in all interpolated cells, then in all ghosts of all blocks: behind
  /// windows (fill_ghosts), then behind joins, edges and corners included. Across a periodic pair pressures
  /// are those relative to the hydrostatic reference. pre windows evaluated, share_references
  /// comm neighbours, as all that follow
  void states(const std::vector<Block<D>>& blocks, std::vector<State<D>>& q) const;

  /// The same for scalar fields, fields[number][block]: interpolated cells (rule level_set only), ghosts
  /// behind windows by the rule, joins. All fields in one pass.
  void scalars(const std::vector<Block<D>>& blocks, const std::vector<std::vector<Field*>>& fields,
               ScalarGhosts rule) const;
  void scalar(const std::vector<Block<D>>& blocks, std::vector<Field>& field, ScalarGhosts rule) const;

  /// Ghosts behind joins get the hydrostatic reference of the cells there: along a join's offset it is the
  /// same, but for round-off, which must not enter p. Once, after set_reference_pressure.
  void share_references(std::vector<Block<D>>& blocks) const {
    links_.copy([&](std::size_t b) -> Field& { return blocks[b].reference_pressure; });
  }

  /// Makes the friction through every joined face one and the same for both blocks. pre states()
  void share_fluxes(const std::vector<Block<D>>& blocks, const Fluid<D>& fluid,
                    const std::vector<State<D>>& q, std::vector<Residual<D>>& r) const {
    irregular_.share_friction(blocks, fluid, q, r);
  }
  /// Seeks the donors of the interpolated cells anew, after statuses have changed. Nothing where none are.
  /// throws ConfigError: a cell that finds none
  void seek_donors(const std::vector<Block<D>>& blocks);

  const IrregularFaces<D>& irregular() const { return irregular_; }
  /// Ghosts of each block that stand for cells.
  const std::vector<ConnectedGhosts>& connected() const { return connected_; }
  const Layout<D>& layout() const { return layout_; }
  const Ranks& ranks() const { return layout_.owners.ranks; }
  const ClosedContour<D>& closed_contour() const { return contour_; }

 private:
  Layout<D> layout_;
  JoinLinks<D> links_;
  std::vector<ConnectedGhosts> connected_;  // [block]
  IrregularFaces<D> irregular_;
  DonorLinks<D> overset_;
  ClosedContour<D> contour_;
  mutable std::vector<std::vector<double*>> arrays_;  // [block][field] of one exchange; kept for its memory
};

/// Centres, volumes and face areas of the ghosts behind joins are those of the cells there, so that
/// reconstruction and friction keep their order across. pre: set_metrics on all blocks
template <int D>
void join_metrics(std::vector<Block<D>>& blocks);

}  // namespace littoral::fv
