#include "level_set/elevation.hpp"

#include <algorithm>
#include <cmath>

#include "grid/donor_patch.hpp"
#include "grid/small_matrix.hpp"
#include "grid/space.hpp"
#include "littoral/coupler/donor_search.hpp"

namespace littoral::fv {

Elevation highest(const std::vector<Elevation>& readings) {
  Elevation top;
  for (const Elevation& reading : readings)
    if (!std::isnan(reading.height) && !(top.height >= reading.height)) top = reading;
  Elevation best = top;
  for (const Elevation& reading : readings) {
    if (!(std::abs(reading.height - top.height) <= std::max(reading.reach, top.reach))) continue;
    if (reading.component > best.component ||
        (reading.component == best.component && reading.height > best.height))
      best = reading;
  }
  return best;
}

template <int D>
ElevationLine<D>::ElevationLine(const Block<D>& block, const coupler::Vec3& through,
                                const coupler::Vec3& up) {
  std::vector<std::size_t> cells;
  coupler::DonorGeometry geometry;
  geometry.patches.push_back(donor_patch<D>(block, 1, cells));
  const auto height_of = [&](std::size_t c) {
    return dot(centre_in_space<D>(block, static_cast<std::ptrdiff_t>(c)), up);
  };
  double lowest = std::numeric_limits<double>::infinity(), top = -lowest;
  for (const std::size_t c : cells) {
    lowest = std::min(lowest, height_of(c));
    top = std::max(top, height_of(c));
  }
  if (!(top > lowest)) return;
  const coupler::DonorSearch search(geometry, D);
  std::int64_t hint = -1;
  const auto donor_at = [&](double height) {
    coupler::Vec3 x;
    for (std::size_t k = 0; k < 3; ++k) x[k] = through[k] + (height - dot(through, up)) * up[k];
    return search.find(x, hint);
  };
  const auto add = [&](double height, const coupler::Donor& donor, bool follows) {
    Place place;
    place.height = height;
    place.follows = follows;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t k = 0; k < 8; ++k) {
      if (donor.weight[k] == 0.0) continue;
      place.cell.push_back(cells[static_cast<std::size_t>(donor.cell[k])]);
      place.weight.push_back(donor.weight[k]);
      low = std::min(low, height_of(place.cell.back()));
      high = std::max(high, height_of(place.cell.back()));
    }
    place.reach = high - low;
    places_.push_back(std::move(place));
  };
  constexpr double k_coarsest = 1e-3;  // of the grid's height, where the line is outside of it
  double step = k_coarsest * (top - lowest);
  coupler::Donor before;
  for (double height = lowest, at = lowest; height <= top; at = height, height += step) {
    const coupler::Donor donor = donor_at(height);
    if (donor.found) {
      if (before.found && donor.cell != before.cell) {  // where they change: twice, once for each side
        constexpr int k_halvings = 40;
        double low = at, high = height;
        coupler::Donor below = before;
        for (int i = 0; i < k_halvings; ++i) {
          const double middle = 0.5 * (low + high);
          const coupler::Donor there = donor_at(middle);
          if (there.found && there.cell == before.cell)
            low = middle, below = there;
          else
            high = middle;
        }
        add(low, below, true);
      }
      add(height, donor, before.found);
      step = places_.back().reach > 0.0 ? 0.5 * places_.back().reach : step;
    } else {
      step = k_coarsest * (top - lowest);
    }
    before = donor;
  }
}

template <int D>
Elevation ElevationLine<D>::read(const Field& phi) const {
  const auto value = [&](const Place& place) {
    double sum = 0.0;
    for (std::size_t i = 0; i < place.cell.size(); ++i) sum += place.weight[i] * phi[place.cell[i]];
    return sum;
  };
  double above = 0.0;
  for (std::size_t i = places_.size(); i-- > 0;) {
    const double here = value(places_[i]);
    const bool connected = i + 1 < places_.size() && places_[i + 1].follows;
    if (connected && here < 0.0 && above >= 0.0) {
      const double theta = here / (here - above);
      return {places_[i].height + theta * (places_[i + 1].height - places_[i].height), places_[i].reach, 0.0};
    }
    above = here;
  }
  return {};
}

template class ElevationLine<2>;
template class ElevationLine<3>;

}  // namespace littoral::fv
