#include "grid/plate.hpp"

#include <cmath>

#include "grid/metrics.hpp"
#include "grid/space.hpp"
#include "grid/stretching.hpp"
#include "littoral/error.hpp"

namespace littoral::fv {
namespace {

/// Nodes along one axis before the grid is turned, and which cells lie on the plate.
struct Axis {
  std::vector<double> nodes;
  int first = 0, last = 0;  // cells on the plate: [first, last)
};

Stretching::Section section(double to, int cells, const std::optional<double>& fine, Spacing::Toward toward) {
  Stretching::Section s;
  s.to = to;
  s.cells = cells;
  if (fine) {
    s.spacing.kind = Spacing::Kind::geometric;
    s.spacing.first_cell = fine;
    s.spacing.toward = toward;
  }
  return s;
}

/// Three sections, fine at the plate's two edges.
Axis along(double before, double plate, double behind, int n_before, int n_plate, int n_behind,
           const std::optional<double>& edge, const std::string& where) {
  Stretching s;
  const double begin = -0.5 * plate, end = 0.5 * plate;
  s.sections = {section(begin, n_before, edge, Spacing::Toward::upper),
                section(end, n_plate, edge, Spacing::Toward::both),
                section(end + behind, n_behind, edge, Spacing::Toward::lower)};
  return {node_positions(s, n_before + n_plate + n_behind, begin - before, end + behind, where), n_before,
          n_before + n_plate};
}

std::vector<double> layer(double from, double to, int cells, const std::optional<double>& fine,
                          Spacing::Toward toward, const std::string& where) {
  Stretching s;
  s.sections = {section(to, cells, fine, toward)};
  return node_positions(s, cells, from, to, where);
}

template <int D>
class Plate {
 public:
  Plate(const PlateConfig& config, const support::Scene& scene, const Neighbourhood& others)
      : c_(config), scene_(scene), others_(others) {
    const std::string where = "plate '" + c_.name + "'";
    x_ = along(c_.reach[PlateConfig::upstream], c_.chord, c_.reach[PlateConfig::downstream],
               c_.cells[PlateConfig::upstream], c_.along, c_.cells[PlateConfig::downstream], c_.edge_cell,
               where + ", along the chord");
    if (D == 3) set_span(where);
    const double half = 0.5 * c_.thickness;
    below_ = layer(-half - c_.reach[PlateConfig::below], -half, c_.cells[PlateConfig::below], c_.first_cell,
                   Spacing::Toward::upper, where + ", below");
    above_ = layer(half, half + c_.reach[PlateConfig::above], c_.cells[PlateConfig::above], c_.first_cell,
                   Spacing::Toward::lower, where + ", above");
    if (c_.thickness > 0.0)
      middle_ = layer(-half, half, c_.through, c_.first_cell, Spacing::Toward::both, where + ", through");
  }

  std::vector<Block<D>> build() const {
    const int nx = static_cast<int>(x_.nodes.size()) - 1,
              ny = D == 3 ? static_cast<int>(y_.nodes.size()) - 1 : 1;
    std::vector<Block<D>> blocks = {block("below", below_, 0, nx, 0, ny),
                                    block("above", above_, 0, nx, 0, ny)};
    if (middle_.empty()) return blocks;
    blocks.push_back(block("front", middle_, 0, x_.first, 0, ny));
    blocks.push_back(block("back", middle_, x_.last, nx, 0, ny));
    if (D == 3 && y_.first > 0) {
      blocks.push_back(block("left", middle_, x_.first, x_.last, 0, y_.first));
      blocks.push_back(block("right", middle_, x_.first, x_.last, y_.last, ny));
    }
    return blocks;
  }

 private:
  using Conditions = FaceConditions<D>;

  void set_span(const std::string& where) {
    if (!(c_.span.lower < c_.span.upper))
      throw ConfigError(where + ": in 3-D it needs a span whose upper end is above the lower one");
    const double middle = c_.centre[1];
    if (!c_.width) {
      for (int j = 0; j <= c_.span.cells; ++j)
        y_.nodes.push_back(c_.span.lower + (c_.span.upper - c_.span.lower) * j / c_.span.cells);
      y_.last = c_.span.cells;
      return;
    }
    const double left = middle - 0.5 * *c_.width - c_.span.lower,
                 right = c_.span.upper - middle - 0.5 * *c_.width;
    if (!(left > 0.0) || !(right > 0.0))
      throw ConfigError(where +
                        ": its width reaches beyond the span; leave width out for a plate from end to end");
    y_ = along(left, *c_.width, right, c_.side_cells, c_.span.cells, c_.side_cells, c_.edge_cell,
               where + ", along the span");
    for (double& y : y_.nodes) y += middle;
  }

  FaceConfig wall() const {
    FaceConfig w = c_.wall;
    if (w.condition == static_cast<int>(FaceConfig::Kind::by_scene))
      w.condition = static_cast<int>(Condition::wall);
    if (w.name.empty()) w.name = c_.name;
    return w;
  }

  /// Cells [x0, x1) along the chord, [y0, y1) along the span, over the nodes z.
  Block<D> block(const std::string& part, const std::vector<double>& z, int x0, int x1, int y0,
                 int y1) const {
    const auto up = static_cast<std::size_t>(D - 1);  // direction across the plate
    std::array<int, D> cells{};
    cells[0] = x1 - x0;
    if (D == 3) cells[1] = y1 - y0;
    cells[up] = static_cast<int>(z.size()) - 1;
    Block<D> named;
    named.name = c_.name + "." + part;
    const Conditions conditions = conditions_of(part, cells, x0, x1, y0, y1);
    const std::array<bool, D> periodic = periodic_directions(named, conditions, scene_, others_);
    const double cos = std::cos(c_.angle * M_PI / 180.0), sin = std::sin(c_.angle * M_PI / 180.0);
    Block<D> built = make_block<D>(named.name, cells, periodic, [&](const std::array<int, D>& i) {
      const double along = x_.nodes[static_cast<std::size_t>(x0 + i[0])],
                   across = z[static_cast<std::size_t>(i[up])];
      coupler::Vec3 x = {c_.centre[0] + cos * along - sin * across, 0.0,
                         c_.centre[2] + sin * along + cos * across};
      if (D == 3) x[1] = y_.nodes[static_cast<std::size_t>(y0 + i[1])];
      std::array<double, D> position;
      for (std::size_t k = 0; k < D; ++k) position[k] = x[axis_in_space<D>(k)];
      return position;
    });
    add_windows(built, conditions, scene_, others_);
    return built;
  }

  Conditions conditions_of(const std::string& part, const std::array<int, D>& cells, int x0, int x1, int y0,
                           int y1) const {
    const auto up = static_cast<std::size_t>(D - 1);
    Conditions f;
    if (x0 == 0) f.faces[0][0] = c_.faces[PlateConfig::upstream];
    if (x1 + 1 == static_cast<int>(x_.nodes.size())) f.faces[0][1] = c_.faces[PlateConfig::downstream];
    if (part == "below") f.faces[up][0] = c_.faces[PlateConfig::below];
    if (part == "above") f.faces[up][1] = c_.faces[PlateConfig::above];
    if constexpr (D == 3) {
      const bool lower = y0 == 0, upper = y1 + 1 == static_cast<int>(y_.nodes.size());
      if (lower) f.faces[1][0] = c_.span.faces[0];
      if (upper) f.faces[1][1] = c_.span.faces[1];
      f.length[1] = y_.nodes[static_cast<std::size_t>(y1)] - y_.nodes[static_cast<std::size_t>(y0)];
      if (lower || upper) f.scene_axis[1] = 1;
    }
    const auto patch = [&](std::size_t direction, int side) {
      typename Conditions::Patch p;
      p.direction = static_cast<int>(direction);
      p.side = side;
      p.to = cells;
      if (direction != 0) {
        p.from[0] = x_.first - x0;
        p.to[0] = x_.last - x0;
      }
      if (D == 3 && direction != 1) {
        p.from[1] = y_.first - y0;
        p.to[1] = y_.last - y0;
      }
      p.condition = wall();
      f.patches.push_back(p);
    };
    if (part == "below") patch(up, 1);
    if (part == "above") patch(up, 0);
    if (part == "front") patch(0, 1);
    if (part == "back") patch(0, 0);
    if (D == 3 && part == "left") f.faces[1][1] = wall();
    if (D == 3 && part == "right") f.faces[1][0] = wall();
    return f;
  }

  const PlateConfig& c_;
  const support::Scene& scene_;
  const Neighbourhood& others_;
  Axis x_, y_;
  std::vector<double> below_, above_, middle_;  // nodes across; middle_ empty for a sheet
};

}  // namespace

template <int D>
std::vector<Block<D>> build_plate(const PlateConfig& config, const support::Scene& scene,
                                  const Neighbourhood& others) {
  return Plate<D>(config, scene, others).build();
}

template std::vector<Block<2>> build_plate<2>(const PlateConfig&, const support::Scene&,
                                              const Neighbourhood&);
template std::vector<Block<3>> build_plate<3>(const PlateConfig&, const support::Scene&,
                                              const Neighbourhood&);

}  // namespace littoral::fv
