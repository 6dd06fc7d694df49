#include "io/gauges.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bodies/wall_view.hpp"
#include "io/pressure_disc.hpp"
#include "physics/kernel.hpp"
#include "physics/symmetric_matrix.hpp"

namespace littoral::sph {

namespace {

template <int D>
bool hidden(const Particles<D>& particles, const std::array<double, D>& x, std::size_t j,
            const Walls<D>* walls) {
  return walls != nullptr && walls->between(x, at<D>(particles.x, j));
}

}  // namespace

template <int D>
double coverage_at(const Particles<D>& particles, const NeighborList<D>& neighbors,
                   const std::array<double, D>& x, const Walls<D>* walls) {
  const Kernel<D> kernel(neighbors.kernel_radius());
  double sum = 0.0;
  neighbors.for_each_near(x, [&](std::size_t j) {
    double r2 = 0.0;
    for (std::size_t d = 0; d < D; ++d) r2 += (particles.x[d][j] - x[d]) * (particles.x[d][j] - x[d]);
    if (r2 >= kernel.R * kernel.R || hidden<D>(particles, x, j, walls)) return;
    sum += particles.V[j] * kernel.value(std::sqrt(r2));
  });
  return sum;
}

template <int D>
std::optional<PointValue<D>> value_at(const Particles<D>& particles, const NeighborList<D>& neighbors,
                                      const std::array<double, D>& x, const Walls<D>* walls) {
  // Centred form: q(x) = mean q + g . (x - mean x), g from the weighted covariances. Lengths over R.
  constexpr double k_flat = 1e-3;  // of the mean eigenvalue: neighbours nearly in a line or plane
  const Kernel<D> kernel(neighbors.kernel_radius());
  double weight = 0.0;
  std::array<double, D> centre{};
  PointValue<D> mean;
  const auto each = [&](const auto& f) {
    neighbors.for_each_near(x, [&](std::size_t j) {
      std::array<double, D> y;
      double r2 = 0.0;
      for (std::size_t d = 0; d < D; ++d) {
        y[d] = (particles.x[d][j] - x[d]) * kernel.inv_R;
        r2 += y[d] * y[d];
      }
      if (r2 >= 1.0 || hidden<D>(particles, x, j, walls)) return;
      const double w = particles.V[j] * kernel.value(std::sqrt(r2) * kernel.R);
      if (w > 0.0) f(j, w, y);
    });
  };
  each([&](std::size_t j, double w, const std::array<double, D>& y) {
    weight += w;
    mean.p += w * particles.p[j];
    for (std::size_t d = 0; d < D; ++d) {
      centre[d] += w * y[d];
      mean.u[d] += w * particles.u[d][j];
    }
  });
  if (!(weight > 0.0)) return std::nullopt;
  mean.p /= weight;
  for (std::size_t d = 0; d < D; ++d) {
    centre[d] /= weight;
    mean.u[d] /= weight;
  }
  SymmetricMatrix<D> spread;
  std::array<double, D> slope_p{};
  std::array<std::array<double, D>, D> slope_u{};
  each([&](std::size_t j, double w, std::array<double, D> y) {
    for (std::size_t d = 0; d < D; ++d) y[d] -= centre[d];
    std::size_t k = 0;
    for (std::size_t a = 0; a < D; ++a) {
      slope_p[a] += w * y[a] * (particles.p[j] - mean.p);
      for (std::size_t c = 0; c < D; ++c) slope_u[c][a] += w * y[a] * (particles.u[c][j] - mean.u[c]);
      for (std::size_t b = a; b < D; ++b) spread.a[k++] += w * y[a] * y[b];
    }
  });
  if (!(spread.least_eigenvalue_at_least() > k_flat * spread.trace() / D)) return mean;
  const SymmetricMatrix<D> inverse = spread.inverse();
  const auto at_x = [&](double value, const std::array<double, D>& slope) {
    const auto g = inverse * slope;
    for (std::size_t d = 0; d < D; ++d) value -= g[d] * centre[d];
    return value;
  };
  PointValue<D> result;
  result.p = at_x(mean.p, slope_p);
  for (std::size_t c = 0; c < D; ++c) result.u[c] = at_x(mean.u[c], slope_u[c]);
  return result;
}

template <int D>
std::optional<double> elevation_at(const Particles<D>& particles, const NeighborList<D>& neighbors,
                                   const std::array<double, D>& x, double spacing, const Walls<D>* walls) {
  constexpr double k_on_surface = 0.5;
  const Kernel<D> kernel(neighbors.kernel_radius());
  double top = -std::numeric_limits<double>::infinity(), bottom = -top;
  for (std::size_t j = 0; j < particles.size(); ++j) {
    double across2 = 0.0;
    for (std::size_t d = 0; d + 1 < D; ++d)
      across2 += (particles.x[d][j] - x[d]) * (particles.x[d][j] - x[d]);
    if (across2 > kernel.R * kernel.R) continue;
    top = std::max(top, particles.x[D - 1][j]);
    bottom = std::min(bottom, particles.x[D - 1][j]);
  }
  const auto excess = [&](double z) {
    auto point = x;
    point[D - 1] = z;
    const double free = walls ? 1.0 - walls->coverage(point) : 1.0;
    return coverage_at<D>(particles, neighbors, point, walls) - k_on_surface * free;
  };
  double low = top + kernel.R, high = low;
  do {
    high = low;
    low -= 0.5 * spacing;
    if (!(low > bottom - spacing)) return std::nullopt;
  } while (excess(low) < 0.0);
  for (int k = 0; k < 40; ++k) {  // bisection down to round-off of the spacing
    const double middle = 0.5 * (low + high);
    (excess(middle) < 0.0 ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

std::vector<std::string> gauge_columns(const std::vector<GaugeConfig>& gauges, int dimension) {
  std::vector<std::string> columns;
  for (const auto& gauge : gauges) {
    if (gauge.kind == GaugeConfig::Kind::elevation) {
      columns.push_back(gauge.name + ".elevation");
      continue;
    }
    if (gauge.kind == GaugeConfig::Kind::force_disc) {
      columns.push_back(gauge.name + ".p");
      continue;
    }
    if (gauge.kind == GaugeConfig::Kind::pressure_disc) {
      columns.push_back(gauge.name + ".p");
      columns.push_back(gauge.name + ".wet");
      continue;
    }
    for (const char* quantity : {"p", "u", "v", "w"})
      if (dimension == 3 || quantity[0] != 'v') columns.push_back(gauge.name + "." + quantity);
  }
  return columns;
}

template <int D>
std::vector<double> gauge_values(const std::vector<GaugeConfig>& gauges, const Particles<D>& particles,
                                 const NeighborList<D>& neighbors, double spacing, const Walls<D>* walls,
                                 const std::vector<double>& sensed) {
  constexpr double k_dry = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> values;
  auto sensor = sensed.begin();
  for (const auto& gauge : gauges) {
    if (gauge.kind == GaugeConfig::Kind::force_disc) {
      values.push_back(sensor == sensed.end() ? k_dry : *sensor++);
      continue;
    }
    std::array<double, D> x;
    for (std::size_t d = 0; d < D; ++d) x[d] = gauge.position[scene_axis<D>(d)];
    if (gauge.kind == GaugeConfig::Kind::elevation) {
      values.push_back(elevation_at<D>(particles, neighbors, x, spacing, walls).value_or(k_dry));
      continue;
    }
    if (gauge.kind == GaugeConfig::Kind::pressure_disc) {
      const DiscPressure disc = disc_pressure<D>(gauge, particles, neighbors, walls);
      values.insert(values.end(), {disc.p, disc.wet});
      continue;
    }
    const auto value = value_at<D>(particles, neighbors, x, walls);
    values.push_back(value ? value->p : k_dry);
    for (std::size_t d = 0; d < D; ++d) values.push_back(value ? value->u[d] : k_dry);
  }
  return values;
}

template double coverage_at<2>(const Particles<2>&, const NeighborList<2>&, const std::array<double, 2>&,
                               const Walls<2>*);
template double coverage_at<3>(const Particles<3>&, const NeighborList<3>&, const std::array<double, 3>&,
                               const Walls<3>*);
template std::optional<PointValue<2>> value_at<2>(const Particles<2>&, const NeighborList<2>&,
                                                  const std::array<double, 2>&, const Walls<2>*);
template std::optional<PointValue<3>> value_at<3>(const Particles<3>&, const NeighborList<3>&,
                                                  const std::array<double, 3>&, const Walls<3>*);
template std::optional<double> elevation_at<2>(const Particles<2>&, const NeighborList<2>&,
                                               const std::array<double, 2>&, double, const Walls<2>*);
template std::optional<double> elevation_at<3>(const Particles<3>&, const NeighborList<3>&,
                                               const std::array<double, 3>&, double, const Walls<3>*);
template std::vector<double> gauge_values<2>(const std::vector<GaugeConfig>&, const Particles<2>&,
                                             const NeighborList<2>&, double, const Walls<2>*,
                                             const std::vector<double>&);
template std::vector<double> gauge_values<3>(const std::vector<GaugeConfig>&, const Particles<3>&,
                                             const NeighborList<3>&, double, const Walls<3>*,
                                             const std::vector<double>&);

}  // namespace littoral::sph
