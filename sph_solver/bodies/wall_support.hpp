#pragma once

#include "bodies/wall_list.hpp"
#include "neighbors/neighbor_list.hpp"
#include "physics/symmetric_matrix.hpp"

namespace littoral::sph {

/// What walls add to the supports of the particles next to them, for the detection of the surface and for the
/// shifting: a wall is no void. Above the water a wall is dry, and its dummies must not stand in for water:
/// with a free surface a dummy counts for a particle if water, or another body, is where its mirror image
/// about the wall is.
template <int D>
class WallSupport {
 public:
  void find(const Particles<D>& particles, const NeighborList<D>& neighbors, const std::vector<Body>& bodies,
            const DomainBox<D>& box, const Dummies<D>& dummies, const WallList<D>& list, double spacing,
            bool free_surface);

  /// sum_w V_w grad W_iw x_iw^T, what the walls add to B (S9).
  SymmetricMatrix<D> renormalisation(std::size_t i) const;
  /// sum_w V_w grad W_iw [1/m]: it points from the particle to the wall.
  std::array<double, D> crowding(std::size_t i) const;
  /// True if a wet dummy stands in the 45 degree cone about n, R high.
  bool something_above(const std::array<double, D>& n, std::size_t i) const;
  /// Takes away what would move the particle into a wall nearer than half a spacing.
  void keep_off(std::size_t i, std::array<double, D>& shift) const;

 private:
  const WallList<D>* list_ = nullptr;
  double R_ = 0.0;
  std::vector<SymmetricMatrix<D>> B_;              // (n_rows)
  std::vector<std::array<double, D>> crowding_;    // (n_rows)
  std::vector<std::array<double, D>> normal_;      // (n_rows) of the closest wall
  std::vector<char> close_;                        // (n_rows) nearer than half a spacing
  std::vector<char> wet_;                          // (n_pairs)
  std::vector<std::array<double, D>> separation_;  // (n_pairs)
};

extern template class WallSupport<2>;
extern template class WallSupport<3>;

}  // namespace littoral::sph
