#pragma once

#include <array>
#include <cstddef>
#include <unordered_map>
#include <vector>

#include "boundary/join.hpp"
#include "grid/block.hpp"

namespace littoral::fv {

/// The cell that a ghost is the image of: behind a join or beyond a periodic face.
template <int D>
struct GhostSource {
  std::size_t block = 0;
  std::ptrdiff_t cell = 0;         // inner cell
  std::array<double, D> offset{};  // [m] place of the ghost = place of the cell + offset
};

/// What ghosts of the first layer stand for, on any level of a hierarchy of blocks. Ghosts beyond walls and
/// openings stand for nothing and are absent.
template <int D>
class GhostSources {
 public:
  /// period[block][direction]: what a ghost beyond the lower face of a periodic direction is shifted by, seen
  /// from its source; read where periodic[block][direction]
  GhostSources(const std::vector<Extent<D>>& extents, const std::vector<std::array<bool, D>>& periodic,
               const std::vector<std::array<std::array<double, D>, D>>& period,
               const std::vector<JoinSide<D>>& joins);

  /// null where the cell is no ghost, or one that stands for nothing
  const GhostSource<D>* find(std::size_t block, std::ptrdiff_t ghost) const {
    const auto found = of_[block].find(ghost);
    return found == of_[block].end() ? nullptr : &found->second;
  }
  const std::unordered_map<std::ptrdiff_t, GhostSource<D>>& of(std::size_t block) const { return of_[block]; }

 private:
  std::vector<std::unordered_map<std::ptrdiff_t, GhostSource<D>>> of_;
};

extern template class GhostSources<2>;
extern template class GhostSources<3>;

}  // namespace littoral::fv
