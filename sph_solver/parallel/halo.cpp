#include "parallel/halo.hpp"

#include <algorithm>

namespace littoral::sph {

template <int D>
std::vector<std::array<double, D>> periodic_shifts(const DomainBox<D>& box) {
  std::vector<std::array<double, D>> shifts(1);
  shifts[0].fill(0.0);
  for (std::size_t d = 0; d < D; ++d) {
    if (!box.is_periodic(d)) continue;
    const std::size_t n = shifts.size();
    for (const double sign : {1.0, -1.0})
      for (std::size_t k = 0; k < n; ++k) {
        auto shift = shifts[k];
        shift[d] = sign * box.length(d);
        shifts.push_back(shift);
      }
  }
  return shifts;
}

template <int D>
bool may_reach(const RankBox<D>& from, const std::array<double, D>& shift, const RankBox<D>& wants,
               double reach) {
  for (std::size_t d = 0; d < D; ++d) {
    if (from.lower[d] > from.upper[d] || wants.lower[d] > wants.upper[d]) return false;
    if (from.upper[d] + shift[d] < wants.lower[d] - reach ||
        from.lower[d] + shift[d] > wants.upper[d] + reach)
      return false;
  }
  return true;
}

template <int D>
void choose_halo(const Particles<D>& particles, const HaloBoxes<D>& mine,
                 const std::vector<std::array<double, D>>& shifts, const RankBox<D>& wants, double reach,
                 std::vector<HaloEntry>& entries) {
  for (std::size_t s = 0; s < shifts.size(); ++s) {
    const auto& shift = shifts[s];
    if (!may_reach<D>(mine.holds, shift, wants, reach)) continue;
    for (std::size_t i = 0; i < particles.n_owned; ++i) {
      double r2 = 0.0;
      for (std::size_t d = 0; d < D; ++d) {
        const double x = particles.x[d][i] + shift[d];
        const double outside = std::max({wants.lower[d] - x, x - wants.upper[d], 0.0});
        r2 += outside * outside;
      }
      if (r2 < reach * reach) entries.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(s)});
    }
  }
}

template std::vector<std::array<double, 2>> periodic_shifts<2>(const DomainBox<2>&);
template std::vector<std::array<double, 3>> periodic_shifts<3>(const DomainBox<3>&);
template bool may_reach<2>(const RankBox<2>&, const std::array<double, 2>&, const RankBox<2>&, double);
template bool may_reach<3>(const RankBox<3>&, const std::array<double, 3>&, const RankBox<3>&, double);
template void choose_halo<2>(const Particles<2>&, const HaloBoxes<2>&,
                             const std::vector<std::array<double, 2>>&, const RankBox<2>&, double,
                             std::vector<HaloEntry>&);
template void choose_halo<3>(const Particles<3>&, const HaloBoxes<3>&,
                             const std::vector<std::array<double, 3>>&, const RankBox<3>&, double,
                             std::vector<HaloEntry>&);

}  // namespace littoral::sph
