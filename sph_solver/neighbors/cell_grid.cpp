#include "neighbors/cell_grid.hpp"

#include <algorithm>
#include <cmath>

namespace littoral::sph {
namespace {
constexpr double k_cells_per_point = 4.0;  // memory of the grid stays of the order of the particles'
constexpr double k_cells_at_least = 4096.0;
}  // namespace

template <int D>
void CellGrid<D>::bin(const Columns& x, std::size_t n, double side) {
  order_.resize(n);
  cell_of_.resize(n);
  std::array<double, D> upper{};
  for (std::size_t d = 0; d < D; ++d) {
    double low = n > 0 ? x[d][0] : 0.0, high = low;
    const double* column = x[d].data();
    const auto count = static_cast<std::ptrdiff_t>(n);
#pragma omp parallel for schedule(static) reduction(min : low) reduction(max : high)
    for (std::ptrdiff_t i = 0; i < count; ++i) {
      low = std::min(low, column[i]);
      high = std::max(high, column[i]);
    }
    lower_[d] = low;
    upper[d] = high;
  }

  const double most = std::max(k_cells_at_least, k_cells_per_point * static_cast<double>(n));
  side_ = side;
  for (;;) {
    double cells = 1.0;
    for (std::size_t d = 0; d < D; ++d) cells *= std::floor((upper[d] - lower_[d]) / side_) + 1.0;
    if (cells <= most) break;
    side_ *= std::max(1.05, std::pow(cells / most, 1.0 / D));
  }
  inv_side_ = 1.0 / side_;
  std::size_t cells = 1;
  for (std::size_t d = 0; d < D; ++d) {
    n_[d] = static_cast<std::ptrdiff_t>((upper[d] - lower_[d]) * inv_side_) + 1;
    cells *= static_cast<std::size_t>(n_[d]);
  }

  const auto count = static_cast<std::ptrdiff_t>(n);
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    std::ptrdiff_t cell = 0;
    for (std::size_t d = 0; d < D; ++d) {
      const auto k = static_cast<std::ptrdiff_t>((x[d][static_cast<std::size_t>(i)] - lower_[d]) * inv_side_);
      cell = cell * n_[d] + std::clamp<std::ptrdiff_t>(k, 0, n_[d] - 1);
    }
    cell_of_[static_cast<std::size_t>(i)] = static_cast<std::int32_t>(cell);
  }

  start_.assign(cells + 1, 0);  // counting sort: stable, so the same for any number of threads
  for (std::size_t i = 0; i < n; ++i) ++start_[static_cast<std::size_t>(cell_of_[i]) + 1];
  for (std::size_t c = 0; c < cells; ++c) start_[c + 1] += start_[c];
  for (std::size_t i = 0; i < n; ++i)
    order_[start_[static_cast<std::size_t>(cell_of_[i])]++] = static_cast<std::int32_t>(i);
  for (std::size_t c = cells; c > 0; --c) start_[c] = start_[c - 1];
  start_[0] = 0;
}

template <int D>
std::ptrdiff_t CellGrid<D>::clamped_cell(double x, std::size_t d, int end) const {
  // first cell of a range (end 0): below the grid 0, above it n; last cell (end -1): below -1, above n-1
  const double k = std::floor((x - lower_[d]) * inv_side_);
  const double low = end == 0 ? 0.0 : -1.0;
  const double high = static_cast<double>(n_[d]) + end;
  return static_cast<std::ptrdiff_t>(std::clamp(k, low, high));
}

template class CellGrid<2>;
template class CellGrid<3>;

}  // namespace littoral::sph
