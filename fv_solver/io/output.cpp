#include "io/output.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "io/checkpoint.hpp"
#include "io/fields.hpp"
#include "littoral/error.hpp"
#include "littoral/support/due.hpp"
#include "physics/wall_loads.hpp"

namespace littoral::fv {
namespace {

const char* const k_axes[] = {"x", "y", "z"};

/// Names the user gave to walls: those worth a column.
template <int D>
std::vector<std::string> named_walls(const FvConfig& config, const std::vector<Block<D>>& blocks,
                                     const Ranks& ranks) {
  std::vector<std::string> walls;
  for (const std::string& name : config.face_names()) {
    bool solid = false;
    for (const Block<D>& block : blocks)
      for (const Window<D>& w : block.windows)
        solid =
            solid || (w.name == name && (w.condition == Condition::wall || w.condition == Condition::slip));
    if (ranks.any(solid) && std::find(walls.begin(), walls.end(), name) == walls.end()) walls.push_back(name);
  }
  return walls;
}

support::CsvSeries series(const std::string& path, const std::vector<std::string>& columns,
                          const std::string& units, bool restarted, double time) {
  if (restarted) return support::CsvSeries::append_after(path, columns, time, units);
  return {path, columns, units};
}

}  // namespace

template <int D>
Integrals integrate_all(const Stepper<D>& stepper, const std::vector<coupler::Box>& regions) {
  Integrals sum;
  for (std::size_t b = 0; b < stepper.blocks().size(); ++b) {
    const Block<D>& block = stepper.blocks()[b];
    const Field* phi = stepper.surface() != nullptr ? &stepper.surface()->phi()[b] : nullptr;
    Field wet;
    if (phi != nullptr) wet_shares<D>(block, *phi, wet);
    const Field share = outside_share<D>(block, regions, phi != nullptr ? &wet : nullptr);
    const Integrals part = integrate<D>(block, stepper.equations().fluid, stepper.state()[b], share, phi);
    sum.mass += part.mass;
    sum.kinetic_energy += part.kinetic_energy;
    sum.potential_energy += part.potential_energy;
  }
  std::array<double, 3> total{sum.mass, sum.kinetic_energy, sum.potential_energy};
  stepper.exchange().ranks().sum(total);
  return {total[0], total[1], total[2]};
}

template <int D>
Output<D>::Output(const std::string& folder, const FvConfig& config, const support::Scene& scene,
                  const Stepper<D>& stepper, const support::Timers& timers, bool restarted)
    : folder_(folder),
      ranks_(stepper.exchange().ranks()),
      scene_(scene),
      options_(config.output),
      timers_(timers),
      gauges_(config.gauges, stepper),
      walls_(named_walls<D>(config, stepper.blocks(), ranks_)) {
  if (scene.has_region())
    for (const auto& region : scene.regions) regions_.push_back({region.lower, region.upper});
  if (restarted) fields_written_at_ = stepper.time();
  if (!ranks_.root()) return;
  std::vector<std::string> columns = {"time", "dt", "cycles", "drop", "kinetic_energy", "potential_energy",
                                      "mass"};
  if (stepper.surface() != nullptr)
    for (const char* name : {"water_volume", "volume_error", "surface_cfl", "thin_water_cells"})
      columns.emplace_back(name);
  for (const auto& wall : walls_)
    for (const char* part : {".f", ".dynamic_f"})
      for (std::size_t a = 0; a < 3; ++a)
        if (D == 3 || a != 1) columns.push_back(wall + part + k_axes[a]);
  for (const auto& table : {timers.table(), stepper.phases().table()})
    for (const auto& phase : table) columns.push_back("seconds_" + phase.first);
  columns.push_back("seconds_wait");
  scalars_.emplace(series(folder + "/scalars.csv", columns,
                          D == 2 ? "SI; per metre of width; seconds_*: wall time since the start"
                                 : "SI; seconds_*: wall time since the start",
                          restarted, stepper.time()));
  if (!gauges_.empty()) {
    std::vector<std::string> names = gauges_.columns();
    names.insert(names.begin(), "time");
    gauge_rows_.emplace(series(folder + "/gauges.csv", names, D == 2 ? "SI; forces per metre of width" : "SI",
                               restarted, stepper.time()));
  }
  if (options_.fields) fields_.emplace(folder, "fields", restarted, stepper.time());
}

template <int D>
void Output<D>::row(const Stepper<D>& stepper, const StepReport& report, double waited) {
  integrals_ = integrate_all<D>(stepper, regions_);
  std::vector<double> values = {stepper.time(), stepper.last_dt(),         static_cast<double>(report.cycles),
                                report.drop(),  integrals_.kinetic_energy, integrals_.potential_energy,
                                integrals_.mass};
  if (const FreeSurface<D>* surface = stepper.surface()) {
    values.push_back(surface->budget().volume);
    values.push_back(surface->budget().error);
    values.push_back(surface->rate() * stepper.last_dt());
    values.push_back(surface->thin_water().cells);
  }
  for (const auto& wall : walls_) {
    const WallLoads loads =
        wall_loads<D>(stepper.blocks(), stepper.equations(), stepper.state(), wall, {}, ranks_,
                      stepper.surface() != nullptr ? &stepper.surface()->phi() : nullptr);
    for (const Load& load : {loads.total(), loads.dynamic()})
      for (std::size_t a = 0; a < 3; ++a)
        if (D == 3 || a != 1) values.push_back(load.force[a]);
  }
  for (const auto& table : {timers_.table(), stepper.phases().table()})
    for (const auto& phase : table) values.push_back(phase.second);
  values.push_back(waited);
  std::vector<double> seen = gauges_.values(stepper);
  seen.insert(seen.begin(), stepper.time());
  if (scalars_) scalars_->row(values);
  if (gauge_rows_) gauge_rows_->row(seen);
}

template <int D>
void Output<D>::fields(const Stepper<D>& stepper) {
  if (!options_.fields || fields_written_at_ == stepper.time()) return;
  const auto blocks = whole_field_blocks<D>(stepper, DerivedFields{options_.vorticity, options_.q_criterion});
  if (fields_) fields_->write_blocks(stepper.time(), blocks);
  fields_written_at_ = stepper.time();
}

template <int D>
void Output<D>::first(const Stepper<D>& stepper, double waited) {
  row(stepper, StepReport{}, waited);
  fields(stepper);
}

template <int D>
void Output<D>::after(const coupler::Agreement& agreement, const Stepper<D>& stepper,
                      const StepReport& report, double waited) {
  // counted from the start, so that a continued run writes the rows it would have written
  const bool row_due = (agreement.window.index + 1) % options_.scalars_every == 0;
  if (row_due || agreement.write) row(stepper, report, waited);
  if (agreement.write) fields(stepper);
}

template <int D>
void Output<D>::last(const Stepper<D>& stepper) {
  fields(stepper);
}

template <int D>
bool Output<D>::fields_due(double time) const {
  return options_.fields && support::due(fields_written_at_, time, scene_.time.field_interval);
}

template Integrals integrate_all<2>(const Stepper<2>&, const std::vector<coupler::Box>&);
template Integrals integrate_all<3>(const Stepper<3>&, const std::vector<coupler::Box>&);
template class Output<2>;
template class Output<3>;

}  // namespace littoral::fv
