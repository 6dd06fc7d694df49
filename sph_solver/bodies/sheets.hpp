#pragma once

#include <vector>

#include "bodies/dummies.hpp"
#include "neighbors/neighbor_list.hpp"

namespace littoral::sph {

/// The sheets among the bodies (plates, wet on both sides). What one side of a sheet holds, the other does
/// not see: neither water through it, nor the dummies that stand for the sheet to the other side. For a
/// particle every place within its kernel is either in sight, or hidden behind a sheet and held by one of its
/// dummies.
template <int D>
class Sheets {
 public:
  explicit Sheets(const std::vector<Body>& bodies);
  bool none() const { return sheets_.empty(); }

  /// True if a sheet stands between two points.
  bool between(const std::vector<Body>& bodies, const DomainBox<D>& box, const std::array<double, D>& x,
               const std::array<double, D>& y) const;
  /// True if a point sees this dummy: always, if it is a solid's; a sheet's if the sheet hides the dummy's
  /// place from it, on the dummy's side, and no other sheet stands before it.
  bool shows(const std::vector<Body>& bodies, const Dummies<D>& dummies, std::size_t e,
             const std::array<double, D>& x) const;
  /// Takes the pairs with a sheet between them out of the rows. comm: local
  void part(const std::vector<Body>& bodies, const DomainBox<D>& box, const Particles<D>& particles,
            NeighborList<D>& neighbors) const;

 private:
  std::vector<std::size_t> sheets_;  // among the bodies
};

extern template class Sheets<2>;
extern template class Sheets<3>;

}  // namespace littoral::sph
