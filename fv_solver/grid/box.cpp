#include "grid/box.hpp"

#include "grid/metrics.hpp"
#include "grid/space.hpp"
#include "littoral/error.hpp"

namespace littoral::fv {
namespace {

const char* const k_axis_names[] = {"x", "y", "z"};
const char* const k_side_names[] = {"lower", "upper"};

}  // namespace

template <int D>
Block<D> build_block(const BlockConfig& config, const support::Scene& scene, const Neighbourhood& others) {
  Block<D> named;
  named.name = config.name;
  FaceConditions<D> conditions;
  std::array<int, D> cells;
  std::array<std::size_t, 3> direction_of{};
  std::array<std::vector<double>, D> nodes;
  for (std::size_t d = 0; d < D; ++d) {
    const std::size_t a = axis_in_space<D>(d);
    direction_of[a] = d;
    cells[d] = config.cells[a];
    if (!(config.lower[a] < config.upper[a]))
      throw ConfigError("block '" + config.name + "': upper is not above lower along " + k_axis_names[a]);
    nodes[d] = node_positions(config.stretching[a], cells[d], config.lower[a], config.upper[a],
                              "block '" + config.name + "', stretching." + k_axis_names[a]);
    conditions.scene_axis[d] = static_cast<int>(a);
    conditions.length[d] = config.upper[a] - config.lower[a];
    for (std::size_t side = 0; side < 2; ++side) {
      conditions.faces[d][side] = config.faces[2 * a + side];
      named.face_names[d][side] = std::string(k_axis_names[a]) + "_" + k_side_names[side];
    }
  }
  for (const PatchConfig& patch : config.patches) {
    const auto axis = static_cast<std::size_t>(patch.face / 2);
    if (D == 2 && axis == 1) continue;
    typename FaceConditions<D>::Patch p;
    p.direction = static_cast<int>(direction_of[axis]);
    p.side = patch.face % 2;
    for (std::size_t d = 0; d < D; ++d) {
      p.from[d] = patch.from[axis_in_space<D>(d)];
      p.to[d] = patch.to[axis_in_space<D>(d)];
    }
    p.condition = patch.condition;
    conditions.patches.push_back(p);
  }
  const std::array<bool, D> periodic = periodic_directions(named, conditions, scene, others);
  Block<D> block = make_block<D>(config.name, cells, periodic, [&](const std::array<int, D>& index) {
    std::array<double, 3> box = config.lower;
    for (std::size_t d = 0; d < D; ++d) {
      const std::size_t a = axis_in_space<D>(d);
      box[a] = nodes[d][static_cast<std::size_t>(index[d])];
    }
    std::array<double, D> x;
    for (std::size_t d = 0; d < D; ++d) {
      const std::size_t a = axis_in_space<D>(d);
      x[d] = config.mapping[a] ? (*config.mapping[a])(box[0], box[1], box[2], 0.0) : box[a];
    }
    return x;
  });
  block.face_names = named.face_names;
  add_windows(block, conditions, scene, others);
  return block;
}

template Block<2> build_block<2>(const BlockConfig&, const support::Scene&, const Neighbourhood&);
template Block<3> build_block<3>(const BlockConfig&, const support::Scene&, const Neighbourhood&);

}  // namespace littoral::fv
