#include "io/output.hpp"

#include <algorithm>

#include "io/gauges.hpp"
#include "io/gauges_mpi.hpp"
#include "littoral/support/due.hpp"
#include "littoral/support/timers.hpp"
#include "parallel/gather_mpi.hpp"

namespace littoral::sph {
namespace {

/// One column a face of the region's boxes, as ExchangeCounts has them: <what>_x_lower, ...
void add_face_columns(std::vector<std::string>& columns, const std::string& what, int dimension) {
  for (int axis = 0; axis < 3; ++axis)
    if (dimension == 3 || axis != 1)
      for (const char* side : {"_lower", "_upper"}) columns.push_back(what + "_" + "xyz"[axis] + side);
}

template <class Counts>
void add_face_counts(std::vector<double>& row, const Counts& counts, int dimension) {
  for (std::size_t face = 0; face < counts.size(); ++face)
    if (dimension == 3 || face / 2 != 1) row.push_back(static_cast<double>(counts[face]));
}

std::vector<std::string> scalar_columns(const support::Scene& scene) {
  std::vector<std::string> columns = {"time",
                                      "dt",
                                      "substeps",
                                      "kinetic_energy",
                                      "potential_energy",
                                      "mass",
                                      "n_particles",
                                      "largest_speed",
                                      "mass_in_region",
                                      "mass_on_faces",
                                      "mass_injected",
                                      "mass_removed",
                                      "mass_flux",
                                      "fv_mass_flux",
                                      "n_injected",
                                      "n_removed",
                                      "ledger_defect",
                                      "n_removed_crossing",
                                      "n_removed_nearest",
                                      "n_blending",
                                      "n_driven",
                                      "n_without_donors"};
  if (scene.has_region()) {
    add_face_columns(columns, "n_injected", scene.dimension);
    add_face_columns(columns, "n_removed", scene.dimension);
  }
  for (const char* phase : k_phase_names) columns.push_back(std::string("seconds_") + phase);
  columns.insert(columns.end(), {"seconds_output", "seconds_wait"});
  return columns;
}

std::vector<std::string> with_time(std::vector<std::string> columns) {
  columns.insert(columns.begin(), "time");
  return columns;
}

/// A field of the particles by its name in sph.yaml; vectors get three components, y = 0 in 2-D.
template <int D>
support::OutputField field(const std::string& name, const Particles<D>& particles) {
  support::OutputField out{name, 1, {}};
  const std::size_t n = particles.n_owned;
  const auto vector = [&](const std::array<std::vector<double>, D>& columns) {
    out.components = 3;
    out.values.assign(3 * n, 0.0);
    for (std::size_t d = 0; d < D; ++d)
      for (std::size_t i = 0; i < n; ++i) out.values[3 * i + scene_axis<D>(d)] = columns[d][i];
  };
  const auto scalar = [&](const auto& value) {
    out.values.resize(n);
    for (std::size_t i = 0; i < n; ++i) out.values[i] = value(i);
  };
  if (name == "position") vector(particles.x);
  if (name == "velocity") vector(particles.u);
  if (name == "normal") vector(particles.normal);
  if (name == "shift") vector(particles.shift);
  if (name == "pressure") scalar([&](std::size_t i) { return particles.p[i]; });
  if (name == "density") scalar([&](std::size_t i) { return particles.rho[i]; });
  if (name == "volume") scalar([&](std::size_t i) { return particles.V[i]; });
  if (name == "zone") scalar([&](std::size_t i) { return static_cast<double>(particles.zone[i]); });
  if (name == "surface") scalar([&](std::size_t i) { return static_cast<double>(particles.surface[i]); });
  if (name == "id") scalar([&](std::size_t i) { return static_cast<double>(particles.id[i]); });
  return out;
}

support::CsvSeries series(const std::string& path, const std::vector<std::string>& columns,
                          const std::optional<RunState>& restart, const std::string& comment) {
  return restart ? support::CsvSeries::append_after(path, columns, restart->time, comment)
                 : support::CsvSeries(path, columns, comment);
}

/// Adds the wall time of its life to a sum.
struct Stopwatch {
  double& sum;
  double begin = support::Timers::now();
  ~Stopwatch() { sum += support::Timers::now() - begin; }
};

}  // namespace

template <int D>
Output<D>::Output(const std::string& folder, const RunConfig& config, const std::optional<RunState>& restart,
                  MpiRanks<D>* ranks, const Walls<D>* walls)
    : config_(config),
      ranks_(ranks),
      walls_(walls),
      gravity_(numerics_of<D>(config).gravity),
      last_fields_(restart ? restart->last_fields : 0.0) {
  if (ranks_ != nullptr && ranks_->rank() != 0) return;
  auto columns = scalar_columns(config.scene);
  const auto loads = body_columns(config.scene.bodies, D);
  columns.insert(columns.end(), loads.begin(), loads.end());
  scalars_.emplace(series(folder + "/scalars.csv", columns, restart,
                          "SI units; in 2-D per metre of width; seconds_: wall time so far"));
  fields_.emplace(folder, "particles", restart.has_value(), restart ? restart->time : 0.0);
  if (walls_ != nullptr) bodies_.emplace(folder, restart.has_value(), restart ? restart->time : 0.0);
  if (!config.sph.gauges.empty())
    gauges_.emplace(
        series(folder + "/gauges.csv", with_time(gauge_columns(config.sph.gauges, D)), restart, ""));
}

template <int D>
bool Output<D>::fields_due(double time) const {
  return support::due(last_fields_, time, config_.scene.time.field_interval);
}

template <int D>
void Output<D>::add_up(Totals& sum, LayerCount& layers) const {
  std::array<double, 7> parts = {sum.kinetic,
                                 sum.potential,
                                 sum.mass,
                                 static_cast<double>(sum.n),
                                 static_cast<double>(layers.blending),
                                 static_cast<double>(layers.driven),
                                 static_cast<double>(layers.unreached)};
  ranks_->take_sum(parts.data(), parts.size());
  ranks_->take_largest(&sum.speed, 1);
  sum.kinetic = parts[0], sum.potential = parts[1], sum.mass = parts[2];
  sum.n = static_cast<std::size_t>(parts[3]);
  layers = {static_cast<std::size_t>(parts[4]), static_cast<std::size_t>(parts[5]),
            static_cast<std::size_t>(parts[6])};
}

template <int D>
std::vector<double> Output<D>::gauge_row(const Particles<D>& particles,
                                         const NeighborList<D>& neighbors) const {
  const auto& gauges = config_.sph.gauges;
  if (gauges.empty()) return {};
  std::vector<double> sensed;
  if (walls_ != nullptr) sensed = walls_->sensed();
  if (ranks_ != nullptr && !sensed.empty()) ranks_->take_sum(sensed.data(), sensed.size());
  for (double& p : sensed) p += walls_->pressure_level();
  if (ranks_ == nullptr)
    return gauge_values(gauges, particles, neighbors, config_.sph.spacing, walls_, sensed);
  return gauge_values_on_root(gauges, particles, domain_of<D>(config_), neighbors, config_.sph.spacing,
                              ranks_->comm(), walls_, sensed);
}

template <int D>
void Output<D>::write_rows(const Moment& now, const Particles<D>& particles, const Dynamics<D>& dynamics,
                           const Layers<D>& layers) {
  const Stopwatch watch{seconds_};
  Totals sum = totals<D>(particles, gravity_, layers);
  LayerCount in_layers = now.layers;
  if (ranks_ != nullptr) add_up(sum, in_layers);
  auto gauges = gauge_row(particles, dynamics.neighbors());
  std::vector<double> loads;
  if (walls_ != nullptr) loads = body_values(walls_->loads(), D);
  if (ranks_ != nullptr && !loads.empty()) ranks_->take_sum(loads.data(), loads.size());
  if (!scalars_) return;
  const auto& ledger = now.ledger;
  std::vector<double> row = {now.time,
                             now.dt,
                             static_cast<double>(now.substeps),
                             sum.kinetic,
                             sum.potential,
                             sum.mass,
                             static_cast<double>(sum.n),
                             sum.speed,
                             ledger.mass_inside,
                             ledger.mass_on_faces,
                             ledger.mass_injected,
                             ledger.mass_removed,
                             ledger.mass_flux,
                             ledger.fv_mass_flux,
                             ledger.n_injected,
                             ledger.n_removed,
                             ledger.defect,
                             static_cast<double>(now.exchanged.removed_crossing),
                             static_cast<double>(now.exchanged.removed_nearest),
                             static_cast<double>(in_layers.blending),
                             static_cast<double>(in_layers.driven),
                             static_cast<double>(in_layers.unreached)};
  if (config_.scene.has_region()) {
    add_face_counts(row, now.exchanged.injected_through, D);
    add_face_counts(row, now.exchanged.removed_through, D);
  }
  for (std::size_t phase = 0; phase < k_phase_names.size(); ++phase) row.push_back(dynamics.seconds()[phase]);
  row.insert(row.end(), {seconds_, now.waited});
  row.insert(row.end(), loads.begin(), loads.end());
  scalars_->row(row);
  if (!gauges_) return;
  gauges.insert(gauges.begin(), now.time);
  gauges_->row(gauges);
}

template <int D>
void Output<D>::write_fields(double time, const Particles<D>& particles) {
  const Stopwatch watch{seconds_};
  if (ranks_ == nullptr) {
    write_points(time, particles);
  } else {
    const Particles<D> all = gather_on_root(particles, ranks_->comm());
    if (fields_) write_points(time, all);
  }
  if (bodies_) bodies_->write(time, *walls_);
  last_fields_ = time;
}

template <int D>
void Output<D>::write_points(double time, const Particles<D>& particles) {
  std::vector<support::OutputField> fields;
  for (const auto& name : config_.sph.fields) fields.push_back(field(name, particles));
  fields_->write_points(time, field<D>("position", particles).values, fields);
}

template class Output<2>;
template class Output<3>;

}  // namespace littoral::sph
