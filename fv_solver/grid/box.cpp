#include "grid/box.hpp"

#include <algorithm>
#include <cmath>

#include "grid/loops.hpp"
#include "grid/metrics.hpp"
#include "grid/space.hpp"
#include "littoral/error.hpp"

namespace littoral::fv {
namespace {

const char* const k_axis_names[] = {"x", "y", "z"};
const char* const k_side_names[] = {"lower", "upper"};

std::string face_name(std::size_t a, std::size_t side) {
  return std::string(k_axis_names[a]) + "_" + k_side_names[side];
}

/// One of two equal ends of a geometric series, n cells, widest over narrowest = ratio, narrow at 0.
double geometric(double ratio, double i, double n) {
  if (n <= 1.0 || ratio == 1.0) return i / n;
  const double q = std::pow(ratio, 1.0 / (n - 1.0));
  return std::expm1(i * std::log(q)) / std::expm1(n * std::log(q));
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
  for (std::size_t d = 0; d < D; ++d)
    if (axis_in_space<D>(d) == static_cast<std::size_t>(face / 2)) request.direction = static_cast<int>(d);
  request.side = face % 2;
}

template <int D>
Closing<D> resolve(const FaceConfig& face, const BlockConfig& block, const support::Scene& scene,
                   std::size_t d, std::size_t side, const Neighbourhood& others) {
  using Kind = typename JoinRequest<D>::Kind;
  const std::size_t a = axis_in_space<D>(d);
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
  switch (scene.domain.sides[a][side]) {
    case support::Scene::Side::periodic: {
      closing.condition = Condition::periodic;
      const double length = scene.domain.upper[a] - scene.domain.lower[a];
      const double own = block.upper[a] - block.lower[a];
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
      std::array<double, D> offset{};
      for (const double sign : {-1.0, 1.0}) {
        offset[d] = sign * length;
        closing.request.offsets.push_back(offset);
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
      closing.request.otherwise =
          "the scene says this side is open, so the face needs a condition (wall, slip, inflow, outflow, "
          "far_field, state), or a block that joins it";
      if (!others.automatic || others.alone)
        throw ConfigError(
            "block '" + block.name + "', faces." + face_name(a, side) +
            ": the scene says this side is open, so the face needs a condition (wall, slip, inflow, "
            "outflow, far_field, state)");
      break;
  }
  return closing;
}

template <int D>
Window<D> window_of(const FaceConfig& face, const Closing<D>& closing, std::size_t d, std::size_t side,
                    const std::string& fallback_name) {
  Window<D> w;
  w.name = face.name.empty() ? fallback_name : face.name;
  w.condition = closing.condition;
  w.request = closing.request;
  w.direction = static_cast<int>(d);
  w.side = static_cast<int>(side);
  w.wave_speed = face.wave_speed;
  const std::array<const std::optional<support::Formula>*, 3> velocity = {&face.u, &face.v, &face.w};
  for (std::size_t k = 0; k < D; ++k) {
    const auto& formula = *velocity[axis_in_space<D>(k)];
    if (formula)
      w.velocity[k] = [f = *formula](const std::array<double, 3>& x, double t) {
        return f(x[0], x[1], x[2], t);
      };
  }
  if (face.p)
    w.pressure = [f = *face.p](const std::array<double, 3>& x, double t) { return f(x[0], x[1], x[2], t); };
  return w;
}

/// Windows of one face: the face cut along all edges of its patches, each piece with the last patch over it.
template <int D>
void add_face(Block<D>& block, const BlockConfig& config, const support::Scene& scene,
              const Neighbourhood& others, std::size_t d, std::size_t side) {
  const std::size_t a = axis_in_space<D>(d);
  const std::string face = face_name(a, side);
  const auto face_index = static_cast<int>(2 * a + side);
  std::vector<const PatchConfig*> patches;
  for (const auto& patch : config.patches)
    if (patch.face == face_index) patches.push_back(&patch);

  std::array<std::vector<int>, D> cuts;
  for (std::size_t k = 0; k < D; ++k) {
    cuts[k] = {0, k == d ? 1 : block.extent.n[k]};
    if (k == d) continue;
    for (const PatchConfig* patch : patches) {
      const int from = patch->from[axis_in_space<D>(k)], to = patch->to[axis_in_space<D>(k)];
      if (from >= to || to > block.extent.n[k])
        throw ConfigError("block '" + config.name + "', patch on " + face + ": cells " +
                          std::to_string(from) + " to " + std::to_string(to) + " along " +
                          k_axis_names[axis_in_space<D>(k)] + " do not lie within 0 to " +
                          std::to_string(block.extent.n[k]));
      cuts[k].push_back(from);
      cuts[k].push_back(to);
    }
    std::sort(cuts[k].begin(), cuts[k].end());
    cuts[k].erase(std::unique(cuts[k].begin(), cuts[k].end()), cuts[k].end());
  }
  std::array<int, D> pieces;
  for (std::size_t k = 0; k < D; ++k) pieces[k] = static_cast<int>(cuts[k].size()) - 1;
  for_each_index<D>({}, pieces, [&](const std::array<int, D>& piece) {
    const FaceConfig* condition = &config.faces[static_cast<std::size_t>(face_index)];
    std::array<int, D> lower, upper;
    for (std::size_t k = 0; k < D; ++k) {
      lower[k] = cuts[k][static_cast<std::size_t>(piece[k])];
      upper[k] = cuts[k][static_cast<std::size_t>(piece[k]) + 1];
    }
    for (const PatchConfig* patch : patches) {
      bool inside = true;
      for (std::size_t k = 0; k < D; ++k)
        if (k != d)
          inside = inside && lower[k] >= patch->from[axis_in_space<D>(k)] &&
                   upper[k] <= patch->to[axis_in_space<D>(k)];
      if (inside) condition = &patch->condition;
    }
    Window<D> w = window_of<D>(*condition, resolve<D>(*condition, config, scene, d, side, others), d, side,
                               config.name + "." + face);
    w.lower = lower;
    w.upper = upper;
    block.windows.push_back(w);
  });
}

}  // namespace

double stretched(const Stretching& stretching, int i, int n) {
  const double s = static_cast<double>(i) / n;
  const auto toward = stretching.toward;
  using Toward = Stretching::Toward;
  // distances from a refined lower end; the other cases are its mirror images
  const auto from_lower = [&](double index, double count) {
    if (stretching.kind == Stretching::Kind::geometric) return geometric(stretching.ratio, index, count);
    return 1.0 - std::tanh(stretching.strength * (1.0 - index / count)) / std::tanh(stretching.strength);
  };
  if (stretching.kind == Stretching::Kind::uniform) return s;
  if (toward == Toward::lower) return from_lower(i, n);
  if (toward == Toward::upper) return 1.0 - from_lower(n - i, n);
  const double half = 0.5 * n;
  return s <= 0.5 ? 0.5 * from_lower(i, half) : 1.0 - 0.5 * from_lower(n - i, half);
}

template <int D>
Block<D> build_block(const BlockConfig& config, const support::Scene& scene, const Neighbourhood& others) {
  std::array<int, D> cells;
  std::array<bool, D> periodic;
  for (std::size_t d = 0; d < D; ++d) {
    const std::size_t a = axis_in_space<D>(d);
    cells[d] = config.cells[a];
    if (!(config.lower[a] < config.upper[a]))
      throw ConfigError("block '" + config.name + "': upper is not above lower along " + k_axis_names[a]);
    std::array<bool, 2> both;
    for (std::size_t side = 0; side < 2; ++side)
      both[side] = resolve<D>(config.faces[2 * a + side], config, scene, d, side, others).condition ==
                   Condition::periodic;
    if (both[0] != both[1])
      throw ConfigError("block '" + config.name + "': periodic along " + k_axis_names[a] +
                        " on one side only; faces of different blocks, or other faces, are joined with an "
                        "offset (condition: join)");
    periodic[d] = both[0];
    if (periodic[d] && scene.gravity[a] != 0.0)
      throw ConfigError(
          "block '" + config.name + "' is periodic along " + k_axis_names[a] +
          ", where gravity has a component: a hydrostatic pressure cannot be periodic. A driving "
          "force belongs into source." +
          (a == 0   ? "u"
           : a == 1 ? "v"
                    : "w"));
  }
  Block<D> block = make_block<D>(config.name, cells, periodic, [&](const std::array<int, D>& index) {
    std::array<double, 3> box = config.lower;
    for (std::size_t d = 0; d < D; ++d) {
      const std::size_t a = axis_in_space<D>(d);
      const double s = stretched(config.stretching[a], index[d], cells[d]);
      box[a] = config.lower[a] + (config.upper[a] - config.lower[a]) * s;
    }
    std::array<double, D> x;
    for (std::size_t d = 0; d < D; ++d) {
      const std::size_t a = axis_in_space<D>(d);
      x[d] = config.mapping[a] ? (*config.mapping[a])(box[0], box[1], box[2], 0.0) : box[a];
    }
    return x;
  });
  block.cartesian_names = true;
  for (std::size_t d = 0; d < D; ++d)
    for (std::size_t side = 0; side < 2; ++side) add_face(block, config, scene, others, d, side);
  return block;
}

template Block<2> build_block<2>(const BlockConfig&, const support::Scene&, const Neighbourhood&);
template Block<3> build_block<3>(const BlockConfig&, const support::Scene&, const Neighbourhood&);

}  // namespace littoral::fv
