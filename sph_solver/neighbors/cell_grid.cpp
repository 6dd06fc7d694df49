#include "neighbors/cell_grid.hpp"

#include <algorithm>
#include <cmath>

namespace littoral::sph {
namespace {
constexpr double k_cells_per_point = 4.0;  // memory of the grid stays of the order of the particles'
constexpr double k_cells_at_least = 4096.0;
}  // namespace

template <int D>
void CellGrid<D>::find_bounds(const Columns& x, std::size_t n) {
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
    upper_[d] = high;
  }
}

template <int D>
double suitable_cell_side(const std::array<double, D>& lower, const std::array<double, D>& upper, double n,
                          double side) {
  const double most = std::max(k_cells_at_least, k_cells_per_point * n);
  for (;;) {
    double cells = 1.0;
    for (std::size_t d = 0; d < D; ++d) cells *= std::floor(std::max(0.0, upper[d] - lower[d]) / side) + 1.0;
    if (!(cells > most)) return side;
    side *= std::max(1.05, std::pow(cells / most, 1.0 / D));
  }
}

template <int D>
void CellGrid<D>::bin(const Columns& x, std::size_t n, double side) {
  find_bounds(x, n);
  bin_exactly(x, n, suitable_cell_side<D>(lower_, upper_, static_cast<double>(n), side));
}

template <int D>
void CellGrid<D>::bin_exactly(const Columns& x, std::size_t n, double side) {
  find_bounds(x, n);
  order_.resize(n);
  std::vector<std::int32_t> cell_of(n);
  side_ = side;
  inv_side_ = 1.0 / side_;
  std::size_t cells = 1;
  for (std::size_t d = 0; d < D; ++d) {
    first_[d] = std::floor(lower_[d] * inv_side_);
    n_[d] = static_cast<std::ptrdiff_t>(std::floor(upper_[d] * inv_side_) - first_[d]) + 1;
    cells *= static_cast<std::size_t>(n_[d]);
  }

  const auto count = static_cast<std::ptrdiff_t>(n);
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    std::ptrdiff_t cell = 0;
    for (std::size_t d = 0; d < D; ++d) {
      const double k = std::floor(x[d][static_cast<std::size_t>(i)] * inv_side_) - first_[d];
      cell = cell * n_[d] + std::clamp<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(k), 0, n_[d] - 1);
    }
    cell_of[static_cast<std::size_t>(i)] = static_cast<std::int32_t>(cell);
  }

  start_.assign(cells + 1, 0);  // counting sort: stable, so the same for any number of threads
  for (std::size_t i = 0; i < n; ++i) ++start_[static_cast<std::size_t>(cell_of[i]) + 1];
  for (std::size_t c = 0; c < cells; ++c) start_[c + 1] += start_[c];
  for (std::size_t i = 0; i < n; ++i)
    order_[start_[static_cast<std::size_t>(cell_of[i])]++] = static_cast<std::int32_t>(i);
  for (std::size_t c = cells; c > 0; --c) start_[c] = start_[c - 1];
  start_[0] = 0;
}

template <int D>
void CellGrid<D>::sort_cells(const Columns& x, const std::vector<std::int64_t>& keys) {
  const auto before = [&x, &keys](std::int32_t a, std::int32_t b) {
    const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
    if (keys[i] != keys[j]) return keys[i] < keys[j];
    for (std::size_t d = 0; d < D; ++d)
      if (x[d][i] != x[d][j]) return x[d][i] < x[d][j];
    return false;
  };
  const auto n_cells = static_cast<std::ptrdiff_t>(start_.size()) - 1;
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t c = 0; c < n_cells; ++c) {  // a handful of points each, mostly in order: insertion sort
    const std::size_t begin = start_[static_cast<std::size_t>(c)],
                      end = start_[static_cast<std::size_t>(c) + 1];
    for (std::size_t k = begin + 1; k < end; ++k) {
      const std::int32_t point = order_[k];
      std::size_t place = k;
      for (; place > begin && before(point, order_[place - 1]); --place) order_[place] = order_[place - 1];
      order_[place] = point;
    }
  }
}

template <int D>
std::ptrdiff_t CellGrid<D>::clamped_cell(double x, std::size_t d, int end) const {
  // first cell of a range (end 0): below the grid 0, above it n; last cell (end -1): below -1, above n-1
  const double k = std::floor(x * inv_side_) - first_[d];
  const double low = end == 0 ? 0.0 : -1.0;
  const double high = static_cast<double>(n_[d]) + end;
  return static_cast<std::ptrdiff_t>(std::clamp(k, low, high));
}

template double suitable_cell_side<2>(const std::array<double, 2>&, const std::array<double, 2>&, double,
                                      double);
template double suitable_cell_side<3>(const std::array<double, 3>&, const std::array<double, 3>&, double,
                                      double);
template class CellGrid<2>;
template class CellGrid<3>;

}  // namespace littoral::sph
