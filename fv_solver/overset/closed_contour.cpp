#include "overset/closed_contour.hpp"

#include <algorithm>
#include <cmath>

#include "boundary/closed_body.hpp"
#include "grid/loops.hpp"
#include "overset/components.hpp"

namespace littoral::fv {
template <int D>
ClosedContour<D>::ClosedContour(const std::vector<Block<D>>& blocks, const JoinLinks<D>& links) {
  if (!closed_body<D>(blocks)) return;
  const std::vector<std::size_t> component = components(blocks);
  // a patch above others is not free: their pressure is interpolated into it
  const std::size_t lowest = *std::min_element(component.begin(), component.end());
  std::vector<Field> interpolated;  // 1 there, ghosts behind joins as the cells
  for (const Block<D>& block : blocks) {
    interpolated.emplace_back(block.extent.size, 0.0);
    for (std::size_t c = 0; c < block.extent.size; ++c)
      if (block.status[c] == CellStatus::interpolated) interpolated.back()[c] = 1.0;
  }
  links.copy([&](std::size_t b) -> Field& { return interpolated[b]; }, true);
  double area = 0.0;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    if (component[b] != lowest) continue;
    blocks_.push_back(b);
    const Block<D>& block = blocks[b];
    for_each_index<D>({}, block.extent.n, [&](const std::array<int, D>& index) {
      const std::ptrdiff_t c = block.extent.at(index);
      const auto at = static_cast<std::size_t>(c);
      if (block.solved[at] == 0.0) return;
      Face face{b, at, 0.0};
      for (std::size_t d = 0; d < D; ++d)
        for (const int side : {0, 1}) {
          const auto other = static_cast<std::size_t>(c + (side == 0 ? -1 : 1) * block.extent.stride[d]);
          if (interpolated[b][other] == 0.0) continue;
          const auto lower = side == 0 ? at : other;
          double s = 0.0;
          for (std::size_t k = 0; k < D; ++k) s += block.area[d][k][lower] * block.area[d][k][lower];
          face.share += std::sqrt(s);
        }
      if (face.share == 0.0) return;
      area += face.share;
      faces_.push_back(face);
    });
  }
  for (Face& face : faces_) face.share /= area;
  empty_ = faces_.empty();
}

template <int D>
void ClosedContour<D>::keep(const Owners& owners) {
  ranks_ = owners.ranks;
  std::vector<Face> faces;
  for (Face face : faces_)
    if (owners.here(face.block)) {
      face.block = owners.number[face.block];
      faces.push_back(face);
    }
  std::vector<std::size_t> blocks;
  for (const std::size_t b : blocks_)
    if (owners.here(b)) blocks.push_back(owners.number[b]);
  faces_ = std::move(faces);
  blocks_ = std::move(blocks);
}

template <int D>
void ClosedContour<D>::close(const std::vector<Block<D>>& blocks, std::vector<Residual<D>>& r) const {
  double net = 0.0;  // of all boundaries and the contour: what its cells cannot store
  for (const std::size_t b : blocks_)
    for_each_index<D>({}, blocks[b].extent.n, [&](const std::array<int, D>& index) {
      const auto c = static_cast<std::size_t>(blocks[b].extent.at(index));
      if (blocks[b].solved[c] != 0.0) net += r[b].mass[c];
    });
  net = ranks_.sum(net);
  for (const Face& face : faces_) r[face.block].mass[face.cell] -= net * face.share;
}

template class ClosedContour<2>;
template class ClosedContour<3>;

}  // namespace littoral::fv
