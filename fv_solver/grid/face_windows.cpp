#include "grid/face_windows.hpp"

#include <algorithm>
#include <cmath>

#include "boundary/prescribed.hpp"
#include "grid/loops.hpp"
#include "grid/space.hpp"
#include "littoral/error.hpp"

namespace littoral::fv {
namespace {

const char* const k_needs_condition =
    "the face needs a condition (wall, slip, inflow, outflow, far_field, state), or a block that joins it";

template <int D>
std::string direction_name(const Block<D>& block, std::size_t d) {
  return face_name(block, static_cast<int>(d), 0).substr(0, 1);
}

/// What closes a face, and what it may be joined with.
template <int D>
struct Closing {
  Condition condition = Condition::wall;
  JoinRequest<D> request;
};

template <int D>
std::array<double, D> in_grid(const std::array<double, 3>& v) {
  std::array<double, D> x;
  for (std::size_t k = 0; k < D; ++k) x[k] = v[axis_in_space<D>(k)];
  return x;
}

/// Direction and side of a face numbered 2 * axis + side as the user names it; -1: any.
template <int D>
void set_face(int face, JoinRequest<D>& request) {
  if (face < 0) return;
  request.side = face % 2;
  if (face >= FaceConfig::k_first_direction) {
    request.direction = (face - FaceConfig::k_first_direction) / 2;
    return;
  }
  for (std::size_t d = 0; d < D; ++d)
    if (axis_in_space<D>(d) == static_cast<std::size_t>(face / 2)) request.direction = static_cast<int>(d);
}

template <int D>
Closing<D> resolve(const FaceConfig& face, const Block<D>& block, const FaceConditions<D>& conditions,
                   const support::Scene& scene, std::size_t d, std::size_t side,
                   const Neighbourhood& others) {
  using Kind = typename JoinRequest<D>::Kind;
  Closing<D> closing;
  if (face.condition != static_cast<int>(FaceConfig::Kind::by_scene)) {
    closing.condition = static_cast<Condition>(face.condition);
    if (closing.condition != Condition::join) return closing;
    closing.request.kind = Kind::required;
    closing.request.block = face.join.block;
    set_face<D>(face.join.face, closing.request);
    const std::array<double, D> offset = in_grid<D>(face.join.offset);
    if (offset != std::array<double, D>{}) closing.request.offsets.push_back(offset);
    return closing;
  }
  if (others.automatic) closing.request.kind = Kind::if_met;
  if (conditions.scene_axis[d] < 0) {
    closing.condition = Condition::join;
    closing.request.kind = Kind::required;
    closing.request.otherwise = k_needs_condition;
    return closing;
  }
  const auto a = static_cast<std::size_t>(conditions.scene_axis[d]);
  switch (scene.domain.sides[a][side]) {
    case support::Scene::Side::periodic: {
      closing.condition = Condition::periodic;
      const double length = scene.domain.upper[a] - scene.domain.lower[a];
      const double own = conditions.length[d];
      constexpr double k_round_off = 1e-9;
      if (others.alone || std::abs(own - length) <= k_round_off * length) {
        closing.request.kind = Kind::none;
        break;
      }
      closing.condition =
          Condition::join;  // one of several along the direction: the next, or the domain's other side
      closing.request.kind = Kind::required;
      closing.request.otherwise =
          "the scene is periodic along this direction, and the block is only a part of it";
      for (const double sign : {-1.0, 1.0}) {
        std::array<double, 3> offset{};
        offset[a] = sign * length;
        closing.request.offsets.push_back(in_grid<D>(offset));
      }
      break;
    }
    case support::Scene::Side::symmetry:
      closing.condition = Condition::symmetry;
      break;
    case support::Scene::Side::open:
      closing.condition = Condition::fringe;
      if (scene.coupling.kind != support::Scene::CouplingKind::none) break;
      closing.condition = Condition::join;
      closing.request.kind = Kind::required;
      closing.request.otherwise = "the scene says this side is open: " + std::string(k_needs_condition);
      if (!others.automatic || others.alone)
        throw ConfigError("block '" + block.name + "', faces." +
                          face_name(block, static_cast<int>(d), static_cast<int>(side)) + ": " +
                          closing.request.otherwise);
      break;
  }
  return closing;
}

/// What a condition is called, and which of a face's values it uses.
struct Uses {
  Condition condition;
  const char* name;
  bool velocity, pressure, surface, wave_speed;
};
constexpr Uses k_uses[] = {
    {Condition::wall, "wall", true, false, false, false},
    {Condition::slip, "slip", false, false, false, false},
    {Condition::symmetry, "symmetry", false, false, false, false},
    {Condition::inflow, "inflow", true, false, true, false},
    {Condition::outflow, "outflow", false, true, true, false},
    {Condition::convective, "convective", true, true, true, true},
    {Condition::far_field, "far_field", true, true, true, true},
    {Condition::state, "state", true, true, true, false},
    {Condition::periodic, "periodic", false, false, false, false},
    {Condition::fringe, "fringe", false, false, false, false},
    {Condition::join, "join", false, false, false, false},
    {Condition::overset, "overset", false, false, false, false},
};

/// A value that is not used, or an inflow without one, is a mistake of the user's.
/// throws ConfigError naming the face
void check_values(const FaceConfig& face, Condition condition, const std::string& name) {
  const Uses& uses = *std::find_if(std::begin(k_uses), std::end(k_uses),
                                   [&](const Uses& u) { return u.condition == condition; });
  std::string unused;
  const auto refuse = [&](bool given, bool used, const char* key) {
    if (given && !used) unused += std::string(unused.empty() ? "" : ", ") + key;
  };
  refuse(face.u.has_value(), uses.velocity, "u");
  refuse(face.v.has_value(), uses.velocity, "v");
  refuse(face.w.has_value(), uses.velocity, "w");
  refuse(face.p.has_value(), uses.pressure, "p");
  refuse(face.surface.has_value(), uses.surface, "surface");
  refuse(face.wave_speed != 0.0, uses.wave_speed, "wave_speed");
  if (!unused.empty())
    throw ConfigError("face '" + name + "': condition " + uses.name + " does not use " + unused +
                      "; leave it out, or choose another condition");
  if (condition == Condition::inflow && !face.u && !face.v && !face.w)
    throw ConfigError("face '" + name +
                      "': an inflow needs its velocity: u, v or w (0 for a wall of water at rest)");
}

template <int D>
Window<D> window_of(const FaceConfig& face, const Closing<D>& closing, const support::Scene& scene,
                    std::size_t d, std::size_t side, const std::string& fallback_name) {
  Window<D> w;
  w.name = face.name.empty() ? fallback_name : face.name;
  w.condition = closing.condition;
  check_values(face, w.condition, w.name);
  w.request = closing.request;
  w.direction = static_cast<int>(d);
  w.side = static_cast<int>(side);
  w.wave_speed = face.wave_speed;
  const std::string face_at = "face '" + w.name + "', ";
  const std::array<const char*, 3> k_velocity = {"u", "v", "w"};
  const std::array<const std::optional<support::Formula>*, 3> velocity = {&face.u, &face.v, &face.w};
  for (std::size_t k = 0; k < D; ++k) {
    const std::size_t axis = axis_in_space<D>(k);
    if (const auto& formula = *velocity[axis])
      w.velocity[k] = prescribed(*formula, face_at + k_velocity[axis]);
  }
  if (face.p) w.pressure = prescribed(*face.p, face_at + "p");
  if (face.surface)
    w.surface = prescribed(*face.surface, face_at + "surface");
  else if (scene.initial.surface)
    w.surface = prescribed(*scene.initial.surface, face_at + "initial.surface");
  return w;
}

/// Windows of one face.
template <int D>
void add_face(Block<D>& block, const FaceConditions<D>& conditions, const support::Scene& scene,
              const Neighbourhood& others, std::size_t d, std::size_t side) {
  using Patch = typename FaceConditions<D>::Patch;
  const std::string face = face_name(block, static_cast<int>(d), static_cast<int>(side));
  std::vector<const Patch*> patches;
  for (const Patch& patch : conditions.patches)
    if (patch.direction == static_cast<int>(d) && patch.side == static_cast<int>(side))
      patches.push_back(&patch);

  std::array<std::vector<int>, D> cuts;
  for (std::size_t k = 0; k < D; ++k) {
    cuts[k] = {0, k == d ? 1 : block.extent.n[k]};
    if (k == d) continue;
    for (const Patch* patch : patches) {
      if (patch->from[k] < 0 || patch->from[k] >= patch->to[k] || patch->to[k] > block.extent.n[k])
        throw ConfigError("block '" + block.name + "', patch on " + face + ": cells " +
                          std::to_string(patch->from[k]) + " to " + std::to_string(patch->to[k]) + " along " +
                          direction_name(block, k) + " do not lie within 0 to " +
                          std::to_string(block.extent.n[k]));
      cuts[k].push_back(patch->from[k]);
      cuts[k].push_back(patch->to[k]);
    }
    std::sort(cuts[k].begin(), cuts[k].end());
    cuts[k].erase(std::unique(cuts[k].begin(), cuts[k].end()), cuts[k].end());
  }
  std::array<int, D> pieces;
  for (std::size_t k = 0; k < D; ++k) pieces[k] = static_cast<int>(cuts[k].size()) - 1;
  for_each_index<D>({}, pieces, [&](const std::array<int, D>& piece) {
    const FaceConfig* condition = &conditions.faces[d][side];
    std::array<int, D> lower, upper;
    for (std::size_t k = 0; k < D; ++k) {
      lower[k] = cuts[k][static_cast<std::size_t>(piece[k])];
      upper[k] = cuts[k][static_cast<std::size_t>(piece[k]) + 1];
    }
    for (const Patch* patch : patches) {
      bool inside = true;
      for (std::size_t k = 0; k < D; ++k)
        if (k != d) inside = inside && lower[k] >= patch->from[k] && upper[k] <= patch->to[k];
      if (inside) condition = &patch->condition;
    }
    Window<D> w = window_of<D>(*condition, resolve<D>(*condition, block, conditions, scene, d, side, others),
                               scene, d, side, block.name + "." + face);
    w.lower = lower;
    w.upper = upper;
    block.windows.push_back(w);
  });
}

/// A hydrostatic pressure cannot be the same at both ends.
template <int D>
void check_gravity(const Block<D>& block, const support::Scene& scene, std::size_t d) {
  std::array<int, D> far{};
  far[d] = block.extent.n[d];
  double largest = 0.0, span = 0.0;
  std::size_t axis = 0;
  const auto near_node = static_cast<std::size_t>(block.node_extent.at({}));
  const auto far_node = static_cast<std::size_t>(block.node_extent.at(far));
  for (std::size_t k = 0; k < D; ++k) {
    const double offset = block.node[k][far_node] - block.node[k][near_node];
    span += std::abs(block.node[k][near_node]) + std::abs(block.node[k][far_node]);
    if (scene.gravity[axis_in_space<D>(k)] == 0.0 || std::abs(offset) <= largest) continue;
    largest = std::abs(offset);
    axis = axis_in_space<D>(k);
  }
  constexpr double k_round_off = 1e-12;  // a ring closes on itself, without an offset
  if (largest <= k_round_off * span) return;
  throw ConfigError("block '" + block.name + "' is periodic along " + direction_name(block, d) +
                    ", where gravity has a component: a hydrostatic pressure cannot be periodic. A driving "
                    "force belongs into source." +
                    "uvw"[axis]);
}

}  // namespace

template <int D>
std::array<bool, D> periodic_directions(const Block<D>& block, const FaceConditions<D>& conditions,
                                        const support::Scene& scene, const Neighbourhood& others) {
  std::array<bool, D> periodic{};
  for (std::size_t d = 0; d < D; ++d) {
    std::array<bool, 2> both;
    for (std::size_t side = 0; side < 2; ++side)
      both[side] =
          resolve<D>(conditions.faces[d][side], block, conditions, scene, d, side, others).condition ==
          Condition::periodic;
    if (both[0] != both[1])
      throw ConfigError("block '" + block.name + "': periodic along " + direction_name(block, d) +
                        " on one side only; faces of different blocks, or other faces, are joined with an "
                        "offset (condition: join)");
    periodic[d] = both[0];
  }
  return periodic;
}

template <int D>
void add_windows(Block<D>& block, const FaceConditions<D>& conditions, const support::Scene& scene,
                 const Neighbourhood& others) {
  for (std::size_t d = 0; d < D; ++d) {
    if (block.periodic[d]) check_gravity(block, scene, d);
    for (std::size_t side = 0; side < 2; ++side) add_face(block, conditions, scene, others, d, side);
  }
}

template std::array<bool, 2> periodic_directions<2>(const Block<2>&, const FaceConditions<2>&,
                                                    const support::Scene&, const Neighbourhood&);
template std::array<bool, 3> periodic_directions<3>(const Block<3>&, const FaceConditions<3>&,
                                                    const support::Scene&, const Neighbourhood&);
template void add_windows<2>(Block<2>&, const FaceConditions<2>&, const support::Scene&,
                             const Neighbourhood&);
template void add_windows<3>(Block<3>&, const FaceConditions<3>&, const support::Scene&,
                             const Neighbourhood&);

}  // namespace littoral::fv
