#pragma once

#include <array>
#include <vector>

#include "boundary/links.hpp"
#include "grid/block.hpp"
#include "physics/equations.hpp"

namespace littoral::fv {

/// Faces of joins whose two blocks do not see the same cells around the face: beside a vertex where other
/// than four blocks meet, or where a join ends at a wall. There the two sides' friction differs in the
/// derivatives across, so that what leaves one block would not be what enters the other. The flux of the
/// lower side (block, face) is made that of both. Grids without such places have none of these and pay
/// nothing.
template <int D>
class IrregularFaces {
 public:
  IrregularFaces() = default;
  IrregularFaces(const std::vector<Block<D>>& blocks, const std::vector<JoinSide<D>>& joins,
                 const JoinLinks<D>& links);
  /// Of faces between all blocks, leaves those of a rank's own ones: with one side, or both.
  void keep(const Owners& owners);

  std::size_t size() const { return faces_.size(); }
  /// Adds the difference of the two frictions to the residual of the higher side. in q with ghosts current
  /// comm the ranks of the other sides
  void share_friction(const std::vector<Block<D>>& blocks, const Fluid<D>& fluid,
                      const std::vector<State<D>>& q, std::vector<Residual<D>>& r) const;

 private:
  struct Side {
    std::size_t block = 0, direction = 0;
    std::ptrdiff_t face = 0;  // offset of the cell whose lower face it is
    std::ptrdiff_t cell = 0;  // inner cell
    double outward = 1.0;     // of +direction
  };
  struct Face {
    Side owner, other;
  };
  struct Peer {
    int rank = 0;
    std::vector<Side> gives, takes;  // lower sides here, higher sides here
  };
  std::vector<Face> faces_;  // both sides here
  std::vector<Peer> peers_;
  mutable Halo halo_;
};

}  // namespace littoral::fv
