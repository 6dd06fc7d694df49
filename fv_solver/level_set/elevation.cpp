#include "level_set/elevation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "grid/donor_patch.hpp"
#include "grid/small_matrix.hpp"
#include "grid/space.hpp"
#include "littoral/coupler/donor_search.hpp"

namespace littoral::fv {

template <int D>
ElevationLine<D>::ElevationLine(const std::vector<Block<D>>& blocks, const coupler::Vec3& through,
                                const coupler::Vec3& up) {
  coupler::DonorGeometry geometry;
  std::vector<std::size_t> cells, block_of;
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const std::size_t first = cells.size();
    geometry.patches.push_back(donor_patch<D>(blocks[b], 1, cells));
    block_of.resize(cells.size(), b);
    for (std::size_t i = first; i < cells.size(); ++i) {
      const double height = dot(centre_in_space<D>(blocks[b], static_cast<std::ptrdiff_t>(cells[i])), up);
      lowest = std::min(lowest, height);
      highest = std::max(highest, height);
    }
  }
  if (!(highest > lowest)) return;
  const coupler::DonorSearch search(geometry, D);
  constexpr double k_coarsest = 1e-3;  // of the grid's height, where the line is outside of it
  const double offset = dot(through, up);
  double step = k_coarsest * (highest - lowest);
  bool before = false;
  std::int64_t hint = -1;
  for (double height = lowest; height <= highest; height += step) {
    coupler::Vec3 x;
    for (std::size_t k = 0; k < 3; ++k) x[k] = through[k] + (height - offset) * up[k];
    const coupler::Donor donor = search.find(x, hint);
    if (!donor.found) {
      before = false;
      step = k_coarsest * (highest - lowest);
      continue;
    }
    Place place;
    place.height = height;
    place.follows = before;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t k = 0; k < 8; ++k) {
      if (donor.weight[k] == 0.0) continue;
      const auto i = static_cast<std::size_t>(donor.cell[k]);
      place.block.push_back(block_of[i]);
      place.cell.push_back(cells[i]);
      place.weight.push_back(donor.weight[k]);
      const double h =
          dot(centre_in_space<D>(blocks[block_of[i]], static_cast<std::ptrdiff_t>(cells[i])), up);
      low = std::min(low, h);
      high = std::max(high, h);
    }
    places_.push_back(std::move(place));
    before = true;
    if (high > low) step = 0.5 * (high - low);
  }
}

template <int D>
double ElevationLine<D>::height(const std::vector<Field>& phi) const {
  const auto value = [&](const Place& place) {
    double sum = 0.0;
    for (std::size_t i = 0; i < place.cell.size(); ++i)
      sum += place.weight[i] * phi[place.block[i]][place.cell[i]];
    return sum;
  };
  double above = 0.0;
  for (std::size_t i = places_.size(); i-- > 0;) {
    const double here = value(places_[i]);
    const bool connected = i + 1 < places_.size() && places_[i + 1].follows;
    if (connected && here < 0.0 && above >= 0.0) {
      const double theta = here / (here - above);
      return places_[i].height + theta * (places_[i + 1].height - places_[i].height);
    }
    above = here;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

template class ElevationLine<2>;
template class ElevationLine<3>;

}  // namespace littoral::fv
