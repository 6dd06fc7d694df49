#include "implicit/held_directions.hpp"

#include <algorithm>
#include <cmath>

#include "grid/loops.hpp"
#include "implicit/line_layout.hpp"

namespace littoral::fv {

template <int D>
std::array<bool, D> held_directions(const LevelGrid<D>& grid, const std::array<int, D>& ratio) {
  std::array<bool, D> held{};
  if (D < 3) return held;
  constexpr double k_long = 3.0;  // against the second thinnest
  std::array<double, D> is_long{};
  double n = 0.0;
  for_each_cell<D>(grid.extent, [&](const auto&, std::ptrdiff_t c) {
    if (!grid.solved(c)) return;
    n += 1.0;
    const std::array<double, D> h = thickness<D>(grid, c);
    std::array<double, D> sorted = h;
    std::sort(sorted.begin(), sorted.end());
    if (sorted[D - 1] < k_long * sorted[D - 2]) return;
    ++is_long[static_cast<std::size_t>(std::max_element(h.begin(), h.end()) - h.begin())];
  });
  for (std::size_t d = 0; d < D; ++d) held[d] = is_long[d] > 0.05 * n;
  if (std::all_of(held.begin(), held.end(), [](bool h) { return h; }))
    held[static_cast<std::size_t>(std::min_element(is_long.begin(), is_long.end()) - is_long.begin())] =
        false;
  bool goes_on = false;
  for (std::size_t d = 0; d < D; ++d) goes_on = goes_on || (!held[d] && ratio[d] > 1);
  return goes_on ? held : std::array<bool, D>{};
}

template <int D>
std::vector<std::array<bool, D>> all_held_directions(const std::vector<const LevelGrid<D>*>& grids,
                                                     const std::vector<BlockShape<D>>& shapes,
                                                     const Owners& owners) {
  const std::vector<std::size_t> mine = owners.mine();
  std::vector<double> flags(D * shapes.size(), 0.0);
  for (std::size_t i = 0; i < grids.size(); ++i) {
    const BlockShape<D>& shape = shapes[mine[i]];
    const auto held = held_directions<D>(*grids[i], coarsening_ratio<D>(shape.extent.n, shape.periodic));
    for (std::size_t d = 0; d < D; ++d) flags[D * mine[i] + d] = held[d] ? 1.0 : 0.0;
  }
  owners.ranks.sum(flags.data(), flags.size());
  std::vector<std::array<bool, D>> all(shapes.size());
  for (std::size_t b = 0; b < shapes.size(); ++b)
    for (std::size_t d = 0; d < D; ++d) all[b][d] = flags[D * b + d] > 0.0;
  return all;
}

template std::array<bool, 2> held_directions<2>(const LevelGrid<2>&, const std::array<int, 2>&);
template std::array<bool, 3> held_directions<3>(const LevelGrid<3>&, const std::array<int, 3>&);
template std::vector<std::array<bool, 2>> all_held_directions<2>(const std::vector<const LevelGrid<2>*>&,
                                                                 const std::vector<BlockShape<2>>&,
                                                                 const Owners&);
template std::vector<std::array<bool, 3>> all_held_directions<3>(const std::vector<const LevelGrid<3>*>&,
                                                                 const std::vector<BlockShape<3>>&,
                                                                 const Owners&);

}  // namespace littoral::fv
