#include "level_set/volume.hpp"

#include <algorithm>
#include <cmath>

#include "grid/loops.hpp"

namespace littoral::fv {
namespace {

/// Share of the unit cube below m.x = alpha, for m >= 0 that sum to 1 and are sorted, alpha in [0, 1/2].
double below_plane(const std::array<double, 3>& m, double alpha) {
  const double m1 = m[0], m2 = m[1], m3 = m[2], m12 = m1 + m2;
  constexpr double k_thin = 1e-6;  // below it a direction does not matter, and the cubic loses its digits
  if (m1 < k_thin) {
    if (alpha < m2) return m2 < k_thin ? alpha / m3 : alpha * alpha / (2.0 * m2 * m3);
    return (alpha - 0.5 * m2) / m3;
  }
  if (alpha < m1) return alpha * alpha * alpha / (6.0 * m1 * m2 * m3);
  if (alpha < m2) return alpha * (alpha - m1) / (2.0 * m2 * m3) + m1 * m1 / (6.0 * m2 * m3);
  if (alpha >= m12 && m12 < m3) return (alpha - 0.5 * m12) / m3;
  double sum = alpha * alpha * (3.0 * std::min(1.0, m12) - alpha) + m1 * m1 * (m1 - 3.0 * alpha) +
               m2 * m2 * (m2 - 3.0 * alpha);
  if (alpha >= m3)  // the plane has passed three corners
    sum = alpha * alpha * (3.0 - 2.0 * alpha) + m1 * m1 * (m1 - 3.0 * alpha) + m2 * m2 * (m2 - 3.0 * alpha) +
          m3 * m3 * (m3 - 3.0 * alpha);
  return sum / (6.0 * m1 * m2 * m3);
}

}  // namespace

template <int D>
double wet_share(double value, std::array<double, D> slope) {
  double reach = 0.0;
  for (double& s : slope) {
    s = std::abs(s);
    reach += s;
  }
  if (value >= reach) return 0.0;
  if (value <= -reach) return 1.0;
  std::array<double, 3> m{};
  for (std::size_t d = 0; d < D; ++d) m[d] = slope[d] / reach;
  std::sort(m.begin(), m.end());
  const double alpha = 0.5 * (1.0 - value / reach);
  return alpha <= 0.5 ? below_plane(m, alpha) : 1.0 - below_plane(m, 1.0 - alpha);
}

template <int D>
void wet_shares(const Block<D>& block, const Field& phi, Field& share) {
  share.assign(block.extent.size, 0.0);
  for_each_index<D>({}, block.extent.n, [&](const std::array<int, D>& index) {
    const std::ptrdiff_t c = block.extent.at(index);
    const auto i = static_cast<std::size_t>(c);
    if (block.status[i] == CellStatus::blanked) return;
    std::array<double, D> slope;
    for (std::size_t d = 0; d < D; ++d) {
      const std::ptrdiff_t s = block.extent.stride[d];
      // a cell's half of the difference to each side
      slope[d] = 0.25 * (phi[static_cast<std::size_t>(c + s)] - phi[static_cast<std::size_t>(c - s)]);
    }
    share[i] = wet_share<D>(phi[i], slope);
  });
}

template <int D>
double water_volume(const std::vector<Block<D>>& blocks, const std::vector<Field>& phi) {
  double sum = 0.0;
  Field share;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    wet_shares(blocks[b], phi[b], share);
    for_each_index<D>({}, blocks[b].extent.n, [&](const std::array<int, D>& index) {
      const auto c = static_cast<std::size_t>(blocks[b].extent.at(index));
      sum += counted_share(blocks[b], c) * share[c] * blocks[b].volume[c];
    });
  }
  return sum;
}

template double wet_share<2>(double, std::array<double, 2>);
template double wet_share<3>(double, std::array<double, 3>);
template void wet_shares(const Block<2>&, const Field&, Field&);
template void wet_shares(const Block<3>&, const Field&, Field&);
template double water_volume(const std::vector<Block<2>>&, const std::vector<Field>&);
template double water_volume(const std::vector<Block<3>>&, const std::vector<Field>&);

}  // namespace littoral::fv
