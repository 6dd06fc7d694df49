#include "coupling/carve.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "grid/bounds.hpp"
#include "grid/loops.hpp"
#include "grid/metrics.hpp"
#include "grid/space.hpp"
#include "littoral/error.hpp"

namespace littoral::fv {
namespace {

constexpr std::array<const char*, 3> k_axis{"x", "y", "z"};

std::string text(double value) {
  char t[32];
  std::snprintf(t, sizeof t, "%.6g", value);
  return t;
}

constexpr double k_nothing = -1.0;  // layer of ghosts that stand for no cell

/// Distance inwards from the fringe's edge, in layers: 0 outside the region, 1 beside a computed cell, ...;
/// cells deeper than `deepest` keep deepest + 1. Ghosts behind joins and periodic faces as their cells.
template <int D>
std::vector<Field> layers(const std::vector<Block<D>>& blocks, const Exchange<D>& exchange,
                          const std::vector<std::vector<std::uint8_t>>& inside, int deepest) {
  std::vector<Field> layer;
  std::vector<std::vector<std::ptrdiff_t>> region(blocks.size());
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    layer.emplace_back(blocks[b].extent.size, k_nothing);
    for_each_index<D>({}, blocks[b].extent.n, [&](const std::array<int, D>& index) {
      const std::ptrdiff_t c = blocks[b].extent.at(index);
      const bool in = inside[b][static_cast<std::size_t>(c)] != 0;
      layer[b][static_cast<std::size_t>(c)] = in ? deepest + 1 : 0;
      if (in) region[b].push_back(c);
    });
  }
  exchange.scalar(blocks, layer, ScalarGhosts::cell_data);
  for (int depth = 1; depth <= deepest; ++depth) {
    for (std::size_t b = 0; b < blocks.size(); ++b)
      for (const std::ptrdiff_t c : region[b]) {
        if (layer[b][static_cast<std::size_t>(c)] <= depth) continue;
        const std::array<int, D> index = blocks[b].extent.index(c);
        std::array<int, D> lower, upper;
        for (std::size_t d = 0; d < D; ++d) {
          lower[d] = index[d] - 1;
          upper[d] = index[d] + 2;
        }
        bool beside = false;
        for_each_index<D>(lower, upper, [&](const std::array<int, D>& other) {
          beside = beside || layer[b][static_cast<std::size_t>(blocks[b].extent.at(other))] == depth - 1;
        });
        if (beside) layer[b][static_cast<std::size_t>(c)] = depth;
      }
    exchange.scalar(blocks, layer, ScalarGhosts::cell_data);
  }
  return layer;
}

/// The reconstruction beside the fringe reads two cells beyond the face: they must exist and be imposed.
template <int D>
void check_depth(const Block<D>& block, const Field& layer, int fringe_layers) {
  for_each_index<D>({}, block.extent.n, [&](const std::array<int, D>& index) {
    if (layer[static_cast<std::size_t>(block.extent.at(index))] != 0) return;
    for (std::size_t d = 0; d < D; ++d)
      for (const int step : {-1, 1})
        for (int k = 1; k <= fringe_layers; ++k) {
          std::array<int, D> other = index;
          other[d] += k * step;
          const bool in_block = other[d] >= 0 && other[d] < block.extent.n[d];
          // further beyond the block than its ghosts are deep, the next block sees it
          if (other[d] < -k_ghost || other[d] >= block.extent.n[d] + k_ghost) break;
          const double of = layer[static_cast<std::size_t>(block.extent.at(other))];
          const bool in_region = of > 0.0;
          if (k == 1 && !in_region) break;
          if (in_region) continue;
          const coupler::Vec3 x = centre_in_space(block, block.extent.at(index));
          throw ConfigError("coupling.fringe_layers: " + std::to_string(fringe_layers) +
                            " layers of cells are to be imposed inside the SPH region, but next to (" +
                            text(x[0]) + ", " + text(x[1]) + ", " + text(x[2]) + ") block '" + block.name +
                            "' has only " + std::to_string(k - 1) + " in direction " +
                            k_axis[axis_in_space<D>(d)] +
                            (in_block || of == 0.0 ? ": the region is too thin"
                                                   : ": let the block reach further into the region"));
        }
  });
}

/// The nodes' coordinate nearest to a nominal face, among those over the face's own extent.
template <int D>
double nearest_node(const std::vector<Block<D>>& blocks, const Ranks& ranks, std::size_t direction,
                    double face) {
  double best = std::numeric_limits<double>::infinity();
  for (const auto& block : blocks) {
    std::array<int, D> upper = block.extent.n;
    for (int& n : upper) ++n;
    for_each_index<D>({}, upper, [&](const std::array<int, D>& index) {
      const double x = block.node[direction][static_cast<std::size_t>(block.node_extent.at(index))];
      if (std::abs(x - face) < std::abs(best - face)) best = x;
    });
  }
  for (const double x : ranks.gather(std::vector<double>{best}))
    if (std::abs(x - face) < std::abs(best - face)) best = x;
  return best;
}

/// The box around all blocks of all ranks.
template <int D>
coupler::Box all_bounds(const std::vector<Block<D>>& blocks, const Ranks& ranks) {
  coupler::Box box = bounds(blocks);
  for (std::size_t a = 0; a < 3; ++a) {
    box.lower[a] = -ranks.largest(-box.lower[a]);
    box.upper[a] = ranks.largest(box.upper[a]);
  }
  return box;
}

template <int D>
void describe_faces(const std::vector<Block<D>>& blocks, const Ranks& ranks, const coupler::Box& grid,
                    const support::Scene& scene, Carving& carving) {
  for (const auto& region : scene.regions)
    for (std::size_t d = 0; d < D; ++d)
      for (std::size_t side = 0; side < 2; ++side) {
        const std::size_t a = axis_in_space<D>(d);
        if (!scene.open_face(region, a, side)) continue;
        const double face = side == 0 ? region.lower[a] : region.upper[a];
        const double off = face - nearest_node(blocks, ranks, d, face);
        if (std::abs(off) > 1e-6 * (grid.upper[a] - grid.lower[a]))
          carving.notes.push_back("the region's face " + std::string(k_axis[a]) + " = " + text(face) +
                                  " m lies " + text(std::abs(off)) + " m " + (off > 0.0 ? "above" : "below") +
                                  " the nearest cell faces; cells belong to the side of their centres");
      }
}

/// Length of the water along the strongest component of gravity, grid and particles together: the longest of
/// the lines through the regions' middles.
double column_depth(const coupler::Box& grid, const support::Scene& scene) {
  constexpr int k_points = 1000;  // along a line
  std::size_t a = 0;
  for (std::size_t d = 1; d < 3; ++d)
    if (std::abs(scene.gravity[d]) > std::abs(scene.gravity[a])) a = d;
  if (scene.gravity[a] == 0.0) return 0.0;
  double deepest = 0.0;
  for (const auto& region : scene.regions) {
    coupler::Vec3 x{};
    for (std::size_t d = 0; d < 3; ++d) x[d] = 0.5 * (region.lower[d] + region.upper[d]);
    const double lower = std::min(grid.lower[a], region.lower[a]);
    const double upper = std::max(grid.upper[a], region.upper[a]);
    int wet = 0;
    for (int i = 0; i < k_points; ++i) {
      x[a] = lower + (upper - lower) * (i + 0.5) / k_points;
      if (!scene.initial.surface || (*scene.initial.surface)(x[0], x[1], x[2], 0.0) < 0.0) ++wet;
    }
    deepest = std::max(deepest, (upper - lower) * wet / k_points);
  }
  return deepest;
}

}  // namespace

template <int D>
Carving carve(std::vector<Block<D>>& blocks, const Exchange<D>& exchange, const support::Scene& scene) {
  const Ranks& ranks = exchange.ranks();
  Carving carving;
  std::vector<std::uint8_t> met(scene.regions.size(), 0);
  std::vector<std::vector<std::uint8_t>> inside;
  for (const auto& block : blocks) {
    inside.emplace_back(block.extent.size, 0);
    for_each_index<D>({}, block.extent.n, [&](const std::array<int, D>& index) {
      const std::ptrdiff_t c = block.extent.at(index);
      const coupler::Vec3 x = centre_in_space(block, c);
      for (std::size_t r = 0; r < scene.regions.size(); ++r) {
        coupler::Box box{scene.regions[r].lower, scene.regions[r].upper};
        if (D == 2) {
          box.lower[1] = -1.0;
          box.upper[1] = 1.0;
        }
        if (!box.contains(x)) continue;
        inside.back()[static_cast<std::size_t>(c)] = 1;
        met[r] = 1;
      }
    });
  }
  const std::vector<Field> layer = layers<D>(blocks, exchange, inside, scene.coupling.fringe_layers);
  const bool imposed = scene.coupling.kind == support::Scene::CouplingKind::imposed;
  ranks.together<ConfigError>([&] {
    for (std::size_t b = 0; b < blocks.size() && imposed; ++b)
      check_depth<D>(blocks[b], layer[b], scene.coupling.fringe_layers);
  });
  std::array<double, 3> count{};  // fringe, blanked, forced
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    Block<D>& block = blocks[b];
    for_each_index<D>({}, block.extent.n, [&](const std::array<int, D>& index) {
      const auto c = static_cast<std::size_t>(block.extent.at(index));
      if (layer[b][c] == 0) return;
      if (!imposed) {
        block.status[c] = CellStatus::forced;
        ++count[2];
      } else if (layer[b][c] <= scene.coupling.fringe_layers) {
        block.status[c] = CellStatus::fringe;
        ++count[0];
      } else {
        block.status[c] = CellStatus::blanked;
        ++count[1];
      }
    });
    set_solved_mask(block);
  }
  ranks.sum(count);
  carving.n_fringe = static_cast<long>(count[0]);
  carving.n_blanked = static_cast<long>(count[1]);
  carving.n_forced = static_cast<long>(count[2]);
  const coupler::Box grid = all_bounds<D>(blocks, ranks);
  for (std::size_t r = 0; r < met.size(); ++r)
    if (!ranks.any(met[r] != 0))
      throw ConfigError("regions[" + std::to_string(r) + "] holds no cell of the grid, which reaches from (" +
                        text(grid.lower[0]) + ", " + text(grid.lower[1]) + ", " + text(grid.lower[2]) +
                        ") to (" + text(grid.upper[0]) + ", " + text(grid.upper[1]) + ", " +
                        text(grid.upper[2]) +
                        ") m: the grid must reach into the region by coupling.fringe_layers cells");
  describe_faces(blocks, ranks, grid, scene, carving);
  carving.column_depth = column_depth(grid, scene);
  return carving;
}

template Carving carve(std::vector<Block<2>>&, const Exchange<2>&, const support::Scene&);
template Carving carve(std::vector<Block<3>>&, const Exchange<3>&, const support::Scene&);

}  // namespace littoral::fv
