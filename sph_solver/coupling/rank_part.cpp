#include "coupling/rank_part.hpp"

namespace littoral::sph {

template <int D>
coupler::Box rank_part(const coupler::Box& whole, const RankBox<D>& mine, const DomainBox<D>& domain,
                       double skin) {
  if (whole.empty()) return whole;
  coupler::Box part = whole;
  for (std::size_t d = 0; d < D; ++d) {
    if (!(mine.lower[d] < mine.upper[d])) return coupler::Box::nothing();
    const bool at_a_side = mine.lower[d] < domain.lower[d] + skin || mine.upper[d] > domain.upper[d] - skin;
    if (skin > 0.0 && domain.is_periodic(d) && at_a_side) continue;
    const std::size_t axis = space_axis<D>(d);
    part.lower[axis] = std::max(part.lower[axis], mine.lower[d] - skin);
    part.upper[axis] = std::min(part.upper[axis], mine.upper[d] + skin);
  }
  return part.empty() ? coupler::Box::nothing() : part;
}

template coupler::Box rank_part<2>(const coupler::Box&, const RankBox<2>&, const DomainBox<2>&, double);
template coupler::Box rank_part<3>(const coupler::Box&, const RankBox<3>&, const DomainBox<3>&, double);

}  // namespace littoral::sph
