#include "coupling/injection_place.hpp"

#include <algorithm>
#include <cmath>

namespace littoral::sph {

namespace {

/// The place in front of the element's centre is taken without looking further if it has this much room
/// [spacing]: the rows of a stream oblique to the face stand about so near to one another where they pass.
constexpr double k_free = 0.75;

/// Where else a particle may appear, nearest to the right place first. Depths from the face [spacing]: the
/// water that the particle stands for is between 0 and 1 deep; deeper ones are for water that presses in
/// while the first rows are full, as at an edge that it enters by both faces.
constexpr double k_depths[] = {0.5, 0.75, 1.0, 0.25, 1.25, 1.5, 1.75, 2.0};
/// Aside from the centre [element]: half an element either way still is the element's own water; a whole one
/// is its neighbour's, which the next particle there makes up for.
constexpr double k_offsets[] = {0.0, -0.5, 0.5, -1.0, 1.0};
/// How many of them belong to the element itself, and how many there are if pressed.
constexpr int k_own_depths = 5, k_own_offsets = 3, k_all_depths = 8, k_all_offsets = 5;

/// Two places are equally good if their rooms differ by round-off only: the first one is taken, on any
/// machine.
constexpr double k_better = 1.0 + 1e-12;

template <int D>
bool in_water(const Point<D>& x, const Exterior& fv, double time, std::int64_t& hint) {
  if (!fv.with_phi()) return true;
  const auto state = fv.at(to_vec3<D>(x), time, hint);
  return state && state->phi < 0.0;
}

}  // namespace

template <int D>
void PresentParticles<D>::add(const Point<D>& x) {
  const auto put = [this](const Point<D>& image) {
    for (std::size_t d = 0; d < D; ++d) x_[d].push_back(image[d]);
  };
  put(x);
  for (std::size_t d = 0; d < D; ++d) {
    if (!box_.periodic[d]) continue;
    const double length = box_.upper[d] - box_.lower[d];
    Point<D> image = x;
    if (x[d] < box_.lower[d] + reach_) image[d] += length;
    if (x[d] > box_.upper[d] - reach_) image[d] -= length;
    if (image[d] != x[d]) put(image);  // an edge's image is missed: a room too large by chance, no more
  }
}

template <int D>
bool PresentParticles<D>::inside(const Point<D>& x) const {
  for (std::size_t d = 0; d < D; ++d)
    if (x[d] < box_.outer_lower[d] || x[d] > box_.outer_upper[d]) return false;
  return true;
}

template <int D>
void PresentParticles<D>::sort() {
  n_sorted_ = x_[0].size();
  if (n_sorted_ > 0) grid_.bin(x_, n_sorted_, reach_);
}

template <int D>
double PresentParticles<D>::room(const Point<D>& x) const {
  double s_min = reach_ * reach_;
  const auto look = [&](std::size_t k) {
    double s = 0.0;
    for (std::size_t d = 0; d < D; ++d) s += (x_[d][k] - x[d]) * (x_[d][k] - x[d]);
    s_min = std::min(s_min, s);
  };
  if (n_sorted_ > 0)
    grid_.for_each_range(x, reach_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) look(static_cast<std::size_t>(grid_.order()[k]));
    });
  for (std::size_t k = n_sorted_; k < x_[0].size(); ++k) look(k);
  double room = std::sqrt(s_min);
  for (std::size_t d = 0; d < D; ++d)
    if (!box_.periodic[d])
      for (std::size_t side = 0; side < 2; ++side)
        if (!box_.open[d][side])
          room = std::min(room, 2.0 * std::fabs(x[d] - (side == 0 ? box_.lower[d] : box_.upper[d])));
  return room;
}

template <int D>
InjectionPlace<D> injection_place(const FaceElement<D>& element, double depth, double least_depth,
                                  double spacing, bool far, const PresentParticles<D>& present,
                                  const Exterior& fv, double time, std::int64_t& hint) {
  InjectionPlace<D> best;
  const auto consider = [&](const Point<D>& x) {
    if (!present.inside(x)) return;
    const double room = present.room(x);
    if (room > best.room * k_better && in_water<D>(x, fv, time, hint)) best = {x, room};
  };
  Point<D> centre = element.centre;
  centre[element.axis] += element.inward * std::clamp(depth, least_depth, spacing);
  consider(centre);
  if (best.room >= k_free * spacing) return best;

  const auto search = [&](int n_depths, int n_offsets) {
    const int sides = D == 2 ? n_offsets : n_offsets * n_offsets;
    for (int j = 0; j < n_depths; ++j) {
      if (k_depths[j] * spacing < least_depth) continue;
      for (int k = 0; k < sides; ++k) {
        Point<D> x = element.centre;
        x[element.axis] += element.inward * k_depths[j] * spacing;
        int rest = k;
        for (std::size_t d = 0; d < D; ++d) {
          if (d == element.axis) continue;
          x[d] += 2.0 * k_offsets[rest % n_offsets] * element.half[d];
          rest /= n_offsets;
        }
        consider(x);
      }
    }
  };
  search(k_own_depths, k_own_offsets);
  if (far) search(k_all_depths, k_all_offsets);
  return best;
}

template class PresentParticles<2>;
template class PresentParticles<3>;
template InjectionPlace<2> injection_place<2>(const FaceElement<2>&, double, double, double, bool,
                                              const PresentParticles<2>&, const Exterior&, double,
                                              std::int64_t&);
template InjectionPlace<3> injection_place<3>(const FaceElement<3>&, double, double, double, bool,
                                              const PresentParticles<3>&, const Exterior&, double,
                                              std::int64_t&);

}  // namespace littoral::sph
