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
  /// The same after one sweep in order from e = 0, with nothing linked to other blocks: the lines solved last
  /// have no residual, those before only what the later ones changed. For two colours.
  void residual_after_sweep(const Correction<D, Real>& e, Correction<D, Real>& r) const;

  /// Solves the lines of one colour exactly, neighbours frozen. from_zero: all of e is still 0
  void smooth(int colour, const Correction<D, Real>& b, Correction<D, Real>& e, bool from_zero = false) const;

 private:
  static constexpr int k_cross = 2 * (D - 1);  // neighbours across the lines
  using Matrix = SmallMatrix<D, Lanes<Real>>;
  using Wide = SmallMatrix<D, Lanes<double>>;
  struct Column {
    Lanes<Real> x[N];
  };
  /// What a forward elimination reads of one cell, together.
  struct Forward {
    Matrix cross[k_cross], lower, inverse;
  };
  struct Line;  // while building

  /// Coarse levels are too small to wake threads for.
  bool worth_threads(std::size_t bundles) const {
    return bundles * static_cast<std::size_t>(layout_.length) * k_lanes > 4000;
  }
  std::size_t slot(std::size_t bundle, int k) const {
    return bundle * static_cast<std::size_t>(layout_.length) + static_cast<std::size_t>(k);
  }
  template <LanePattern S>
  void build_bundle(const LevelGrid<D>& grid, const State<D>& state, const CorrectionPhysics<D>& physics,
                    double anchor, std::size_t bundle, Line& line);
  void eliminate(std::size_t bundle, int k, Line& line);
  void close(std::size_t bundle, Line& line);
  template <LanePattern S>
  void residual_bundle(std::size_t bundle, const Correction<D, Real>& b, const Correction<D, Real>& e,
                       Correction<D, Real>& r) const;
  template <LanePattern S>
  void cross_residual_bundle(std::size_t bundle, const Correction<D, Real>& e, Correction<D, Real>& r) const;
  template <LanePattern S, bool FromZero>
  void smooth_bundle(std::size_t bundle, const Correction<D, Real>& b, Correction<D, Real>& e,
                     Column* y) const;

  LineLayout layout_;
  std::array<std::ptrdiff_t, k_cross> cross_shift_{};  // to the neighbours across
  std::vector<Forward> forward_;                       // (bundles * length)
  std::vector<Matrix> back_;                           // inverse times upper block
  std::vector<Matrix> diagonal_, upper_;               // for residuals
  std::vector<Matrix> closing_;                        // cyclic lines: response to the last cell
};

}  // namespace littoral::fv
