#include "io/body_output.hpp"

#include <algorithm>

namespace littoral::sph {
namespace {

constexpr std::array<const char*, 3> k_axes = {"x", "y", "z"};

bool has_force(std::size_t axis, int dimension) { return dimension == 3 || axis != 1; }
bool has_moment(std::size_t axis, int dimension) { return dimension == 3 || axis == 1; }

}  // namespace

std::vector<std::string> body_columns(const std::vector<support::BodySpec>& bodies, int dimension) {
  std::vector<std::string> columns;
  for (const auto& body : bodies)
    for (const char* part : {".", ".pressure_", ".viscous_"}) {
      for (std::size_t a = 0; a < 3; ++a)
        if (has_force(a, dimension)) columns.push_back(body.name + part + "f" + k_axes[a]);
      for (std::size_t a = 0; a < 3; ++a)
        if (has_moment(a, dimension)) columns.push_back(body.name + part + "m" + k_axes[a]);
    }
  return columns;
}

std::vector<double> body_values(const std::vector<BodyLoad>& loads, int dimension) {
  std::vector<double> values;
  const auto put = [&](const Vector3& force, const Vector3& moment) {
    for (std::size_t a = 0; a < 3; ++a)
      if (has_force(a, dimension)) values.push_back(force[a]);
    for (std::size_t a = 0; a < 3; ++a)
      if (has_moment(a, dimension)) values.push_back(moment[a]);
  };
  for (const auto& load : loads) {
    put(load.pressure + load.viscous, load.pressure_moment + load.viscous_moment);
    put(load.pressure, load.pressure_moment);
    put(load.viscous, load.viscous_moment);
  }
  return values;
}

template <int D>
BodyPoints<D>::BodyPoints(const std::string& folder, bool restarted, double restart_time)
    : series_(folder, "bodies", restarted, restart_time), written_(restarted) {}

template <int D>
void BodyPoints<D>::write(double time, const Walls<D>& walls) {
  const auto& bodies = walls.bodies();
  const bool moves = std::any_of(bodies.begin(), bodies.end(), [](const Body& body) { return body.moves(); });
  if (written_ && !moves) return;
  written_ = true;
  const auto& dummies = walls.dummies();
  const std::size_t n = dummies.size();
  std::vector<double> xyz(3 * n, 0.0);
  support::OutputField body{"body", 1, std::vector<double>(n)};
  support::OutputField velocity{"velocity", 3, std::vector<double>(3 * n, 0.0)};
  for (std::size_t k = 0; k < n; ++k) {
    body.values[k] = static_cast<double>(dummies[k].body);
    for (std::size_t d = 0; d < D; ++d) {
      xyz[3 * k + scene_axis<D>(d)] = dummies[k].x[d];
      velocity.values[3 * k + scene_axis<D>(d)] = dummies[k].u[d];
    }
  }
  series_.write_points(time, xyz, {body, velocity});
}

template class BodyPoints<2>;
template class BodyPoints<3>;

}  // namespace littoral::sph
