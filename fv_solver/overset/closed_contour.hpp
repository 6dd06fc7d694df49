#pragma once

#include <vector>

#include "boundary/links.hpp"
#include "grid/block.hpp"

namespace littoral::fv {

/// The edge of the hole in the lowest component of a closed, incompressible body of water. Interpolation lets
/// a little more water into the hole than out of it (second order), which such a body cannot store, while its
/// pressure is free to a constant: the equations then have no solution, and the inner iteration stalls at the
/// size of that flux. Through one contour, and one only, it is therefore made zero.
template <int D>
class ClosedContour {
 public:
  ClosedContour() = default;
  /// Of all blocks; links: their joins. Empty where a boundary knows the pressure or lets water out, and
  /// where the lowest component has no hole: closing a patch above it instead would set its pressure free.
  ClosedContour(const std::vector<Block<D>>& blocks, const JoinLinks<D>& links);
  /// Leaves what concerns a rank's own blocks.
  void keep(const Owners& owners);

  bool empty() const { return empty_; }  ///< on all ranks
  /// Takes the net flux out of the mass rows beside the contour, in proportion to its faces.
  /// comm collective
  void close(const std::vector<Block<D>>& blocks, std::vector<Residual<D>>& r) const;

 private:
  struct Face {
    std::size_t block = 0, cell = 0;  // the solved cell beside it
    double share = 0.0;               // of the contour's area
  };
  bool empty_ = true;
  Ranks ranks_;
  std::vector<Face> faces_;
  std::vector<std::size_t> blocks_;  // of the component
};

extern template class ClosedContour<2>;
extern template class ClosedContour<3>;

}  // namespace littoral::fv
