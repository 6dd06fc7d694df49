#include "io/gauges.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>

#include "grid/donor_patch.hpp"
#include "grid/space.hpp"
#include "littoral/error.hpp"
#include "physics/wall_loads.hpp"

namespace littoral::fv {
namespace {

const char* const k_axes[] = {"x", "y", "z"};
const char* const k_velocities[] = {"u", "v", "w"};

/// Names of the windows of all ranks, each once.
template <int D>
std::vector<std::string> window_names(const std::vector<Block<D>>& blocks, const Ranks& ranks) {
  std::string mine;
  for (const auto& block : blocks)
    for (const auto& w : block.windows) mine += w.name + '\n';
  const std::vector<char> all = ranks.gather(std::vector<char>(mine.begin(), mine.end()));
  std::vector<std::string> names;
  std::istringstream lines(std::string(all.begin(), all.end()));
  for (std::string name; std::getline(lines, name);)
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  return names;
}

template <int D>
bool active(std::size_t a) {
  return D == 3 || a != 1;
}

template <int D>
std::vector<ElevationLine<D>> elevation_lines(const GaugeConfig& gauge, const Stepper<D>& stepper) {
  if (stepper.surface() == nullptr)
    throw ConfigError(
        "gauge '" + gauge.name +
        "' asks for an elevation, but this grid has no free surface: the scene's initial.surface "
        "is missing, or leaves no cell in the air");
  coupler::Vec3 at = gauge.at;
  if (D == 2) at[1] = 0.0;
  const coupler::Vec3 up = vector_in_space<D>(against_gravity(stepper.equations().fluid));
  std::vector<ElevationLine<D>> lines;
  bool found = false;
  for (const Block<D>& block : stepper.blocks()) {
    lines.emplace_back(block, at, up);
    found = found || lines.back().found();
  }
  if (stepper.exchange().ranks().any(found)) return lines;
  char text[96];
  std::snprintf(text, sizeof text, "(%g, %g, %g) m", at[0], at[1], at[2]);
  throw ConfigError("gauge '" + gauge.name + "': the line against gravity through " + text +
                    " meets no block");
}

}  // namespace

template <int D>
Gauges<D>::Gauges(const std::vector<GaugeConfig>& gauges, const Stepper<D>& stepper)
    : gauges_(gauges), places_(gauges.size()) {
  const auto& blocks = stepper.blocks();
  const Ranks& ranks = stepper.exchange().ranks();
  const std::vector<std::string> names = window_names<D>(blocks, ranks);
  Searches searches;
  for (std::size_t g = 0; g < gauges_.size(); ++g) {
    const GaugeConfig& gauge = gauges_[g];
    if (gauge.kind == GaugeConfig::Kind::elevation) {
      lines_.push_back(elevation_lines(gauge, stepper));
      continue;
    }
    if (gauge.kind != GaugeConfig::Kind::point) {
      if (std::find(names.begin(), names.end(), gauge.wall) != names.end()) continue;
      std::string known;
      for (const std::string& name : names) known += (known.empty() ? "" : ", ") + name;
      throw ConfigError("gauge '" + gauge.name + "': no wall is named '" + gauge.wall + "'. Known: " + known);
    }
    if (searches.empty())
      for (const Block<D>& block : blocks) {
        coupler::DonorGeometry geometry;
        std::vector<std::size_t> cells;
        geometry.patches.push_back(donor_patch<D>(block, 1, cells));
        searches.push_back(std::make_unique<coupler::DonorSearch>(geometry, D));
      }
    double worth = -1.0;
    Place place = find(stepper, searches, gauge.at, worth);
    const double best = ranks.largest(worth);
    if (best < 0.0) {
      char text[96];
      std::snprintf(text, sizeof text, "(%g, %g, %g) m", gauge.at[0], gauge.at[1], gauge.at[2]);
      throw ConfigError("gauge '" + gauge.name + "' at " + text + " lies in no block, or in blanked cells");
    }
    if (worth == best) places_[g] = std::move(place);
  }
}

template <int D>
typename Gauges<D>::Place Gauges<D>::find(const Stepper<D>& stepper, const Searches& searches,
                                          coupler::Vec3 at, double& worth) const {
  constexpr double k_component = 1e6, k_whole = 1e12;  // above the numbers of blocks, and of components
  const Layout<D>& layout = stepper.exchange().layout();
  const std::vector<std::size_t> mine = layout.owners.mine();
  Place best;
  if (D == 2) at[1] = 0.0;
  for (std::size_t b = 0; b < searches.size(); ++b) {
    std::int64_t hint = -1;
    const coupler::Donor donor = searches[b]->find(at, hint);
    if (!donor.found) continue;
    std::vector<std::size_t> cells;
    donor_patch<D>(stepper.blocks()[b], 1, cells);
    Place place;
    bool whole = true;
    for (std::size_t k = 0; k < 8; ++k) {
      if (donor.weight[k] == 0.0) continue;
      const std::size_t c = cells[static_cast<std::size_t>(donor.cell[k])];
      place.block.push_back(b);
      place.cell.push_back(c);
      place.weight.push_back(donor.weight[k]);
      const Block<D>& block = stepper.blocks()[b];
      const auto index = block.extent.index(static_cast<std::ptrdiff_t>(c));
      for (std::size_t d = 0; d < D; ++d)
        if (index[d] < 0 || index[d] >= block.extent.n[d])
          whole = whole && stepper.exchange().connected()[b][c] != 0;
    }
    const double is_worth = (whole ? k_whole : 0.0) +
                            k_component * static_cast<double>(layout.component[mine[b]]) +
                            static_cast<double>(mine[b]);
    if (is_worth <= worth) continue;
    worth = is_worth;
    best = std::move(place);
  }
  return best;
}

template <int D>
std::vector<std::string> Gauges<D>::columns() const {
  std::vector<std::string> names;
  for (const GaugeConfig& gauge : gauges_) {
    if (gauge.kind == GaugeConfig::Kind::point) {
      names.push_back(gauge.name + ".p");
      for (std::size_t a = 0; a < 3; ++a)
        if (active<D>(a)) names.push_back(gauge.name + "." + k_velocities[a]);
    } else if (gauge.kind == GaugeConfig::Kind::elevation) {
      names.push_back(gauge.name + ".elevation");
    } else if (gauge.kind == GaugeConfig::Kind::y_plus) {
      for (const char* part : {".y_plus_max", ".y_plus_mean"}) names.push_back(gauge.name + part);
    } else {
      for (const char* part : {".", ".dynamic_", ".pressure_", ".viscous_"}) {
        for (std::size_t a = 0; a < 3; ++a)
          if (active<D>(a)) names.push_back(gauge.name + part + "f" + k_axes[a]);
        for (std::size_t a = 0; a < 3; ++a)
          if (D == 3 || a == 1) names.push_back(gauge.name + part + "m" + k_axes[a]);
      }
    }
  }
  return names;
}

template <int D>
std::vector<double> Gauges<D>::values(const Stepper<D>& stepper) const {
  const Ranks& ranks = stepper.exchange().ranks();
  std::vector<double> values;
  std::size_t line = 0;
  for (std::size_t g = 0; g < gauges_.size(); ++g) {
    const GaugeConfig& gauge = gauges_[g];
    if (gauge.kind == GaugeConfig::Kind::point) {
      double p = 0.0;  // on the rank that reads it
      std::array<double, D> u{};
      for (std::size_t i = 0; i < places_[g].cell.size(); ++i) {
        const State<D>& q = stepper.state()[places_[g].block[i]];
        p += places_[g].weight[i] * q.p[places_[g].cell[i]];
        for (std::size_t k = 0; k < D; ++k) u[k] += places_[g].weight[i] * q.u[k][places_[g].cell[i]];
      }
      p = ranks.sum(p);  // 0 on all ranks but one
      ranks.sum(u);
      values.push_back(p);
      values.insert(values.end(), u.begin(), u.end());
    } else if (gauge.kind == GaugeConfig::Kind::elevation) {
      const Layout<D>& layout = stepper.exchange().layout();
      const std::vector<std::size_t> mine = layout.owners.mine();
      std::vector<Elevation> readings;
      for (std::size_t b = 0; b < lines_[line].size(); ++b) {
        readings.push_back(lines_[line][b].read(stepper.surface()->phi()[b]));
        readings.back().component = static_cast<double>(layout.component[mine[b]]);
      }
      ++line;
      values.push_back(highest(ranks.gather(readings)).height);
    } else if (gauge.kind == GaugeConfig::Kind::y_plus) {
      const WallUnits units =
          wall_units<D>(stepper.blocks(), stepper.equations(), stepper.state(), gauge.wall, ranks);
      values.insert(values.end(), {units.largest, units.mean});
    } else {
      const WallLoads loads = wall_loads<D>(
          stepper.blocks(), stepper.equations(), stepper.state(), gauge.wall, gauge.moment_about, ranks,
          stepper.surface() != nullptr ? &stepper.surface()->phi() : nullptr);
      for (const Load& load : {loads.total(), loads.dynamic(), loads.pressure, loads.viscous}) {
        for (std::size_t a = 0; a < 3; ++a)
          if (active<D>(a)) values.push_back(load.force[a]);
        for (std::size_t a = 0; a < 3; ++a)
          if (D == 3 || a == 1) values.push_back(load.moment[a]);
      }
    }
  }
  return values;
}

template class Gauges<2>;
template class Gauges<3>;

}  // namespace littoral::fv
