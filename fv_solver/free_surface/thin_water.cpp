#include "free_surface/thin_water.hpp"

#include <algorithm>

#include "grid/small_matrix.hpp"
#include "grid/space.hpp"

namespace littoral::fv {
namespace {

/// Air on both sides of c, a stride away, and the surface's normals there more than a right angle apart.
template <int D>
bool between_two_surfaces(const Block<D>& block, const Field& phi, const WetMask& wet, std::ptrdiff_t c,
                          std::ptrdiff_t stride) {
  if (wet[static_cast<std::size_t>(c - stride)] != 0 || wet[static_cast<std::size_t>(c + stride)] != 0)
    return false;
  return dot(surface_normal<D>(block, phi, c - stride), surface_normal<D>(block, phi, c + stride)) < 0.0;
}

}  // namespace

template <int D>
ThinWater<D> find_thin_water(const std::vector<Block<D>>& blocks, const Exchange<D>& exchange,
                             const Band<D>& band, const std::vector<Field>& phi,
                             const std::vector<WetMask>& wet) {
  ThinWater<D> here;
  for (std::size_t b = 0; b < blocks.size(); ++b)
    for (const std::ptrdiff_t c : band.cells(b, 0, 1)) {
      const auto at = static_cast<std::size_t>(c);
      const CellStatus status = blocks[b].status[at];
      if (wet[b][at] == 0 || (status != CellStatus::computed && status != CellStatus::forced)) continue;
      const auto& strides = blocks[b].extent.stride;
      if (std::none_of(strides.begin(), strides.end(), [&](std::ptrdiff_t s) {
            return between_two_surfaces<D>(blocks[b], phi[b], wet[b], c, s);
          }))
        continue;
      if (here.cells == 0.0) here.place = centre<D>(blocks[b], c);
      here.cells += 1.0;
    }
  ThinWater<D> all;
  for (const ThinWater<D>& part : exchange.ranks().gather(std::vector<ThinWater<D>>{here})) {
    if (all.cells == 0.0) all.place = part.place;
    all.cells += part.cells;
  }
  return all;
}

template ThinWater<2> find_thin_water(const std::vector<Block<2>>&, const Exchange<2>&, const Band<2>&,
                                      const std::vector<Field>&, const std::vector<WetMask>&);
template ThinWater<3> find_thin_water(const std::vector<Block<3>>&, const Exchange<3>&, const Band<3>&,
                                      const std::vector<Field>&, const std::vector<WetMask>&);

}  // namespace littoral::fv
