#include "grid/grid_file.hpp"

#include <algorithm>
#include <cmath>

#include "grid/loops.hpp"
#include "grid/metrics.hpp"
#include "grid/plot3d.hpp"
#include "grid/space.hpp"
#include "littoral/error.hpp"

namespace littoral::fv {
namespace {

/// Nodes of a file's block with two or three directions, in the order of the grid's own.
template <int D>
struct Nodes {
  std::array<int, D> n{};                // nodes
  std::array<std::vector<double>, D> x;  // [m] direction 0 fastest
  std::array<int, 3> direction{};        // [file's direction] here; -1: dropped
  bool reversed = false;                 // direction 0
  std::size_t at(const std::array<int, D>& i) const {
    std::size_t offset = 0, stride = 1;
    for (std::size_t d = 0; d < D; ++d) {
      const int index = d == 0 && reversed ? n[d] - 1 - i[d] : i[d];
      offset += static_cast<std::size_t>(index) * stride;
      stride *= static_cast<std::size_t>(n[d]);
    }
    return offset;
  }
};

/// The file's coordinate that does not vary over the first plane of a direction; -1: none.
int constant_coordinate(const Plot3dBlock& block, const std::vector<std::size_t>& nodes) {
  double largest = 0.0;
  std::array<double, 3> range{};
  for (std::size_t k = 0; k < 3; ++k) {
    double low = block.x[k][nodes.front()], high = low;
    for (const std::size_t i : nodes) {
      low = std::min(low, block.x[k][i]);
      high = std::max(high, block.x[k][i]);
    }
    range[k] = high - low;
    largest = std::max(largest, range[k]);
  }
  constexpr double k_round_off = 1e-6;  // single precision
  for (std::size_t k = 3; k-- > 0;)
    if (range[k] <= k_round_off * largest) return static_cast<int>(k);
  return -1;
}

/// The plane of a block that has one direction of one node or one cell: all its other nodes are images of it.
Nodes<2> planar_nodes(const Plot3dBlock& block, bool planar_file, double scale, const std::string& where) {
  Nodes<2> nodes;
  int thin = planar_file ? 2 : -1;
  for (int limit = 1; limit <= 2 && thin < 0; ++limit)
    for (int d = 2; d >= 0 && thin < 0; --d)
      if (block.n[static_cast<std::size_t>(d)] == limit) thin = d;
  if (thin < 0)
    throw ConfigError(where + ": the scene is planar, but the block has " + std::to_string(block.n[0]) +
                      " x " + std::to_string(block.n[1]) + " x " + std::to_string(block.n[2]) +
                      " nodes; a plane has one node, or one cell, in one direction");
  std::vector<std::size_t> plane;
  for (int k = 0; k < block.n[2]; ++k)
    for (int j = 0; j < block.n[1]; ++j)
      for (int i = 0; i < block.n[0]; ++i) {
        const std::array<int, 3> index = {i, j, k};
        if (index[static_cast<std::size_t>(thin)] == 0)
          plane.push_back((static_cast<std::size_t>(k) * static_cast<std::size_t>(block.n[1]) +
                           static_cast<std::size_t>(j)) *
                              static_cast<std::size_t>(block.n[0]) +
                          static_cast<std::size_t>(i));
      }
  std::array<std::size_t, 2> coordinate = {0, 1};
  if (!planar_file) {
    const int fixed = constant_coordinate(block, plane);
    if (fixed < 0) throw ConfigError(where + ": its nodes do not lie in a plane x, y or z = const");
    if (fixed == 1) coordinate = {0, 2};
    if (fixed == 0) coordinate = {1, 2};
  }
  for (std::size_t d = 0, here = 0; d < 3; ++d) {
    nodes.direction[d] = static_cast<int>(d) == thin ? -1 : static_cast<int>(here);
    if (static_cast<int>(d) != thin) nodes.n[here++] = block.n[d];
  }
  for (std::size_t k = 0; k < 2; ++k)
    for (const std::size_t i : plane) nodes.x[k].push_back(scale * block.x[coordinate[k]][i]);
  return nodes;
}

Nodes<2> nodes_of(const Plot3dBlock& block, bool planar_file, const GridFileConfig& config,
                  const std::string& where, std::integral_constant<int, 2>) {
  return planar_nodes(block, planar_file, config.scale, where);
}
Nodes<3> nodes_of(const Plot3dBlock& block, bool planar_file, const GridFileConfig& config,
                  const std::string& where, std::integral_constant<int, 3>) {
  Nodes<3> nodes;
  nodes.direction = {0, 1, 2};
  if (!planar_file && *std::min_element(block.n.begin(), block.n.end()) > 1) {
    nodes.n = block.n;
    for (std::size_t k = 0; k < 3; ++k)
      for (const double x : block.x[k]) nodes.x[k].push_back(config.scale * x);
    return nodes;
  }
  const Nodes<2> plane = planar_nodes(block, planar_file, config.scale, where);
  if (!(config.span.lower < config.span.upper))
    throw ConfigError(where +
                      ": it is planar and the scene is not: it needs a span whose upper end is above the "
                      "lower one");
  nodes.n = {plane.n[0], plane.n[1], config.span.cells + 1};
  nodes.direction = plane.direction;
  for (int& d : nodes.direction)
    if (d < 0) d = 2;
  for (int j = 0; j <= config.span.cells; ++j)
    for (std::size_t i = 0; i < plane.x[0].size(); ++i) {
      nodes.x[0].push_back(plane.x[0][i]);
      nodes.x[1].push_back(config.span.lower +
                           (config.span.upper - config.span.lower) * j / config.span.cells);
      nodes.x[2].push_back(plane.x[1][i]);
    }
  return nodes;
}

/// Sum of the cells' volumes by the parallelepiped at each lower corner: its sign is the block's handedness.
template <int D>
double handedness(const Nodes<D>& nodes) {
  double sum = 0.0;
  std::array<int, D> upper = nodes.n;
  for (int& n : upper) --n;
  for_each_index<D>({}, upper, [&](const std::array<int, D>& index) {
    std::array<std::array<double, D>, D> e;
    for (std::size_t d = 0; d < D; ++d) {
      std::array<int, D> next = index;
      ++next[d];
      for (std::size_t k = 0; k < D; ++k) e[d][k] = nodes.x[k][nodes.at(next)] - nodes.x[k][nodes.at(index)];
    }
    if constexpr (D == 2)
      sum += e[0][0] * e[1][1] - e[0][1] * e[1][0];
    else
      sum += e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) +
             e[0][1] * (e[1][2] * e[2][0] - e[1][0] * e[2][2]) +
             e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
  });
  return sum;
}

/// The conditions of one block, in its own directions.
template <int D>
FaceConditions<D> conditions_of(const GridFileConfig& config, int number, const Nodes<D>& nodes,
                                bool extruded) {
  FaceConditions<D> conditions;
  if (extruded) {
    conditions.faces[D - 1] = config.span.faces;
    conditions.scene_axis[D - 1] = 1;
    conditions.length[D - 1] = config.span.upper - config.span.lower;
  }
  for (const auto& face : config.faces) {
    if (face.block != number) continue;
    const int direction = nodes.direction[static_cast<std::size_t>(face.face / 2)];
    if (direction < 0) continue;  // the dropped direction of a plane
    typename FaceConditions<D>::Patch p;
    p.direction = direction;
    p.side = face.face % 2;
    for (std::size_t f = 0; f < 3; ++f) {
      if (nodes.direction[f] < 0) continue;
      const auto d = static_cast<std::size_t>(nodes.direction[f]);
      p.from[d] = face.from[f];
      p.to[d] = face.to[f] < 0 ? nodes.n[d] - 1 : face.to[f];
    }
    if (nodes.reversed) {
      const int last = nodes.n[0] - 1;
      if (direction == 0) p.side = 1 - p.side;
      p.from[0] = last - p.from[0];
      p.to[0] = last - p.to[0];
      std::swap(p.from[0], p.to[0]);
    }
    p.condition = face.condition;
    bool whole = true;
    for (std::size_t d = 0; d < D; ++d)
      whole = whole && (static_cast<int>(d) == direction || (p.from[d] == 0 && p.to[d] == nodes.n[d] - 1));
    if (whole)
      conditions.faces[static_cast<std::size_t>(direction)][static_cast<std::size_t>(p.side)] = p.condition;
    else
      conditions.patches.push_back(p);
  }
  return conditions;
}

}  // namespace

template <int D>
std::vector<Block<D>> build_grid_file(const GridFileConfig& config, const support::Scene& scene,
                                      const Neighbourhood& others, std::vector<std::string>& notes) {
  const Plot3dFile file = read_plot3d(config.file);
  notes.push_back(config.file + ": " + describe(file));
  const int n_blocks = static_cast<int>(file.blocks.size());
  for (const auto& face : config.faces)
    if (face.block > n_blocks)
      throw ConfigError("grid file " + config.file + ": a face is given for block " +
                        std::to_string(face.block) + ", but there are " + std::to_string(n_blocks));
  if (std::any_of(file.blocks.begin(), file.blocks.end(), [](const Plot3dBlock& b) {
        return std::find(b.iblank.begin(), b.iblank.end(), 0) != b.iblank.end();
      }))
    notes.push_back(config.file + ": iblank is not used: blanked nodes are part of the grid");
  std::vector<Block<D>> blocks;
  for (int b = 0; b < n_blocks; ++b) {
    const Plot3dBlock& source = file.blocks[static_cast<std::size_t>(b)];
    Block<D> named;
    named.name = n_blocks == 1 ? config.name : config.name + std::to_string(b + 1);
    const std::string where = "block '" + named.name + "' of " + config.file;
    Nodes<D> nodes = nodes_of(source, file.dialect.planar, config, where, std::integral_constant<int, D>());
    if (handedness(nodes) < 0.0) {
      nodes.reversed = true;
      notes.push_back(where + " is left-handed: its direction i is reversed, its faces keep their names");
    }
    const bool extruded =
        D == 3 && (file.dialect.planar || *std::min_element(source.n.begin(), source.n.end()) == 1);
    for (std::size_t f = 0; f < 3; ++f) {
      if (nodes.direction[f] < 0) continue;
      const auto d = static_cast<std::size_t>(nodes.direction[f]);
      const bool swapped = d == 0 && nodes.reversed;
      named.face_names[d][swapped ? 1 : 0] = std::string(1, "ijk"[f]) + "_lower";
      named.face_names[d][swapped ? 0 : 1] = std::string(1, "ijk"[f]) + "_upper";
    }
    if (extruded) named.face_names[D - 1] = {"span_lower", "span_upper"};
    const FaceConditions<D> conditions = conditions_of<D>(config, b + 1, nodes, extruded);
    const std::array<bool, D> periodic = periodic_directions(named, conditions, scene, others);
    std::array<int, D> cells = nodes.n;
    for (int& n : cells) --n;
    Block<D> block = make_block<D>(named.name, cells, periodic, [&](const std::array<int, D>& index) {
      std::array<double, D> x;
      for (std::size_t k = 0; k < D; ++k) x[k] = nodes.x[k][nodes.at(index)];
      return x;
    });
    block.face_names = named.face_names;
    add_windows(block, conditions, scene, others);
    blocks.push_back(std::move(block));
  }
  return blocks;
}

template <int D>
void write_grid(const std::string& path, const std::vector<Block<D>>& blocks) {
  Plot3dFile file;
  const auto ends = [&](const std::string& with) {
    return path.size() >= with.size() && path.compare(path.size() - with.size(), with.size(), with) == 0;
  };
  file.dialect.formatted = ends(".fmt") || ends(".txt");
  file.dialect.planar = D == 2;
  for (const Block<D>& block : blocks) {
    Plot3dBlock out;
    for (std::size_t d = 0; d < D; ++d) out.n[d] = block.extent.n[d] + 1;
    for_each_index<D>({}, block.node_extent.n, [&](const std::array<int, D>& index) {
      const auto n = static_cast<std::size_t>(block.node_extent.at(index));
      for (std::size_t k = 0; k < D; ++k) out.x[k].push_back(block.node[k][n]);
    });
    file.blocks.push_back(std::move(out));
  }
  write_plot3d(path, file);
}

template std::vector<Block<2>> build_grid_file<2>(const GridFileConfig&, const support::Scene&,
                                                  const Neighbourhood&, std::vector<std::string>&);
template std::vector<Block<3>> build_grid_file<3>(const GridFileConfig&, const support::Scene&,
                                                  const Neighbourhood&, std::vector<std::string>&);
template void write_grid<2>(const std::string&, const std::vector<Block<2>>&);
template void write_grid<3>(const std::string&, const std::vector<Block<3>>&);

}  // namespace littoral::fv
