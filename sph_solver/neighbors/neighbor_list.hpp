#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "neighbors/append_within.hpp"
#include "neighbors/cell_grid.hpp"
#include "neighbors/outlook.hpp"
#include "particles/particles.hpp"

namespace littoral::sph {

/// Neighbours of every owned particle, itself excluded, as one compressed row per particle: all that come
/// within the kernel radius while particles stay on their paths (Outlook), or stray from these as far as
/// foreseen; pairs that are further apart see a kernel of zero. A row runs from cell to cell of a grid fixed
/// in space and by id in a cell: the same on any number of threads and ranks, as long as these use the same
/// cell side.
template <int D>
class NeighborList {
 public:
  /// Until set_outlook() particles may move by half of `skin` [m], whereto they will.
  NeighborList(double kernel_radius, double skin) : kernel_radius_(kernel_radius) {
    outlook_.stray = 0.5 * skin;
  }

  double kernel_radius() const { return kernel_radius_; }  ///< R [m]
  /// [m] within which copies must exist at build
  double reach() const { return kernel_radius_ + 2.0 * outlook_.way(); }
  void set_outlook(const Outlook& outlook) { outlook_ = outlook; }  ///< of the next build, alike on all ranks
  const Outlook& outlook() const { return outlook_; }

  /// Order that sorts the owned particles by cell, for Particles::permute, whatever the skin. Does not touch
  /// the lists.
  std::vector<std::int32_t> space_order(const Particles<D>& particles) const;
  /// From positions and velocities of owned particles and copies at `time` [s]. cell_side [m]: the least one
  /// or more, the same on all ranks; without: what suits the particles here
  void build(const Particles<D>& particles, double time = 0.0);
  void build(const Particles<D>& particles, double time, double cell_side);
  double least_cell_side() const;  ///< [m]
  /// True if particles were added, removed or have strayed further than foreseen since build(), or will have
  /// once they have gone on for `ahead` [s] at their velocity; not so while nobody has moved since.
  bool outdated(const Particles<D>& particles, double time = 0.0, double ahead = 0.0) const;

  /// Marks pairs to be taken out until the next build: of the rows i with concerns(i), those with parted(i,
  /// j). drop_marked() then takes out all that were marked; lists must not be used in between.
  template <class Concerns, class Parted>
  void mark_pairs(const Concerns& concerns, const Parted& parted) {
    const auto n = static_cast<std::ptrdiff_t>(n_rows());
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t k = 0; k < n; ++k) {
      const auto i = static_cast<std::size_t>(k);
      if (!concerns(i)) continue;
      for (std::size_t pair = start_[i]; pair < start_[i + 1]; ++pair)
        if (list_[pair] != k_marked && parted(i, static_cast<std::size_t>(list_[pair])))
          list_[pair] = k_marked;
    }
  }
  void drop_marked();

  /// Particles were added or removed since build().
  bool others_came(const Particles<D>& particles) const { return built_ && revision_ != particles.revision; }
  void forget() { built_ = false; }  ///< outdated() until the next build

  std::size_t n_rows() const { return start_.empty() ? 0 : start_.size() - 1; }
  std::size_t n_pairs() const { return list_.size(); }  ///< directed, those of the skin included
  const std::size_t* start() const { return start_.data(); }
  const std::int32_t* list() const { return list_.data(); }

  /// Calls f(j) for every particle j, owned or copy, that may lie within the kernel radius of any point x:
  /// the caller tests the distance. Valid while not outdated().
  template <class F>
  void for_each_near(const std::array<double, D>& x, const F& f) const {
    const auto& order = grid_.order();
    grid_.for_each_range(x, kernel_radius_ + outlook_.way(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) f(static_cast<std::size_t>(order[k]));
    });
  }

 private:
  std::array<double, D> foreseen_velocity(const Particles<D>& particles, std::size_t i) const;  // [m/s]
  /// Each thread fills the rows of a contiguous share of the particles into its part of list_, `room` long;
  /// then the shares are joined in order. Returns the room the longest share needs: more than `room`, and
  /// nothing is joined. paths: in the grid's order
  std::size_t fill(const Particles<D>& particles, const Paths<D>& paths, std::size_t room);
  static constexpr std::int32_t k_marked = -1;

  double kernel_radius_;
  Outlook outlook_;
  CellGrid<D> grid_;
  double time_ = 0.0;                                           // of the build [s]
  std::array<std::vector<double>, D> x_at_build_, u_at_build_;  // of the owned
  std::vector<std::size_t> start_;
  std::vector<std::int32_t> list_;
  std::uint64_t revision_ = 0;  // of the particles, at build
  bool built_ = false;
};

extern template class NeighborList<2>;
extern template class NeighborList<3>;

}  // namespace littoral::sph
