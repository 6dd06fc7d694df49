#include "coupling/target_cells.hpp"

#include <cmath>
#include <cstdio>

#include "coupling/donors.hpp"
#include "grid/loops.hpp"
#include "grid/space.hpp"
#include "littoral/error.hpp"

namespace littoral::fv {
namespace {

/// Calls f(field) for p, the velocity components and, with a free surface, phi, in a fixed order.
template <int D, class F>
void for_each_field(Imposed<D>& values, bool with_phi, F&& f) {
  f(values.p);
  for (std::size_t k = 0; k < D; ++k) f(values.u[k]);
  if (with_phi) f(values.phi);
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
TargetCells<D>::TargetCells(const Stepper<D>& stepper, CellStatus status)
    : status_(status), with_phi_(stepper.surface() != nullptr), layout_(stepper.exchange().layout()) {
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
      targets_.wants.push_back(
          static_cast<std::uint8_t>(coupler::wants_state | (with_phi_ ? coupler::wants_phi : 0)));
    });
  }
  rate_ = before_ = now_;
  const std::vector<State<D>> rate = rates(stepper);
  for (std::size_t b = 0; b < now_.size(); ++b) {
    take(stepper.state()[b], now_[b]);
    take(stepper.state()[b], before_[b]);
    take(rate[b], rate_[b]);
    known_.emplace_back(now_[b].cell.size(), static_cast<std::uint8_t>(known_state | known_phi));
    if (!with_phi_) continue;
    for (const std::size_t c : now_[b].cell) now_[b].phi.push_back(stepper.surface()->phi()[b][c]);
    before_[b].phi = now_[b].phi;
    rate_[b].phi.assign(now_[b].phi.size(), 0.0);  // only the first prediction starts from it
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
    go_on(values[b].phi, rate_[b].phi);
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
      const bool ok = samples.status[i] == coupler::SampleStatus::ok;
      const bool water_or_air = with_phi_ && samples.status[i] != coupler::SampleStatus::uncovered;
      known_[b][m] = static_cast<std::uint8_t>((ok ? known_state : 0) | (water_or_air ? known_phi : 0));
      if (ok) {
        values[b].p[m] = samples.p[i];
        for (std::size_t k = 0; k < D; ++k) values[b].u[k][m] = (*velocity[axis_in_space<D>(k)])[i];
      }
      if (water_or_air) values[b].phi[m] = ok ? samples.phi[i] : std::abs(samples.phi[i]);
      if (ok || water_or_air || !required) continue;
      const auto index = blocks[b].extent.index(static_cast<std::ptrdiff_t>(values[b].cell[m]));
      char text[400];
      std::snprintf(
          text, sizeof text,
          "block '%s' cell %s at (%.6g, %.6g, %.6g) m takes its values from the particles, but they "
          "have %s there at t = %.9g s (coverage %.3f). Coupling I needs water in all fringe cells: move "
          "the region's face deeper, or use coupling.kind: forced",
          blocks[b].name.c_str(), cell_name<D>(blocks[b], index).c_str(), targets_.x[i], targets_.y[i],
          targets_.z[i],
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
    const auto slope = [&, b](Field& rate, const Field& begin, const Field& end, int bit) {
      for (std::size_t i = 0; i < rate.size(); ++i)
        rate[i] = (known_[b][i] & known_from[b][i] & bit) != 0 ? (end[i] - begin[i]) / span : 0.0;
    };
    slope(rate_[b].p, from[b].p, values[b].p, known_state);
    for (std::size_t k = 0; k < D; ++k) slope(rate_[b].u[k], from[b].u[k], values[b].u[k], known_state);
    slope(rate_[b].phi, from[b].phi, values[b].phi, known_phi);
  }
  before_ = std::move(now_);
  now_ = std::move(values);
  known_before_ = std::move(known_now_);
  known_now_ = known_;
  dt_before_ = dt;
}

namespace {

/// Cells of a whole block that take values, in its order; status: of all its cells, ghosts included
template <int D, class Status>
std::vector<std::size_t> cells_of(const Extent<D>& extent, const std::vector<Status>& status,
                                  CellStatus wanted) {
  std::vector<std::size_t> cells;
  for_each_index<D>({}, extent.n, [&](const std::array<int, D>& index) {
    const auto c = static_cast<std::size_t>(extent.at(index));
    if (static_cast<CellStatus>(static_cast<int>(status[c])) == wanted) cells.push_back(c);
  });
  return cells;
}

}  // namespace

template <int D>
void TargetCells<D>::save(StateWriter<D>& file) const {
  file.put("targets/dt_before", dt_before_);
  const auto gather = [&](auto&& value_of) {  // value_of(own block, m)
    std::vector<Field> own;
    const std::vector<std::size_t> mine = layout_.owners.mine();
    for (std::size_t i = 0; i < mine.size(); ++i) {
      own.emplace_back(layout_.shape[mine[i]].extent.size, 0.0);
      for (std::size_t m = 0; m < now_[i].cell.size(); ++m) own.back()[now_[i].cell[m]] = value_of(i, m);
    }
    std::vector<const Field*> fields;
    for (const Field& field : own) fields.push_back(&field);
    return gather_whole<D>(layout_, fields);
  };
  const std::vector<Field> is_one =
      gather([&](std::size_t, std::size_t) { return static_cast<double>(status_); });
  std::vector<std::vector<std::size_t>> cells;
  for (std::size_t w = 0; w < is_one.size(); ++w)
    cells.push_back(cells_of<D>(Extent<D>(layout_.whole[w].cells), is_one[w], status_));
  const auto write = [&](const char* what, std::size_t i, auto sample, const std::vector<Field>& whole) {
    for (std::size_t w = 0; w < whole.size(); ++w) {
      std::vector<decltype(sample)> values;
      for (const std::size_t c : cells[w]) values.push_back(static_cast<decltype(sample)>(whole[w][c]));
      file.file()->put(key(what, w, i), values);
    }
  };
  const auto write_all = [&](const char* what, const std::vector<Imposed<D>>& values) {
    write(what, 0, 0.0, gather([&](std::size_t i, std::size_t m) { return values[i].p[m]; }));
    for (std::size_t k = 0; k < D; ++k)
      write(what, k + 1, 0.0, gather([&](std::size_t i, std::size_t m) { return values[i].u[k][m]; }));
    if (with_phi_)
      write(what, D + 1, 0.0, gather([&](std::size_t i, std::size_t m) { return values[i].phi[m]; }));
  };
  write_all("now", now_);
  write_all("before", before_);
  write_all("rate", rate_);
  const auto write_mask = [&](std::size_t index, const Mask& mask) {
    write("known", index, std::uint8_t{0},
          gather([&](std::size_t i, std::size_t m) { return static_cast<double>(mask[i][m]); }));
  };
  write_mask(0, known_now_);
  write_mask(1, known_before_);
}

template <int D>
void TargetCells<D>::load(const support::CheckpointReader& file) {
  dt_before_ = file.number("targets/dt_before");
  const std::vector<std::size_t> mine = layout_.owners.mine();
  for (std::size_t i = 0; i < mine.size(); ++i) {
    const std::size_t w = layout_.part[mine[i]].whole;
    const Extent<D> whole(layout_.whole[w].cells);
    const std::vector<std::size_t> cells =
        cells_of<D>(whole, file.bytes(StateWriter<D>::key("", w, "status")), status_);
    const auto take = [&](const auto& values, auto&& put) {  // put(m, value)
      if (values.size() != cells.size())
        throw IoError("the checkpoint has other fringe or forced cells than this run");
      Field field(whole.size, 0.0);
      for (std::size_t n = 0; n < cells.size(); ++n) field[cells[n]] = static_cast<double>(values[n]);
      const Field part = part_of<D>(layout_, mine[i], field);
      for (std::size_t m = 0; m < now_[i].cell.size(); ++m) put(m, part[now_[i].cell[m]]);
    };
    const auto read = [&](const char* what, Imposed<D>& values) {
      std::size_t n = 0;
      for_each_field<D>(values, with_phi_, [&](Field& field) {
        take(file.doubles(key(what, w, n++)), [&](std::size_t m, double value) { field[m] = value; });
      });
    };
    read("now", now_[i]);
    read("before", before_[i]);
    read("rate", rate_[i]);
    const auto read_mask = [&](std::size_t n, std::vector<std::uint8_t>& mask) {
      take(file.bytes(key("known", w, n)),
           [&](std::size_t m, double value) { mask[m] = static_cast<std::uint8_t>(value); });
    };
    read_mask(0, known_now_[i]);
    known_[i] = known_now_[i];
    read_mask(1, known_before_[i]);
  }
}

template class TargetCells<2>;
template class TargetCells<3>;

}  // namespace littoral::fv
