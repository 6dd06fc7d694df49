#include "neighbors/neighbor_list.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>

namespace littoral::sph {
namespace {

constexpr double k_cells_per_reach = 2.0;  // five rows of half-size cells hold fewer strangers than three
constexpr std::size_t k_spare = 16;        // a share of the lists gets 1/16 more than it needs

}  // namespace

template <int D>
std::vector<std::int32_t> NeighborList<D>::space_order(const Particles<D>& particles) const {
  CellGrid<D> grid;
  grid.bin(particles.x, particles.n_owned, kernel_radius_ / k_cells_per_reach);
  grid.sort_cells(particles.x, particles.id);
  return grid.order();
}

template <int D>
double NeighborList<D>::least_cell_side() const {
  return reach() / k_cells_per_reach;
}

template <int D>
void NeighborList<D>::build(const Particles<D>& particles, double time) {
  grid_.bin(particles.x, particles.size(), least_cell_side());
  build(particles, time, grid_.side());
}

template <int D>
void NeighborList<D>::build(const Particles<D>& particles, double time, double cell_side) {
  const std::size_t n_all = particles.size();
  const std::size_t n = particles.n_owned;
  revision_ = particles.revision;
  built_ = true;
  time_ = time;
  grid_.bin_exactly(particles.x, n_all, cell_side);
  grid_.sort_cells(particles.x, particles.id);
  const auto& order = grid_.order();
  Paths<D> paths;
  for (std::size_t d = 0; d < D; ++d) {
    paths.from[d].resize(n_all);
    paths.way[d].resize(n_all);
    x_at_build_[d].assign(particles.x[d].begin(), particles.x[d].begin() + static_cast<std::ptrdiff_t>(n));
    u_at_build_[d].resize(n);
  }
  const auto count = static_cast<std::ptrdiff_t>(n_all);
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t row = 0; row < count; ++row) {
    const auto k = static_cast<std::size_t>(row), j = static_cast<std::size_t>(order[k]);
    const auto u = foreseen_velocity(particles, j);
    for (std::size_t d = 0; d < D; ++d) {
      paths.from[d][k] = particles.x[d][j];
      paths.way[d][k] = outlook_.ahead * u[d];
      if (j < n) u_at_build_[d][j] = u[d];
    }
  }

  start_.assign(n + 1, 0);
  std::size_t room = list_.capacity() / static_cast<std::size_t>(omp_get_max_threads());
  for (std::size_t needed = fill(particles, paths, room); needed > room;
       needed = fill(particles, paths, room))
    room = needed + needed / k_spare;
}

/// Nobody is taken for faster than the fastest foreseen: the search reaches as far.
template <int D>
std::array<double, D> NeighborList<D>::foreseen_velocity(const Particles<D>& particles, std::size_t i) const {
  std::array<double, D> u;
  double speed2 = 0.0;
  for (std::size_t d = 0; d < D; ++d) {
    u[d] = particles.u[d][i];
    speed2 += u[d] * u[d];
  }
  if (!std::isfinite(speed2)) return {};  // as at rest: the end of the step names the particle
  if (speed2 > outlook_.fastest * outlook_.fastest)
    for (double& component : u) component *= outlook_.fastest / std::sqrt(speed2);
  return u;
}

template <int D>
std::size_t NeighborList<D>::fill(const Particles<D>& particles, const Paths<D>& paths, std::size_t room) {
  const std::size_t n = particles.n_owned;
  const auto most_threads = static_cast<std::size_t>(omp_get_max_threads());
  const double near = kernel_radius_ + 2.0 * outlook_.stray, farthest = outlook_.ahead * outlook_.fastest;
  const std::int32_t* order = grid_.order().data();
  std::vector<std::size_t> filled(most_threads, 0), wanted(most_threads, 0), first(most_threads + 1, n);
  list_.resize(room * most_threads);
#pragma omp parallel
  {
    const auto thread = static_cast<std::size_t>(omp_get_thread_num());
    const auto threads = static_cast<std::size_t>(omp_get_num_threads());
    const std::size_t begin = n * thread / threads, end = n * (thread + 1) / threads;
    first[thread] = begin;
    std::int32_t* const share = list_.data() + thread * room;
    std::vector<std::int32_t> too_long;  // for rows that find no room: they are counted only
    std::size_t used = 0, most_candidates = 0;
    for (std::size_t i = begin; i < end; ++i) {
      std::array<double, D> x, way;
      double way2 = 0.0;
      for (std::size_t d = 0; d < D; ++d) {
        x[d] = particles.x[d][i];
        way[d] = outlook_.ahead * u_at_build_[d][i];
        way2 += way[d] * way[d];
      }
      const double radius = near + std::sqrt(way2) + farthest;
      std::size_t candidates = k_append_room;
      grid_.for_each_range(x, radius, [&](std::size_t b, std::size_t e) { candidates += e - b; });
      most_candidates = std::max(most_candidates, candidates);
      const bool fits = used + candidates <= room;
      if (!fits) too_long.resize(std::max(too_long.size(), candidates));
      std::int32_t* const row = fits ? share + used : too_long.data();
      std::size_t length = 0;
      grid_.for_each_range(x, radius, [&](std::size_t b, std::size_t e) {
        length +=
            append_within<D>(paths, order, x, way, near, static_cast<std::int32_t>(i), b, e, row + length);
      });
      start_[i + 1] = length;
      used += length;
    }
    filled[thread] = used;
    wanted[thread] = used + most_candidates;  // enough for every row, whatever comes before it
  }
  const std::size_t needed = *std::max_element(wanted.begin(), wanted.end());
  if (needed > room) return needed;
  for (std::size_t i = 0; i < n; ++i) start_[i + 1] += start_[i];
  for (std::size_t t = 1; t < most_threads; ++t)  // the shares join, each moving towards the beginning
    std::copy(list_.begin() + static_cast<std::ptrdiff_t>(t * room),
              list_.begin() + static_cast<std::ptrdiff_t>(t * room + filled[t]),
              list_.begin() + static_cast<std::ptrdiff_t>(start_[first[t]]));
  list_.resize(start_[n]);
  return needed;
}

template <int D>
void NeighborList<D>::drop_marked() {
  std::size_t kept = 0, begin = 0;
  for (std::size_t i = 0; i < n_rows(); ++i) {
    const std::size_t end = start_[i + 1];
    for (std::size_t pair = begin; pair < end; ++pair)
      if (list_[pair] != k_marked) list_[kept++] = list_[pair];
    start_[i + 1] = kept;
    begin = end;
  }
  list_.resize(kept);
}

template <int D>
bool NeighborList<D>::outdated(const Particles<D>& particles, double time, double ahead) const {
  if (!built_ || revision_ != particles.revision) return true;
  const auto n = static_cast<std::ptrdiff_t>(particles.n_owned);
  // of the way foreseen, which ends after outlook_.ahead
  const auto gone = [this](double t) { return std::clamp(t - time_, 0.0, outlook_.ahead); };
  const double until_now = gone(time), until_then = gone(time + ahead);
  double most = 0.0, moved = 0.0;
#pragma omp parallel for schedule(static) reduction(max : most, moved)
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    double now = 0.0, then = 0.0;
    for (std::size_t d = 0; d < D; ++d) {
      const double way = particles.x[d][k] - x_at_build_[d][k], u = u_at_build_[d][k],
                   strayed = way - until_now * u, straying = way + ahead * particles.u[d][k] - until_then * u;
      moved = std::max(moved, std::fabs(way));
      now += strayed * strayed;
      then += straying * straying;
    }
    most = std::max({most, now, then});
  }
  return moved != 0.0 && !(most <= outlook_.stray * outlook_.stray);
}

template class NeighborList<2>;
template class NeighborList<3>;

}  // namespace littoral::sph
