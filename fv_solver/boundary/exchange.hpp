#pragma once

#include <vector>

#include "boundary/irregular_faces.hpp"
#include "boundary/links.hpp"
#include "boundary/scalar_ghosts.hpp"
#include "grid/block.hpp"
#include "overset/closed_contour.hpp"
#include "overset/donors.hpp"

namespace littoral::fv {

/// What passes between blocks, and the ghosts of each: the one place where values from elsewhere enter a
/// block. Every evaluation of the residual goes through states(); the correction has the same on each of its
/// levels (Multigrid::exchange).
template <int D>
class Exchange {
 public:
  Exchange() = default;
  /// Joins of the blocks' windows. The blocks may change their statuses and windows' values, not their joins.
  /// overset: the interpolated cells of overlapping blocks, if any.
  explicit Exchange(const std::vector<Block<D>>& blocks, OversetLinks<D> overset = {});

  /// Sets p (beyond hydrostatic) and u in all interpolated cells, then in all ghosts of all blocks: behind
  /// windows (fill_ghosts), then behind joins, edges and corners included. Across a periodic pair pressures
  /// are those relative to the hydrostatic reference. pre windows evaluated    comm local
  void states(const std::vector<Block<D>>& blocks, std::vector<State<D>>& q) const;

  /// The same for scalar fields, fields[number][block]: interpolated cells (rule level_set only), ghosts
  /// behind windows by the rule, joins. All fields in one pass.    comm local
  void scalars(const std::vector<Block<D>>& blocks, const std::vector<std::vector<Field*>>& fields,
               ScalarGhosts rule) const;
  void scalar(const std::vector<Block<D>>& blocks, std::vector<Field>& field, ScalarGhosts rule) const;

  /// Makes the friction through every joined face one and the same for both blocks. pre states()
  void share_fluxes(const std::vector<Block<D>>& blocks, const Fluid<D>& fluid,
                    const std::vector<State<D>>& q, std::vector<Residual<D>>& r) const {
    irregular_.share_friction(blocks, fluid, q, r);
  }
  const IrregularFaces<D>& irregular() const { return irregular_; }
  /// Ghosts of each block that stand for cells.
  const std::vector<ConnectedGhosts>& connected() const { return connected_; }
  const JoinLinks<D>& links() const { return links_; }
  const OversetLinks<D>& overset() const { return overset_; }
  const ClosedContour<D>& closed_contour() const { return contour_; }

 private:
  JoinLinks<D> links_;
  std::vector<ConnectedGhosts> connected_;  // [block]
  IrregularFaces<D> irregular_;
  OversetLinks<D> overset_;
  ClosedContour<D> contour_;
};

/// Centres, volumes and face areas of the ghosts behind joins are those of the cells there, so that
/// reconstruction and friction keep their order across. pre: set_metrics on all blocks
template <int D>
void join_metrics(std::vector<Block<D>>& blocks);

}  // namespace littoral::fv
