#include "checks.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <set>

#include "boundary/links.hpp"
#include "grid/bounds.hpp"
#include "grid/loops.hpp"
#include "grid/space.hpp"
#include "littoral/error.hpp"
#include "overset/components.hpp"

namespace littoral::fv {
namespace {

template <int D>
std::string place(const Block<D>& block, const std::array<int, D>& index) {
  const coupler::Vec3 x = centre_in_space(block, block.extent.at(index));
  char text[160];
  std::snprintf(text, sizeof text, "(%.6g, %.6g, %.6g) m", x[0], x[1], x[2]);
  return "block '" + block.name + "', cell at " + text;
}

/// Ghosts behind a fringe face are set by nobody: no solved cell may read them.
template <int D>
void check_fringe_faces(const Block<D>& block) {
  for (const Window<D>& w : block.windows) {
    if (w.condition != Condition::fringe) continue;
    const auto d = static_cast<std::size_t>(w.direction);
    std::array<int, D> lower = w.lower, upper = w.upper;
    lower[d] = w.side == 0 ? 0 : block.extent.n[d] - 1;
    upper[d] = lower[d] + 1;
    for_each_index<D>(lower, upper, [&](const std::array<int, D>& index) {
      if (block.solved[static_cast<std::size_t>(block.extent.at(index))] == 0.0) return;
      throw ConfigError(
          place<D>(block, index) + ", face '" + w.name +
          "': the scene says this side is open, or the face is a fringe, but the cell is solved "
          "and nobody gives values beyond it. Give the face a condition (wall, slip, symmetry, "
          "inflow, outflow, far_field, state)");
    });
  }
}

/// One phase: a cell that the surface cuts, or that lies above it, would be computed as full of water.
template <int D>
void check_under_water(const Block<D>& block, const support::Formula& surface) {
  for_each_index<D>({}, block.extent.n, [&](const std::array<int, D>& index) {
    if (block.solved[static_cast<std::size_t>(block.extent.at(index))] == 0.0) return;
    double highest = -std::numeric_limits<double>::infinity(), largest = 0.0;  // of phi over the corners
    std::array<int, D> corners;
    corners.fill(2);
    for_each_index<D>({}, corners, [&](const std::array<int, D>& corner) {
      std::array<int, D> at = index;
      std::array<double, D> x;
      for (std::size_t d = 0; d < D; ++d) at[d] += corner[d];
      for (std::size_t d = 0; d < D; ++d)
        x[d] = block.node[d][static_cast<std::size_t>(block.node_extent.at(at))];
      const coupler::Vec3 s = vector_in_space<D>(x);
      const double phi = surface(s[0], s[1], s[2], 0.0);
      highest = std::max(highest, phi);
      largest = std::max(largest, std::abs(phi));
    });
    constexpr double k_round_off = 1e-6;  // of the cell's size: a surface along a row of faces is no cut
    if (highest <= k_round_off * largest) return;
    throw ConfigError(
        place<D>(block, index) +
        ": the scene's initial.surface passes through or below it, but fv_solver computes water "
        "only: end the grid below the surface, or give the surface to the particles "
        "(coupling.kind: imposed)");
  });
}

}  // namespace

/// Between components that meet, one must take values from the other.
template <int D>
void check_apart(const std::vector<Block<D>>& blocks) {
  const std::vector<std::size_t> group = components(blocks);
  std::set<std::size_t> receiving;  // components with interpolated cells
  for (std::size_t b = 0; b < blocks.size(); ++b)
    for (const CellStatus status : blocks[b].status)
      if (status == CellStatus::interpolated) receiving.insert(group[b]);
  for (std::size_t a = 0; a < blocks.size(); ++a)
    for (std::size_t b = a + 1; b < blocks.size(); ++b) {
      if (group[a] == group[b] || receiving.count(group[a]) != 0 || receiving.count(group[b]) != 0) continue;
      const coupler::Box one = bounds<D>({blocks[a]}), other = bounds<D>({blocks[b]});
      bool apart = false;
      for (std::size_t d = 0; d < D; ++d) {
        const std::size_t x = axis_in_space<D>(d);
        apart = apart || one.upper[x] < other.lower[x] || other.upper[x] < one.lower[x];
      }
      if (apart) continue;
      throw ConfigError(
          "blocks '" + blocks[a].name + "' and '" + blocks[b].name +
          "' meet or overlap, but nothing passes from one to the other: let their faces' nodes coincide "
          "(joins: auto), give the upper one faces with condition overset, or keep them apart");
    }
}

namespace {

/// A place in the part of the domain between two ends along an axis where there is water, but no particles.
std::optional<coupler::Vec3> water_between(const support::Scene& scene, std::size_t axis, double lower,
                                           double upper) {
  constexpr int k_points = 16;
  std::array<int, 3> n;
  for (std::size_t d = 0; d < 3; ++d) n[d] = scene.active(d) ? k_points : 1;
  std::optional<coupler::Vec3> found;
  for_each_index<3>({}, n, [&](const std::array<int, 3>& index) {
    if (found) return;
    coupler::Vec3 x{};
    for (std::size_t d = 0; d < 3; ++d) {
      if (!scene.active(d)) continue;
      const double from = d == axis ? lower : scene.domain.lower[d];
      const double to = d == axis ? upper : scene.domain.upper[d];
      x[d] = from + (index[d] + 0.5) / k_points * (to - from);
    }
    if (scene.initial.surface && !((*scene.initial.surface)(x[0], x[1], x[2], 0.0) < 0.0)) return;
    for (const support::Scene::Region& region : scene.regions) {
      bool inside = scene.has_region();
      for (std::size_t d = 0; d < 3; ++d)
        inside = inside && (!scene.active(d) || (x[d] >= region.lower[d] && x[d] <= region.upper[d]));
      if (inside) return;
    }
    found = x;
  });
  return found;
}

}  // namespace

template <int D>
std::vector<std::string> check_covered(const std::vector<Block<D>>& blocks, const support::Scene& scene) {
  // of the domain's extent: nodes come from files, too; a ring's polygon stays inside its circle
  const double tolerance = scene.has_region() ? 1e-6 : 1e-2;
  const coupler::Box grid = bounds<D>(blocks);
  std::vector<std::string> gaps;
  for (std::size_t a = 0; a < 3; ++a)
    for (int side = 0; side < 2; ++side) {
      if (!scene.active(a)) continue;
      const double end = side == 0 ? scene.domain.lower[a] : scene.domain.upper[a];
      const double reached = side == 0 ? grid.lower[a] : grid.upper[a];
      const double gap = side == 0 ? reached - end : end - reached;
      if (!(gap > tolerance * (scene.domain.upper[a] - scene.domain.lower[a]))) continue;
      const auto x = water_between(scene, a, std::min(end, reached), std::max(end, reached));
      if (!x) continue;
      char text[400];
      std::snprintf(
          text, sizeof text,
          "the domain %s at %c = %.6g m, the grid at %.6g m: nobody computes the water between, as at "
          "(%.6g, %.6g, %.6g) m; let the grid reach the domain's side, or the domain end with the grid",
          side == 0 ? "begins" : "ends", "xyz"[a], end, reached, (*x)[0], (*x)[1], (*x)[2]);
      gaps.emplace_back(text);
    }
  if (gaps.empty() || !scene.has_region()) return gaps;
  std::string problems;
  for (const std::string& gap : gaps) problems += (problems.empty() ? "" : "\n") + gap;
  throw ConfigError(problems);
}

template <int D>
void check_blocks(const std::vector<Block<D>>& blocks, const support::Scene& scene, bool level_set) {
  for (const Block<D>& block : blocks) {
    check_fringe_faces<D>(block);
    if (scene.initial.surface && !level_set) check_under_water<D>(block, *scene.initial.surface);
  }
}

template void check_apart<2>(const std::vector<Block<2>>&);
template void check_apart<3>(const std::vector<Block<3>>&);
template std::vector<std::string> check_covered<2>(const std::vector<Block<2>>&, const support::Scene&);
template std::vector<std::string> check_covered<3>(const std::vector<Block<3>>&, const support::Scene&);
template void check_blocks<2>(const std::vector<Block<2>>&, const support::Scene&, bool);
template void check_blocks<3>(const std::vector<Block<3>>&, const support::Scene&, bool);

}  // namespace littoral::fv
