#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace littoral::sph {

/// The cell side, `side` or more [m], at which a box with n points in it has no more than a few cells a
/// point.
template <int D>
double suitable_cell_side(const std::array<double, D>& lower, const std::array<double, D>& upper, double n,
                          double side);

/// Points sorted into the cells of a uniform grid that just contains them. Cells are numbered with the last
/// direction fastest, so the points of neighbouring cells along it lie side by side in `order`. Their sides
/// lie at multiples of the cell side from the origin of space, wherever the points are: grids of the same
/// side cut space alike, on every rank.
template <int D>
class CellGrid {
 public:
  using Columns = std::array<std::vector<double>, D>;

  /// Sorts the first n points. `side` is the least cell side [m]; cells grow where a few far points would
  /// make many empty ones. The order inside a cell is that of the input: independent of the threads.
  void bin(const Columns& x, std::size_t n, double side);
  /// The same with cells of exactly this side.
  void bin_exactly(const Columns& x, std::size_t n, double side);
  /// Puts the points of each cell into the order of their keys, equal keys into that of their coordinates.
  void sort_cells(const Columns& x, const std::vector<std::int64_t>& keys);

  const std::vector<std::int32_t>& order() const { return order_; }  ///< points, cell by cell
  double side() const { return side_; }

  /// Calls f(begin, end) for ranges of `order` that together hold every point within `radius` of x (and some
  /// further ones), in the same sequence every time.
  template <class F>
  void for_each_range(const std::array<double, D>& x, double radius, const F& f) const {
    std::array<std::ptrdiff_t, D> first, last;
    for (std::size_t d = 0; d < D; ++d) {
      first[d] = clamped_cell(x[d] - radius, d, 0);
      last[d] = clamped_cell(x[d] + radius, d, -1);
      if (first[d] > last[d]) return;
    }
    const std::size_t fast = D - 1;
    const auto row = [&](std::ptrdiff_t base) {
      const std::ptrdiff_t c = base * n_[fast];
      f(start_[static_cast<std::size_t>(c + first[fast])],
        start_[static_cast<std::size_t>(c + last[fast] + 1)]);
    };
    for (std::ptrdiff_t i = first[0]; i <= last[0]; ++i) {
      if constexpr (D == 2) {
        row(i);
      } else {
        for (std::ptrdiff_t j = first[1]; j <= last[1]; ++j) row(i * n_[1] + j);
      }
    }
  }

 private:
  /// Cell of a coordinate, moved into the grid; entirely outside it the range first..last comes out empty.
  std::ptrdiff_t clamped_cell(double x, std::size_t d, int end) const;

  void find_bounds(const Columns& x, std::size_t n);

  std::array<double, D> lower_{}, upper_{};  // [m] of the points
  std::array<double, D> first_{};            // cell of space in which the grid begins
  std::array<std::ptrdiff_t, D> n_{};
  double side_ = 0.0;
  double inv_side_ = 0.0;
  std::vector<std::int32_t> order_;  // (n)
  std::vector<std::size_t> start_;   // (cells + 1)
};

extern template class CellGrid<2>;
extern template class CellGrid<3>;

}  // namespace littoral::sph
