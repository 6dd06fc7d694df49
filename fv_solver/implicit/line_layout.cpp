#include "implicit/line_layout.hpp"

#include <algorithm>
#include <cmath>

namespace littoral::fv {

namespace {

/// Smallest colour that none of the line's coloured neighbours has; lines are visited in index order, so a
/// plain grid comes out as a checkerboard.
template <int D>
std::vector<int> colour_lines(const LevelGrid<D>& grid, int direction) {
  std::vector<int> colour(grid.face_cells(direction), -1);
  std::array<int, D> plane = grid.extent.n;
  plane[static_cast<std::size_t>(direction)] = 1;
  for_each_cell<D>(Extent<D>(plane), [&](const auto& index, std::ptrdiff_t) {
    unsigned taken = 0;
    for (std::size_t d = 0; d < D; ++d) {
      if (static_cast<int>(d) == direction) continue;
      for (int step : {-1, 1}) {
        auto other = index;
        other[d] += step;
        if (grid.periodic[d]) other[d] = (other[d] + plane[d]) % plane[d];
        if (other[d] < 0 || other[d] >= plane[d]) continue;
        const int c = colour[grid.face_index(direction, other)];
        if (c >= 0) taken |= 1u << c;
      }
    }
    int c = 0;
    while (taken & (1u << c)) ++c;
    colour[grid.face_index(direction, index)] = c;
  });
  return colour;
}

}  // namespace

template <int D>
LineLayout line_layout(const LevelGrid<D>& grid, int direction) {
  const auto dir = static_cast<std::size_t>(direction);
  LineLayout layout;
  layout.direction = direction;
  layout.length = grid.extent.n[dir];
  layout.stride = grid.extent.stride[dir];
  layout.cyclic = grid.periodic[dir] && layout.length > 1;

  const std::vector<int> colour = colour_lines(grid, direction);
  const int n_colours = *std::max_element(colour.begin(), colour.end()) + 1;
  std::array<int, D> plane = grid.extent.n;
  plane[dir] = 1;
  // Bundles that keep to a row of cells are loaded fast; lanes left over at the row's end cost less than that
  // where they are few.
  const auto row_of = [](std::array<int, D> index) {
    index[0] = 0;
    return index;
  };
  const int in_row = (plane[0] + 1) / 2;
  const bool rows_apart = direction != 0 && (in_row + k_lanes - 1) / k_lanes * k_lanes <= in_row + in_row / 4;
  for (int c = 0; c < n_colours; ++c) {
    const std::size_t begin = layout.bundles.size();
    std::array<int, D> c_row = row_of({});
    Extent<D> lines(plane);
    lines.stride = grid.extent.stride;
    lines.origin = grid.extent.origin;
    for_each_cell<D>(lines, [&](const auto& index, std::ptrdiff_t) {
      if (colour[grid.face_index(direction, index)] != c) return;
      const bool new_row = rows_apart && !(c_row == row_of(index));
      if (layout.bundles.size() == begin || layout.bundles.back().n_lines == k_lanes || new_row)
        layout.bundles.emplace_back();
      c_row = row_of(index);
      auto& bundle = layout.bundles.back();
      bundle.first[static_cast<std::size_t>(bundle.n_lines++)] = grid.extent.at(index);
    });
    layout.colour_end.push_back(layout.bundles.size());
  }
  for (auto& bundle : layout.bundles) {
    for (int l = bundle.n_lines; l < k_lanes; ++l)
      bundle.first[static_cast<std::size_t>(l)] = bundle.first[static_cast<std::size_t>(bundle.n_lines - 1)];
    const std::ptrdiff_t step = bundle.first[1] - bundle.first[0];
    bool even = step == 1 || step == 2;
    for (std::size_t l = 1; l < k_lanes; ++l) even = even && bundle.first[l] - bundle.first[l - 1] == step;
    if (even) bundle.spacing = step == 1 ? LanePattern::one : LanePattern::two;
  }
  return layout;
}

template <int D>
std::array<double, D> thickness(const LevelGrid<D>& grid, std::ptrdiff_t c) {
  std::array<double, D> h;
  for (std::size_t d = 0; d < D; ++d) {
    double s2 = 0.0;
    for (std::size_t k = 0; k < D; ++k) {
      const double a = 0.5 * (grid.area[d][k][static_cast<std::size_t>(c)] +
                              grid.area[d][k][static_cast<std::size_t>(c + grid.extent.stride[d])]);
      s2 += a * a;
    }
    h[d] = grid.volume[static_cast<std::size_t>(c)] / std::max(std::sqrt(s2), 1e-300);
  }
  return h;
}

template <int D>
std::vector<int> stiff_directions(const LevelGrid<D>& grid) {
  std::vector<std::array<double, D>> h;
  for_each_cell<D>(grid.extent, [&](const auto&, std::ptrdiff_t c) {
    if (grid.solved(c)) h.push_back(thickness<D>(grid, c));
  });
  const std::size_t n = h.size();
  std::vector<int> chosen;
  std::vector<double> thinnest(n, 0.0);  // of the chosen directions
  while (chosen.size() < D) {
    int best = -1;
    double best_gain = 0.0;
    for (int d = D - 1; d >= 0; --d) {
      const auto s = static_cast<std::size_t>(d);
      if (grid.extent.n[s] < 2 || std::find(chosen.begin(), chosen.end(), d) != chosen.end()) continue;
      double gain = 0.0;
      if (chosen.empty()) {  // mean logarithm of the anisotropy
        for (const auto& cell : h) gain += std::log(*std::max_element(cell.begin(), cell.end()) / cell[s]);
        // Closed lines are for a tie only. Lines along direction 1 stay within a plane of memory, which is
        // worth a tenth of a step where cells are almost cubes and others are not much longer.
        const bool long_enough = 3 * grid.extent.n[s] >= 2 * grid.extent.n[D - 1];
        const double preferred = grid.periodic[s] ? 0.0 : d == 1 && long_enough ? 0.3 : 0.1;
        gain = gain / static_cast<double>(std::max<std::size_t>(n, 1)) + preferred + 1e-3;
      } else {
        std::size_t thinner = 0;
        for (std::size_t i = 0; i < n; ++i)
          if (2.0 * h[i][s] < thinnest[i]) ++thinner;
        gain = static_cast<double>(thinner) / static_cast<double>(std::max<std::size_t>(n, 1));
        if (gain < 0.05) gain = 0.0;
      }
      if (gain > best_gain * (1.0 + 1e-6)) {
        best_gain = gain;
        best = d;
      }
    }
    if (best < 0) break;
    for (std::size_t i = 0; i < n; ++i) {
      const double now = h[i][static_cast<std::size_t>(best)];
      thinnest[i] = chosen.empty() ? now : std::min(thinnest[i], now);
    }
    chosen.push_back(best);
  }
  if (chosen.empty()) chosen.push_back(D - 1);
  return chosen;
}

template LineLayout line_layout(const LevelGrid<2>&, int);
template LineLayout line_layout(const LevelGrid<3>&, int);
template std::array<double, 2> thickness<2>(const LevelGrid<2>&, std::ptrdiff_t);
template std::array<double, 3> thickness<3>(const LevelGrid<3>&, std::ptrdiff_t);
template std::vector<int> stiff_directions(const LevelGrid<2>&);
template std::vector<int> stiff_directions(const LevelGrid<3>&);

}  // namespace littoral::fv
