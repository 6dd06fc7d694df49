#include "grid/donor_patch.hpp"

#include "grid/loops.hpp"

namespace littoral::fv {

template <int D>
coupler::DonorPatch donor_patch(const Block<D>& block, int ghost_layers, std::vector<std::size_t>& cells) {
  coupler::DonorPatch patch;
  std::array<int, D> lower, upper;
  patch.n = {1, 1, 1};
  for (std::size_t d = 0; d < D; ++d) {
    lower[d] = -ghost_layers;
    upper[d] = block.extent.n[d] + ghost_layers;
    patch.n[D == 2 && d == 1 ? 2 : d] = upper[d] - lower[d];
  }
  for_each_index<D>(lower, upper, [&](const std::array<int, D>& index) {
    const auto c = static_cast<std::size_t>(block.extent.at(index));
    cells.push_back(c);
    patch.x.push_back(block.centre[0][c]);
    patch.y.push_back(D == 2 ? 0.0 : block.centre[1][c]);
    patch.z.push_back(block.centre[D - 1][c]);
    patch.usable.push_back(block.status[c] == CellStatus::blanked ? 0 : 1);
  });
  return patch;
}

template coupler::DonorPatch donor_patch<2>(const Block<2>&, int, std::vector<std::size_t>&);
template coupler::DonorPatch donor_patch<3>(const Block<3>&, int, std::vector<std::size_t>&);

}  // namespace littoral::fv
