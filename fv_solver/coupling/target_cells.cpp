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
  rate_ = before_ = now_;
  for (std::size_t b = 0; b < now_.size(); ++b) {
    take(stepper.state()[b], now_[b]);
    take(stepper.state()[b], before_[b]);
    take(rates(stepper, b), rate_[b]);
    known_.emplace_back(now_[b].cell.size(), std::uint8_t{1});
  }
  known_now_ = known_before_ = known_;
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
                                                 const coupler::Samples& samples, bool required) {
  std::vector<Imposed<D>> values = now_;
  const std::array<const Field*, 3> velocity{&samples.u, &samples.v, &samples.w};
  std::size_t i = 0;
  for (std::size_t b = 0; b < values.size(); ++b)
    for (std::size_t m = 0; m < values[b].cell.size(); ++m, ++i) {
      known_[b][m] = samples.status[i] == coupler::SampleStatus::ok;
      if (known_[b][m]) {
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
  const std::vector<Imposed<D>>& from = dt_before_ > 0.0 ? before_ : now_;
  const Mask& known_from = dt_before_ > 0.0 ? known_before_ : known_now_;
  const double span = dt + dt_before_;
  for (std::size_t b = 0; b < now_.size(); ++b) {
    const auto slope = [&, b](Field& rate, const Field& begin, const Field& end) {
      for (std::size_t i = 0; i < rate.size(); ++i)
        rate[i] = known_[b][i] && known_from[b][i] ? (end[i] - begin[i]) / span : 0.0;
    };
    slope(rate_[b].p, from[b].p, values[b].p);
    for (std::size_t k = 0; k < D; ++k) slope(rate_[b].u[k], from[b].u[k], values[b].u[k]);
  }
  before_ = std::move(now_);
  now_ = std::move(values);
  known_before_ = std::move(known_now_);
  known_now_ = known_;
  dt_before_ = dt;
}

template <int D>
void TargetCells<D>::save(support::CheckpointWriter& file) const {
  file.put("targets/dt_before", dt_before_);
  for (std::size_t b = 0; b < now_.size(); ++b) {
    const auto write = [&](const char* what, const Imposed<D>& values) {
      std::size_t i = 0;
      for_each_field<D>(values, [&](const Field& field) { file.put(key(what, b, i++), field); });
    };
    write("now", now_[b]);
    write("before", before_[b]);
    write("rate", rate_[b]);
    file.put(key("known", b, 0), known_now_[b]);
    file.put(key("known", b, 1), known_before_[b]);
  }
}

template <int D>
void TargetCells<D>::load(const support::CheckpointReader& file) {
  dt_before_ = file.number("targets/dt_before");
  for (std::size_t b = 0; b < now_.size(); ++b) {
    const auto read = [&](const char* what, Imposed<D>& values) {
      std::size_t i = 0;
      for_each_field<D>(values, [&](Field& field) {
        field = file.doubles(key(what, b, i++));
        if (field.size() != values.cell.size())
          throw IoError("the checkpoint has other fringe or forced cells than this run");
      });
    };
    read("now", now_[b]);
    read("before", before_[b]);
    read("rate", rate_[b]);
    known_[b] = known_now_[b] = file.bytes(key("known", b, 0));
    known_before_[b] = file.bytes(key("known", b, 1));
  }
}

template class TargetCells<2>;
template class TargetCells<3>;

}  // namespace littoral::fv
