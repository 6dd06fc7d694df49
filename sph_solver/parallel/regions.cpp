#include "parallel/regions.hpp"

#include <cstddef>

namespace littoral::sph {

template <int D>
Regions<D>::Regions(std::vector<RankBox<D>> boxes) : boxes_(std::move(boxes)), overlapped_(boxes_.size(), 0) {
  for (std::size_t r = 0; r < boxes_.size(); ++r)
    for (std::size_t lower = 0; lower < r; ++lower) {
      bool meets = true;
      for (std::size_t d = 0; d < D; ++d)
        meets = meets && boxes_[r].lower[d] < boxes_[lower].upper[d] &&
                boxes_[lower].lower[d] < boxes_[r].upper[d];
      if (meets) overlapped_[r] = 1;
    }
}

template <int D>
bool Regions<D>::holds(std::size_t rank, const std::array<double, D>& x) const {
  for (std::size_t d = 0; d < D; ++d)
    if (!(x[d] >= boxes_[rank].lower[d] && x[d] < boxes_[rank].upper[d])) return false;
  return true;
}

template <int D>
std::size_t Regions<D>::owner(const std::array<double, D>& x, std::size_t hint) const {
  if (!overlapped_[hint] && holds(hint, x)) return hint;
  for (std::size_t r = 0; r < boxes_.size(); ++r)
    if (holds(r, x)) return r;
  return hint;
}

template <int D>
std::vector<double> Regions<D>::pack() const {
  std::vector<double> packed;
  for (const auto& box : boxes_) {
    packed.insert(packed.end(), box.lower.begin(), box.lower.end());
    packed.insert(packed.end(), box.upper.begin(), box.upper.end());
  }
  return packed;
}

template <int D>
Regions<D> Regions<D>::unpack(const std::vector<double>& packed) {
  std::vector<RankBox<D>> boxes(packed.size() / (2 * D));
  for (std::size_t r = 0; r < boxes.size(); ++r)
    for (std::size_t d = 0; d < D; ++d) {
      boxes[r].lower[d] = packed[2 * D * r + d];
      boxes[r].upper[d] = packed[2 * D * r + D + d];
    }
  return Regions(std::move(boxes));
}

template class Regions<2>;
template class Regions<3>;

}  // namespace littoral::sph
