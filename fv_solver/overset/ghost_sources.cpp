#include "overset/ghost_sources.hpp"

#include "boundary/links.hpp"
#include "grid/loops.hpp"

namespace littoral::fv {
namespace {

template <int D>
bool inside(const Extent<D>& extent, const std::array<int, D>& index) {
  for (std::size_t d = 0; d < D; ++d)
    if (index[d] < 0 || index[d] >= extent.n[d]) return false;
  return true;
}

}  // namespace

template <int D>
GhostSources<D>::GhostSources(const std::vector<Extent<D>>& extents,
                              const std::vector<std::array<bool, D>>& periodic,
                              const std::vector<std::array<std::array<double, D>, D>>& period,
                              const std::vector<JoinSide<D>>& joins)
    : of_(extents.size()) {
  for (std::size_t b = 0; b < extents.size(); ++b) {
    const Extent<D>& e = extents[b];
    std::array<int, D> lower{}, upper = e.n;
    bool any = false;
    for (std::size_t d = 0; d < D; ++d) {
      if (!periodic[b][d]) continue;
      any = true;
      lower[d] = -1;
      upper[d] = e.n[d] + 1;
    }
    if (!any) continue;
    for_each_index<D>(lower, upper, [&](const std::array<int, D>& index) {
      if (inside<D>(e, index)) return;
      GhostSource<D> source;
      source.block = b;
      std::array<int, D> image = index;
      for (std::size_t d = 0; d < D; ++d) {
        if (index[d] >= 0 && index[d] < e.n[d]) continue;
        const double sign = index[d] < 0 ? 1.0 : -1.0;
        image[d] += index[d] < 0 ? e.n[d] : -e.n[d];
        for (std::size_t k = 0; k < D; ++k) source.offset[k] += sign * period[b][d][k];
      }
      source.cell = e.at(image);
      of_[b].emplace(e.at(index), source);
    });
  }
  // ghosts beyond one face first: those beyond edges and corners read the other block's ghosts
  for (std::size_t beyond_wanted = 0; beyond_wanted < D; ++beyond_wanted)
    for (const JoinSide<D>& side : joins)
      for_each_ghost<D>(side, extents[side.block].n, 1,
                        [&](const std::array<int, D>& index, int layer, std::size_t beyond) {
                          if (beyond != beyond_wanted) return;
                          const Extent<D>& there = extents[side.there.block];
                          const std::array<int, D> other = side.image(index, layer, there.n);
                          for (std::size_t d = 0; d < D; ++d)
                            if (other[d] < -1 || other[d] > there.n[d]) return;
                          GhostSource<D> source;
                          source.block = side.there.block;
                          source.cell = there.at(other);
                          if (!inside<D>(there, other)) {
                            const GhostSource<D>* further = find(side.there.block, source.cell);
                            if (further == nullptr) return;
                            source = *further;
                          }
                          for (std::size_t k = 0; k < D; ++k) source.offset[k] += side.there.offset[k];
                          of_[side.block].emplace(extents[side.block].at(index), source);
                        });
}

template class GhostSources<2>;
template class GhostSources<3>;

}  // namespace littoral::fv
