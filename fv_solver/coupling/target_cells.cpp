#include "coupling/target_cells.hpp"

#include <cstdio>

#include "coupling/donors.hpp"
#include "grid/loops.hpp"
#include "grid/space.hpp"
#include "littoral/error.hpp"

namespace littoral::fv {
namespace {

/// Calls f(field) for p and the velocity components, in a fixed order.
template <int D, class Values, class F>
void for_each_field(Values& values, F&& f) {
  f(values.p);
  for (std::size_t k = 0; k < D; ++k) f(values.u[k]);
}

template <int D>
void take(const State<D>& q, Imposed<D>& values) {
  values.p.clear();
  for (const std::size_t c : values.cell) values.p.push_back(q.p[c]);
  for (std::size_t k = 0; k < D; ++k) {
    values.u[k].clear();
    for (const std::size_t c : values.cell) values.u[k].push_back(q.u[k][c]);
  }
}

std::string key(const char* what, std::size_t block, std::size_t field) {
  return "targets/block" + std::to_string(block) + "/" + what + std::to_string(field);
}

}  // namespace

template <int D>
TargetCells<D>::TargetCells(const Stepper<D>& stepper, CellStatus status) {
  now_.resize(stepper.blocks().size());
  for (std::size_t b = 0; b < stepper.blocks().size(); ++b) {
    const Block<D>& block = stepper.blocks()[b];
    for_each_index<D>({}, block.extent.n, [&](const std::array<int, D>& index) {
      const std::ptrdiff_t c = block.extent.at(index);
      if (block.status[static_cast<std::size_t>(c)] != status) return;
      now_[b].cell.push_back(static_cast<std::size_t>(c));
      const coupler::Vec3 x = centre_in_space(block, c);
      targets_.x.push_back(x[0]);
      targets_.y.push_back(x[1]);
      targets_.z.push_back(x[2]);
      targets_.wants.push_back(coupler::wants_state);
    });
  }
  rate_ = now_;
  for (std::size_t b = 0; b < now_.size(); ++b) {
    take(stepper.state()[b], now_[b]);
    take(rates(stepper, b), rate_[b]);
  }
}

template <int D>
std::vector<Imposed<D>> TargetCells<D>::extrapolated(double dt) const {
  std::vector<Imposed<D>> values = now_;
  for (std::size_t b = 0; b < values.size(); ++b) {
    const auto go_on = [dt](Field& value, const Field& rate) {
      for (std::size_t i = 0; i < value.size(); ++i) value[i] += dt * rate[i];
    };
    go_on(values[b].p, rate_[b].p);
    for (std::size_t k = 0; k < D; ++k) go_on(values[b].u[k], rate_[b].u[k]);
  }
  return values;
}

template <int D>
std::vector<Imposed<D>> TargetCells<D>::received(const std::vector<Block<D>>& blocks,
                                                 const coupler::Samples& samples, bool required) const {
  std::vector<Imposed<D>> values = now_;
  const std::array<const Field*, 3> velocity{&samples.u, &samples.v, &samples.w};
  std::size_t i = 0;
  for (std::size_t b = 0; b < values.size(); ++b)
    for (std::size_t m = 0; m < values[b].cell.size(); ++m, ++i) {
      if (samples.status[i] == coupler::SampleStatus::ok) {
        values[b].p[m] = samples.p[i];
        for (std::size_t k = 0; k < D; ++k) values[b].u[k][m] = (*velocity[axis_in_space<D>(k)])[i];
        continue;
      }
      if (!required) continue;  // keeps what it had
      const auto index = blocks[b].extent.index(static_cast<std::ptrdiff_t>(values[b].cell[m]));
      std::string cell;
      for (std::size_t d = 0; d < D; ++d) cell += (d > 0 ? "," : "") + std::to_string(index[d]);
      char text[400];
      std::snprintf(
          text, sizeof text,
          "block '%s' cell (%s) at (%.6g, %.6g, %.6g) m takes its values from the particles, but they "
          "have %s there at t = %.9g s (coverage %.3f). Coupling I needs water in all fringe cells: move "
          "the region's face deeper, or use coupling.kind: forced",
          blocks[b].name.c_str(), cell.c_str(), targets_.x[i], targets_.y[i], targets_.z[i],
          samples.status[i] == coupler::SampleStatus::dry ? "no water" : "no or too few particles",
          samples.time, samples.coverage[i]);
      throw CouplingError(text);
    }
  return values;
}

template <int D>
void TargetCells<D>::accept(std::vector<Imposed<D>> values, double dt) {
  for (std::size_t b = 0; b < now_.size(); ++b) {
    const auto slope = [dt](Field& rate, const Field& before, const Field& after) {
      for (std::size_t i = 0; i < rate.size(); ++i) rate[i] = (after[i] - before[i]) / dt;
    };
    slope(rate_[b].p, now_[b].p, values[b].p);
    for (std::size_t k = 0; k < D; ++k) slope(rate_[b].u[k], now_[b].u[k], values[b].u[k]);
  }
  now_ = std::move(values);
}

template <int D>
void TargetCells<D>::save(support::CheckpointWriter& file) const {
  for (std::size_t b = 0; b < now_.size(); ++b) {
    std::size_t i = 0, j = 0;
    for_each_field<D>(now_[b], [&](const Field& field) { file.put(key("value", b, i++), field); });
    for_each_field<D>(rate_[b], [&](const Field& field) { file.put(key("rate", b, j++), field); });
  }
}

template <int D>
void TargetCells<D>::load(const support::CheckpointReader& file) {
  for (std::size_t b = 0; b < now_.size(); ++b) {
    const auto read = [&](Field& field, const std::string& name) {
      const std::size_t n = field.size();
      field = file.doubles(name);
      if (field.size() != n) throw IoError(name + ": the checkpoint has other fringe cells than this run");
    };
    std::size_t i = 0, j = 0;
    for_each_field<D>(now_[b], [&](Field& field) { read(field, key("value", b, i++)); });
    for_each_field<D>(rate_[b], [&](Field& field) { read(field, key("rate", b, j++)); });
  }
}

template class TargetCells<2>;
template class TargetCells<3>;

}  // namespace littoral::fv
