#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "grid/small_matrix.hpp"
#include "level_set/band.hpp"

namespace littoral::fv {

/// A piece of the surface seen from a cell: the osculating quadric at a base point y,
///   x = y + s - n (s.S s)/2,  s tangential.
template <int D>
struct SurfacePatch {
  SpaceVector<D> to_base{};  // [m] y - centre of the cell
  SpaceVector<D> normal{};   // [-] n at y, out of the water
  SpaceMatrix<D> S{};        // [1/m] curvature: n changes by S s along s
};

/// Foot of a cell's centre on a patch.
template <int D>
struct Foot {
  double distance = 0.0;    // [m] signed: < 0 on the water's side
  SpaceVector<D> to{};      // [m] foot - centre
  SpaceVector<D> normal{};  // [-] n there
};

/// Closest point of the patch within `reach` [m] of its base, along the surface: an error of third order in
/// that distance. pure
template <int D>
Foot<D> closest_point(const SurfacePatch<D>& patch, double reach);

/// The patch that a cell at the surface sees in phi itself: of the second-order Taylor polynomial around it,
/// or around the next inner cell beside a wall, whose ghosts are only linear; where a film is thinner than
/// that sees, the nearest crossing on a grid line. false: none within two diagonals of the cell. pre ghosts
/// of phi current
template <int D>
bool own_patch(const Block<D>& block, const Band<D>& band, const Field& phi, std::size_t b, std::ptrdiff_t c,
               SurfacePatch<D>& patch);

/// For each cell of a band the patch of the surface nearest to it. Cells of layer 0 have their
/// own; the others take, layer by layer, of their neighbours' patches the one with the nearest base.
template <int D>
class SurfacePatches {
 public:
  /// pre phi has its ghosts; comm exchange of a patch's numbers, once a layer
  void build(const std::vector<Block<D>>& blocks, const Exchange<D>& exchange, const Band<D>& band,
             const std::vector<Field>& phi);
  /// Whether a cell has one: every cell of the band that is connected with layer 0; also ghosts that stand
  /// for cells.
  bool has(std::size_t block, std::ptrdiff_t cell) const {
    return known_[block][static_cast<std::size_t>(cell)] != 0.0;
  }
  SurfacePatch<D> at(std::size_t block, std::ptrdiff_t cell) const;
  /// The neighbour from which a cell beyond layer 0 has its patch.
  std::ptrdiff_t source(const Block<D>& block, std::size_t b, std::ptrdiff_t cell) const {
    int code = source_[b][static_cast<std::size_t>(cell)];
    std::ptrdiff_t at = cell;
    for (std::size_t d = 0; d < D; ++d, code /= 3) at += (code % 3 - 1) * block.extent.stride[d];
    return at;
  }
  /// Foot of the i-th cell of band.cells(block) on its patch, as far along the surface as the cell is wide;
  /// of length 0 where the cell has none.
  const Foot<D>& foot(std::size_t block, std::ptrdiff_t i) const {
    return feet_[block][static_cast<std::size_t>(i)];
  }

 private:
  static constexpr std::size_t k_curvatures = D * (D + 1) / 2;
  static constexpr std::size_t k_numbers = 2 * D + k_curvatures;
  void put(std::size_t block, std::ptrdiff_t cell, const SurfacePatch<D>& patch);
  void exchange_all(const std::vector<Block<D>>& blocks, const Exchange<D>& exchange);

  std::vector<std::array<Field, k_numbers>> numbers_;  // [block][number][cell]
  std::vector<Field> known_;                           // [block] 1 where a cell has a patch
  std::vector<std::vector<Foot<D>>> feet_;             // [block] in the order of band.cells(block)
  std::vector<std::vector<std::uint8_t>> source_;      // [block] sum_d 3^d (step to the source + 1)
};

}  // namespace littoral::fv
