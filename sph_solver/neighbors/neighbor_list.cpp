#include "neighbors/neighbor_list.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>

namespace littoral::sph {
namespace {

constexpr double k_cells_per_reach = 2.0;  // five rows of half-size cells hold fewer strangers than three

/// Appends to `row` those of sorted[begin, end) within `reach` of x, without branches. `row` must have room.
template <int D>
std::size_t append_within(const std::array<std::vector<double>, D>& sorted,
                          const std::vector<std::int32_t>& order, const std::array<double, D>& x,
                          double reach_squared, std::int32_t self, std::size_t begin, std::size_t end,
                          std::int32_t* row) {
  std::size_t n = 0;
  for (std::size_t k = begin; k < end; ++k) {
    double r2 = 0.0;
    for (std::size_t d = 0; d < D; ++d) r2 += (sorted[d][k] - x[d]) * (sorted[d][k] - x[d]);
    const std::int32_t j = order[k];
    row[n] = j;
    n += static_cast<std::size_t>(static_cast<int>(r2 < reach_squared) & static_cast<int>(j != self));
  }
  return n;
}

}  // namespace

template <int D>
const std::vector<std::int32_t>& NeighborList<D>::space_order(const Particles<D>& particles) {
  owned_grid_.bin(particles.x, particles.n_owned, least_cell_side());
  owned_grid_.sort_cells(particles.x, particles.id);
  return owned_grid_.order();
}

template <int D>
double NeighborList<D>::least_cell_side() const {
  return reach() / k_cells_per_reach;
}

template <int D>
void NeighborList<D>::build(const Particles<D>& particles) {
  grid_.bin(particles.x, particles.size(), least_cell_side());
  build(particles, grid_.side());
}

template <int D>
void NeighborList<D>::build(const Particles<D>& particles, double cell_side) {
  const std::size_t n_all = particles.size();
  const std::size_t n = particles.n_owned;
  revision_ = particles.revision;
  built_ = true;
  grid_.bin_exactly(particles.x, n_all, cell_side);
  grid_.sort_cells(particles.x, particles.id);
  const auto& order = grid_.order();
  for (std::size_t d = 0; d < D; ++d) {
    x_sorted_[d].resize(n_all);
    const auto count = static_cast<std::ptrdiff_t>(n_all);
    const double* from = particles.x[d].data();
    double* to = x_sorted_[d].data();
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t k = 0; k < count; ++k) to[k] = from[order[static_cast<std::size_t>(k)]];
    x_at_build_[d].assign(particles.x[d].begin(), particles.x[d].begin() + static_cast<std::ptrdiff_t>(n));
  }

  // Each thread fills the rows of a contiguous share of the particles, then the shares are joined in order.
  start_.assign(n + 1, 0);
  std::vector<std::vector<std::int32_t>> shares(static_cast<std::size_t>(omp_get_max_threads()));
  const double reach_squared = reach() * reach();
#pragma omp parallel
  {
    const auto thread = static_cast<std::size_t>(omp_get_thread_num());
    const auto threads = static_cast<std::size_t>(omp_get_num_threads());
    const std::size_t begin = n * thread / threads, end = n * (thread + 1) / threads;
    auto& share = shares[thread];
    share.resize(std::max<std::size_t>(4096, list_.size() / threads));
    std::size_t filled = 0;
    for (std::size_t i = begin; i < end; ++i) {
      std::array<double, D> x;
      for (std::size_t d = 0; d < D; ++d) x[d] = particles.x[d][i];
      const std::size_t row = filled;
      grid_.for_each_range(x, reach(), [&](std::size_t b, std::size_t e) {
        if (filled + (e - b) > share.size()) share.resize(2 * (filled + (e - b)));
        filled += append_within<D>(x_sorted_, order, x, reach_squared, static_cast<std::int32_t>(i), b, e,
                                   share.data() + filled);
      });
      start_[i + 1] = filled - row;
    }
    share.resize(filled);
#pragma omp barrier
#pragma omp single
    {
      for (std::size_t i = 0; i < n; ++i) start_[i + 1] += start_[i];
      list_.resize(start_[n]);
    }
    std::copy(share.begin(), share.end(), list_.begin() + static_cast<std::ptrdiff_t>(start_[begin]));
  }
}

template <int D>
bool NeighborList<D>::outdated(const Particles<D>& particles, double ahead) const {
  if (!built_ || revision_ != particles.revision) return true;
  const auto n = static_cast<std::ptrdiff_t>(particles.n_owned);
  double most = 0.0;
#pragma omp parallel for schedule(static) reduction(max : most)
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    double r2 = 0.0;
    for (std::size_t d = 0; d < D; ++d) {
      const double moved = particles.x[d][k] + ahead * particles.u[d][k] - x_at_build_[d][k];
      r2 += moved * moved;
    }
    most = std::max(most, r2);
  }
  return !(most <= 0.25 * skin_ * skin_);
}

template class NeighborList<2>;
template class NeighborList<3>;

}  // namespace littoral::sph
