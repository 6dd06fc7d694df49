#include "parallel/whole.hpp"

#include "grid/loops.hpp"

namespace littoral::fv {
namespace {

template <int D, class Body>
void for_each_place_of(const Layout<D>& layout, std::size_t b, bool ghosts, Body&& body) {
  const auto& part = layout.part[b];
  for_each_place<D>(layout.shape[b].extent, Extent<D>(layout.whole[part.whole].cells), part.first, ghosts,
                    body);
}

}  // namespace

template <int D>
std::vector<Field> gather_whole(const Layout<D>& layout, const std::vector<const Field*>& own) {
  const Ranks& ranks = layout.owners.ranks;
  std::vector<std::vector<double>> out(static_cast<std::size_t>(ranks.size()));
  for (const Field* field : own) out[0].insert(out[0].end(), field->begin(), field->end());
  const std::vector<std::vector<double>> all = ranks.swap(out);
  std::vector<Field> wholes;
  if (!ranks.root()) return wholes;
  for (const auto& whole : layout.whole) wholes.emplace_back(Extent<D>(whole.cells).size, 0.0);
  for (const bool ghosts : {true, false}) {  // cells have the last word over the ghosts of their neighbours
    std::vector<std::size_t> first(all.size(), 0);
    for (std::size_t b = 0; b < layout.size(); ++b) {
      const auto rank = static_cast<std::size_t>(layout.owners.rank[b]);
      const double* part = all[rank].data() + first[rank];
      Field& whole = wholes[layout.part[b].whole];
      for_each_place_of<D>(layout, b, ghosts,
                           [&](std::size_t here, std::size_t there) { whole[there] = part[here]; });
      first[rank] += layout.shape[b].extent.size;
    }
  }
  return wholes;
}

template <int D>
Field part_of(const Layout<D>& layout, std::size_t b, const Field& whole) {
  Field part(layout.shape[b].extent.size);
  for_each_place_of<D>(layout, b, true,
                       [&](std::size_t here, std::size_t there) { part[here] = whole[there]; });
  return part;
}

template std::vector<Field> gather_whole<2>(const Layout<2>&, const std::vector<const Field*>&);
template std::vector<Field> gather_whole<3>(const Layout<3>&, const std::vector<const Field*>&);
template Field part_of<2>(const Layout<2>&, std::size_t, const Field&);
template Field part_of<3>(const Layout<3>&, std::size_t, const Field&);

}  // namespace littoral::fv
