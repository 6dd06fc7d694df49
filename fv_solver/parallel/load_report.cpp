#include "parallel/load_report.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdio>

#include "implicit/level_joins.hpp"

namespace littoral::fv {
namespace {

/// Halvings that every direction of a block takes part in on its way to the coarsest level, the fewest of
/// any.
template <int D>
int halvings(std::vector<BlockShape<D>> shapes, std::vector<JoinSide<D>> joins) {
  std::vector<std::array<int, D>> count(shapes.size(), std::array<int, D>{});
  for (bool coarsens = true; coarsens;) {
    coarsens = false;
    const std::vector<std::array<int, D>> ratios = joint_ratios<D>(shapes, joins);
    for (std::size_t b = 0; b < shapes.size(); ++b)
      for (std::size_t d = 0; d < D; ++d) {
        if (ratios[b][d] < 2) continue;
        coarsens = true;
        ++count[b][d];
      }
    joins = coarse_joins<D>(joins, ratios);
    shapes = coarse_shapes<D>(shapes, ratios);
  }
  int fewest = count.empty() ? 0 : count[0][0];
  for (const auto& of : count) fewest = std::min(fewest, *std::min_element(of.begin(), of.end()));
  return fewest;
}

}  // namespace

template <int D>
std::vector<std::string> load_report(const Layout<D>& layout) {
  constexpr int k_named = 8;  // ranks that get a line of their own
  const int n = layout.owners.ranks.size();
  std::vector<std::int64_t> cells(static_cast<std::size_t>(n), 0), blocks(cells);
  std::int64_t total = 0, most = 0;
  for (std::size_t b = 0; b < layout.size(); ++b) {
    const auto rank = static_cast<std::size_t>(layout.owners.rank[b]);
    cells[rank] += layout.shape[b].extent.cells();
    ++blocks[rank];
    total += layout.shape[b].extent.cells();
  }
  for (const std::int64_t c : cells) most = std::max(most, c);
  std::vector<std::string> report;
  char text[160];
  std::snprintf(text, sizeof text,
                "%d ranks: %zu blocks, %zu before they were cut; the fullest rank has %.3f "
                "times the mean of cells; every block can be halved %d times",
                n, layout.size(), layout.whole.size(),
                static_cast<double>(most) * n / static_cast<double>(total),
                halvings<D>(layout.shape, layout.joins));
  report.emplace_back(text);
  for (int r = 0; r < std::min(n, k_named); ++r) {
    const auto at = static_cast<std::size_t>(r);
    std::snprintf(text, sizeof text, "rank %d: %lld cells in %lld blocks", r,
                  static_cast<long long>(cells[at]), static_cast<long long>(blocks[at]));
    report.emplace_back(text);
  }
  return report;
}

template std::vector<std::string> load_report(const Layout<2>&);
template std::vector<std::string> load_report(const Layout<3>&);

}  // namespace littoral::fv
