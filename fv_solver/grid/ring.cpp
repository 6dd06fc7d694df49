#include "grid/ring.hpp"

#include <cmath>

#include "grid/metrics.hpp"
#include "grid/space.hpp"
#include "grid/stretching.hpp"
#include "littoral/error.hpp"

namespace littoral::fv {

template <int D>
Block<D> build_ring(const RingConfig& config, const support::Scene& scene, const Neighbourhood& others) {
  const std::string where = "ring '" + config.name + "'";
  const double outer = config.outer_radius ? *config.outer_radius : config.radius + *config.thickness;
  Stretching outward;
  static_cast<Spacing&>(outward) = config.spacing;
  const std::vector<double> radii =
      node_positions(outward, config.outward, config.radius, outer, where + ", spacing");

  Block<D> named;
  named.name = config.name;
  named.face_names[1] = {"inner", "outer"};
  FaceConditions<D> conditions;
  for (auto& face : conditions.faces[0]) face.condition = static_cast<int>(Condition::periodic);
  conditions.faces[1] = config.faces;
  std::array<int, D> cells;
  cells[0] = config.around;
  cells[1] = config.outward;
  if constexpr (D == 3) {
    if (!(config.span.lower < config.span.upper))
      throw ConfigError(where + ": in 3-D it needs a span whose upper end is above the lower one");
    cells[2] = config.span.cells;
    conditions.faces[2] = config.span.faces;
    conditions.scene_axis[2] = 1;
    conditions.length[2] = config.span.upper - config.span.lower;
    named.face_names[2] = {"span_lower", "span_upper"};
  }
  for (const RingConfig::Patch& patch : config.patches) {
    typename FaceConditions<D>::Patch p;
    p.direction = 1;
    p.side = patch.face;
    for (std::size_t d = 0; d < D; ++d) {
      p.from[d] = patch.from[d];
      p.to[d] = patch.to[d];
    }
    p.condition = patch.condition;
    conditions.patches.push_back(p);
  }
  const std::array<bool, D> periodic = periodic_directions(named, conditions, scene, others);
  // right-handed (around, outward[, span along y]): clockwise in the plane (x, z), counter-clockwise in space
  const double sense = D == 2 ? -1.0 : 1.0;
  Block<D> block = make_block<D>(config.name, cells, periodic, [&](const std::array<int, D>& index) {
    // the last node around is the first one, to the bit
    const double turns = static_cast<double>(index[0] % config.around) / config.around;
    const double angle = (config.start_angle / 180.0 + sense * 2.0 * turns) * M_PI;
    const double r = radii[static_cast<std::size_t>(index[1])];
    coupler::Vec3 x = config.centre;
    x[0] += r * std::cos(angle);
    x[2] += r * std::sin(angle);
    if constexpr (D == 3)
      x[1] = config.span.lower + (config.span.upper - config.span.lower) * index[2] / config.span.cells;
    std::array<double, D> position;
    for (std::size_t k = 0; k < D; ++k) position[k] = x[axis_in_space<D>(k)];
    return position;
  });
  block.face_names = named.face_names;
  add_windows(block, conditions, scene, others);
  return block;
}

template Block<2> build_ring<2>(const RingConfig&, const support::Scene&, const Neighbourhood&);
template Block<3> build_ring<3>(const RingConfig&, const support::Scene&, const Neighbourhood&);

}  // namespace littoral::fv
