#pragma once

#include <array>
#include <vector>

#include "implicit/line_operator.hpp"

namespace littoral::fv {

/// Bilinear (trilinear) prolongation between two levels of one block and its adjoint, in index space, with
/// one-dimensional weights per direction that know of an odd last cell and of directions not coarsened.
/// Both read one ghost layer: the correction continued beyond walls with its mirror image, which makes the
/// restriction (ghosts of the residual filled by the same rule) the exact transpose of the prolongation.
template <int D>
class Transfer {
 public:
  Transfer(const LevelGrid<D>& fine, const LevelGrid<D>& coarse, const std::array<int, D>& ratio);

  /// Takes anew which cells are solved: after a change of status or surface.
  void set_solved(const LevelGrid<D>& fine, const LevelGrid<D>& coarse);

  /// coarse = P^T fine, 0 in coarse cells that are not solved; ghosts of `fine` filled
  template <class Real>
  void restrict_residual(const Correction<D, Real>& fine, Correction<D, Real>& coarse) const;

  /// fine += P coarse in solved cells; ghosts of `coarse` filled
  template <class Real>
  void add_prolonged(const Correction<D, Real>& coarse, Correction<D, Real>& fine) const;

 private:
  struct Fine {  // a fine cell takes (1 - w) of its parent and w of the parent's neighbour
    int parent = 0, neighbour = 0;
    double weight = 0.0;
  };
  struct Coarse {  // what a coarse cell collects
    int count = 0;
    std::array<int, 4> cell{};
    std::array<double, 4> weight{};
  };
  struct Row {  // one of the rows that a row of the other level is combined from
    std::ptrdiff_t offset;
    double weight;
  };
  static constexpr std::size_t k_most_rows = D == 2 ? 4 : 16;

  Extent<D> fine_, coarse_;
  std::array<std::vector<Fine>, D> down_;
  std::array<std::vector<Coarse>, D> up_;
  std::vector<std::uint8_t> fine_solved_, coarse_solved_;
};

/// First ghost layers: periodic images, and `mirror` of the inner cell at all other edges but links.
/// Directions in turn, so that corners are filled as well.
template <int D, class Real>
void fill_correction_ghosts(const LevelGrid<D>& grid, Correction<D, Real>& e);

}  // namespace littoral::fv
