#pragma once

#include <array>
#include <vector>

#include "implicit/face_jacobian.hpp"
#include "implicit/line_layout.hpp"

namespace littoral::fv {

/// A correction or a residual: pressure and velocity components, each with the layout of a cell array.
template <int D, class Real>
struct Correction {
  std::array<std::vector<Real>, D + 1> q;
  void assign_zero(std::size_t n) {
    for (auto& field : q) field.assign(n, Real(0));
  }
};

/// First-order Jacobian of one block on one level: a (D+1)x(D+1) block for the cell and each of its 2D
/// neighbours, kept bundle by bundle along the lines so that a bundle's lines are solved in vector lanes.
/// Boundary conditions are folded into the cell's own block; cells that are not solved have the identity.
template <int D, class Real>
class LineOperator {
 public:
  static constexpr int N = D + 1;

  LineOperator(const LevelGrid<D>& grid, int direction) : layout_(line_layout(grid, direction)) {}
  const LineLayout& layout() const { return layout_; }

  /// Blocks from the frozen state (link ghosts current), and their factorisation along the lines.
  /// anchor: relative addition to the pressure's own entry, for a closed incompressible box whose pressure
  /// level is free (0 elsewhere).
  void build(const LevelGrid<D>& grid, const State<D>& state, const CorrectionPhysics<D>& physics,
             double anchor = 0.0);

  /// r = b - A e on the interior; link ghosts of e current
  void residual(const Correction<D, Real>& b, const Correction<D, Real>& e, Correction<D, Real>& r) const;

  /// Solves the lines of one colour exactly, neighbours frozen.
  void smooth(int colour, const Correction<D, Real>& b, Correction<D, Real>& e) const;

 private:
  static constexpr int k_blocks = 1 + 2 * D;  // cell, then lower and upper neighbour of each direction
  using Lanes = std::array<Real, k_lanes>;
  using Block = std::array<std::array<Lanes, N>, N>;
  using Column = std::array<Lanes, N>;

  /// Coarse levels are too small to wake threads for.
  bool worth_threads(std::size_t bundles) const {
    return bundles * static_cast<std::size_t>(layout_.length) * k_lanes > 4000;
  }
  std::size_t slot(std::size_t bundle, int k) const {
    return bundle * static_cast<std::size_t>(layout_.length) + static_cast<std::size_t>(k);
  }
  void assemble_cell(const LevelGrid<D>& grid, const State<D>& state, const CorrectionPhysics<D>& physics,
                     double anchor, const std::array<int, D>& index,
                     std::array<SmallMatrix<D>, k_blocks>& blocks) const;
  void factorise(std::size_t bundle, const std::vector<std::array<SmallMatrix<D>, k_blocks>>& blocks,
                 int lane);

  LineLayout layout_;
  std::array<std::ptrdiff_t, D> stride_{};
  std::vector<std::array<Block, k_blocks>> blocks_;  // (bundles * length)
  std::vector<Block> inverse_;                       // of the diagonal after elimination along the line
  std::vector<Block> closing_;                       // cyclic lines: response to the last cell
};

}  // namespace littoral::fv
