#pragma once

#include <array>
#include <vector>

#include "level_set/band.hpp"

namespace littoral::fv {

/// A piece of the surface: the osculating quadric at a base point y,
///   x = y + s + n (-1/2 s.S s),  s tangential,
/// seen from the cell that holds it.
template <int D>
struct SurfacePatch {
  std::array<double, D> to_base{};           // [m] y - centre of the cell
  std::array<double, D> normal{};            // [-] n, out of the water
  std::array<std::array<double, D>, D> S{};  // [1/m] curvature: n changes by S s along s
};

/// Foot of a point on a patch.
template <int D>
struct Foot {
  double distance = 0.0;           // [m] signed: < 0 on the water's side
  std::array<double, D> to{};      // [m] foot - point
  std::array<double, D> normal{};  // [-] there
};

/// Closest point of the patch to the cell's centre moved by `shift`. Two Newton steps: error of third order
/// in the distance between foot and base. pure
template <int D>
Foot<D> closest_point(const SurfacePatch<D>& patch, const std::array<double, D>& shift = {});

/// For each cell of a band the patch of the surface nearest to it. Cells of layer 0 build theirs from the
/// second-order Taylor polynomial of phi around them; the others take, layer by layer, the neighbour's patch
/// whose foot is closest. Cells whose phi comes from elsewhere (interpolated, fringe) build one from phi
/// themselves, whatever their layer.
template <int D>
class SurfacePatches {
 public:
  /// pre phi has its ghosts; comm exchange of a patch's numbers, once a layer
  void build(const std::vector<Block<D>>& blocks, const Exchange<D>& exchange, const Band<D>& band,
             const std::vector<Field>& phi);
  /// Patch of a cell of the band; ghosts behind joins and periodic faces included. has: false outside
  bool has(std::size_t block, std::size_t cell) const { return known_[block][cell] != 0.0; }
  SurfacePatch<D> at(std::size_t block, std::size_t cell) const;

 private:
  static constexpr std::size_t k_curvatures = D * (D + 1) / 2;
  static constexpr std::size_t k_numbers = 2 * D + k_curvatures;
  void put(std::size_t block, std::size_t cell, const SurfacePatch<D>& patch);

  std::vector<std::array<Field, k_numbers>> numbers_;  // [block][number][cell]
  std::vector<Field> known_;                           // [block] 1 where a cell has a patch
};

}  // namespace littoral::fv
