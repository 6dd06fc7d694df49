#pragma once

#include <cstdint>
#include <vector>

#include "bodies/dummies.hpp"
#include "bodies/sheets.hpp"
#include "neighbors/cell_grid.hpp"
#include "particles/particles.hpp"

namespace littoral::sph {

/// The particles that see a wall, and for each of these rows the dummies within reach that it sees, grouped
/// by body.
template <int D>
class WallList {
 public:
  void build(const Particles<D>& particles, const Dummies<D>& dummies, const std::vector<Body>& bodies,
             const Sheets<D>& sheets, double reach);

  std::size_t n_rows() const { return particle_.size(); }
  std::size_t particle(std::size_t row) const { return static_cast<std::size_t>(particle_[row]); }
  std::size_t begin(std::size_t row) const { return start_[row]; }
  std::size_t end(std::size_t row) const { return start_[row + 1]; }
  std::size_t dummy(std::size_t k) const { return static_cast<std::size_t>(list_[k]); }
  std::size_t n_pairs() const { return list_.size(); }
  /// Row of an owned particle, -1: it sees none.
  std::int32_t row_of(std::size_t particle) const { return row_of_[particle]; }

  const std::vector<std::int32_t>& rows_of() const { return row_of_; }

  /// Calls f(dummy) for every dummy that may lie within `radius` of x, where the bodies were at build().
  template <class F>
  void for_each_near(const std::array<double, D>& x, double radius, const F& f) const {
    grid_.for_each_range(x, radius, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) f(static_cast<std::size_t>(grid_.order()[k]));
    });
  }

 private:
  CellGrid<D> grid_;
  std::vector<std::int32_t> particle_, row_of_, list_;
  std::vector<std::size_t> start_;
};

/// Acceleration that the water of each row gets besides pressure and friction, f [m/s^2] (n_rows): gravity
/// and `body_force`. Water at rest with a wall has grad p = rho (f - a_w).
template <int D>
using RowAccelerations = std::vector<std::array<double, D>>;

extern template class WallList<2>;
extern template class WallList<3>;

}  // namespace littoral::sph
