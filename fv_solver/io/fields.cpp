#include "io/fields.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "grid/loops.hpp"
#include "grid/space.hpp"
#include "level_set/taylor.hpp"
#include "physics/velocity_gradient.hpp"

namespace littoral::fv {

namespace {

template <int D>
void add_derived(const Block<D>& block, const State<D>& q, const DerivedFields& derived,
                 support::FieldSeries::Block& out) {
  if (!derived.vorticity && !derived.q_criterion) return;
  support::OutputField curl{"vorticity", 3, {}}, q_field{"q_criterion", 1, {}};
  for_each_index<D>({}, block.extent.n, [&](const std::array<int, D>& index) {
    const VelocityGradient<D> gradient = velocity_gradient<D>(block, q, block.extent.at(index));
    if (derived.vorticity)
      for (const double component : vorticity<D>(gradient)) curl.values.push_back(component);
    if (derived.q_criterion) q_field.values.push_back(q_criterion<D>(gradient));
  });
  if (derived.vorticity) out.cell_fields.push_back(std::move(curl));
  if (derived.q_criterion) out.cell_fields.push_back(std::move(q_field));
}

template <int D>
void add_surface(const Block<D>& block, const Field& phi, const std::array<double, D>& up,
                 support::FieldSeries::Block& out) {
  support::OutputField level{"level_set", 1, {}}, elevation{"elevation", 1, {}};
  for_each_index<D>({}, block.extent.n, [&](const std::array<int, D>& index) {
    const std::ptrdiff_t c = block.extent.at(index);
    const auto i = static_cast<std::size_t>(c);
    level.values.push_back(phi[i]);
    double height = std::numeric_limits<double>::quiet_NaN();
    constexpr double k_cells = 2.0;
    if (block.status[i] != CellStatus::blanked &&
        std::abs(phi[i]) < k_cells * std::pow(block.volume[i], 1.0 / D)) {
      const SpaceVector<D> g = taylor<D>(block, phi, c).gradient;
      const double slope2 = dot(g, g);
      height = 0.0;
      for (std::size_t k = 0; k < D; ++k) height += (block.centre[k][i] - phi[i] * g[k] / slope2) * up[k];
    }
    elevation.values.push_back(height);
  });
  out.cell_fields.push_back(std::move(level));
  out.cell_fields.push_back(std::move(elevation));
}

}  // namespace

template <int D>
support::FieldSeries::Block field_block(const Block<D>& block, const State<D>& q,
                                        const DerivedFields& derived, double width, const Field* phi,
                                        const std::array<double, D>& up) {
  support::FieldSeries::Block out;
  out.name = block.name;
  support::OutputField velocity{"velocity", 3, {}}, pressure{"pressure", 1, {}},
      excess{"pressure_beyond_hydrostatic", 1, {}}, status{"status", 1, {}};
  for_each_index<D>({}, block.extent.n, [&](const std::array<int, D>& index) {
    const auto c = static_cast<std::size_t>(block.extent.at(index));
    pressure.values.push_back(q.p[c]);
    excess.values.push_back(q.p[c] - block.reference_pressure[c]);
    status.values.push_back(static_cast<double>(block.status[c]));
    velocity.values.push_back(q.u[0][c]);
    velocity.values.push_back(D == 2 ? 0.0 : q.u[1][c]);
    velocity.values.push_back(q.u[D - 1][c]);
  });
  out.cell_fields = {std::move(velocity), std::move(pressure), std::move(excess), std::move(status)};
  add_derived<D>(block, q, derived, out);
  if (phi != nullptr) add_surface<D>(block, *phi, up, out);

  const double half = 0.5 * width;
  if constexpr (D == 2) {
    out.cells = {block.extent.n[0], 1, block.extent.n[1]};
    for (int k = 0; k <= block.extent.n[1]; ++k)
      for (const double y : {-half, half})
        for (int i = 0; i <= block.extent.n[0]; ++i) {
          const auto n = static_cast<std::size_t>(block.node_extent.at({i, k}));
          out.nodes.insert(out.nodes.end(), {block.node[0][n], y, block.node[1][n]});
        }
  } else {
    out.cells = block.extent.n;
    for_each_index<D>({}, block.node_extent.n, [&](const std::array<int, D>& index) {
      const auto n = static_cast<std::size_t>(block.node_extent.at(index));
      for (std::size_t d = 0; d < D; ++d) out.nodes.push_back(block.node[d][n]);
    });
  }
  return out;
}

namespace {

using FieldBlock = support::FieldSeries::Block;

std::size_t count(const std::array<int, 3>& n, int more) {
  std::size_t product = 1;
  for (const int extent : n) product *= static_cast<std::size_t>(extent + more);
  return product;
}

/// Puts values of a part, interleaved by components, into those of the whole; `more`: 1 for nodes
void paste(const std::array<int, 3>& part, const std::array<int, 3>& first, const std::array<int, 3>& whole,
           int more, std::size_t components, const double*& from, std::vector<double>& to) {
  for (int k = 0; k < part[2] + more; ++k)
    for (int j = 0; j < part[1] + more; ++j) {
      const auto row = static_cast<std::size_t>(first[2] + k) * static_cast<std::size_t>(whole[1] + more) +
                       static_cast<std::size_t>(first[1] + j);
      const std::size_t at =
          components * (row * static_cast<std::size_t>(whole[0] + more) + static_cast<std::size_t>(first[0]));
      const std::size_t n = components * static_cast<std::size_t>(part[0] + more);
      std::copy(from, from + n, to.begin() + static_cast<std::ptrdiff_t>(at));
      from += n;
    }
}

template <int D>
std::array<int, 3> in_space(const std::array<int, D>& n, int thin) {
  std::array<int, 3> all{thin, thin, thin};
  for (std::size_t d = 0; d < D; ++d) all[axis_in_space<D>(d)] = n[d];
  return all;
}

}  // namespace

template <int D>
std::vector<FieldBlock> whole_field_blocks(const Stepper<D>& stepper, const DerivedFields& derived) {
  const Layout<D>& layout = stepper.exchange().layout();
  const Ranks& ranks = layout.owners.ranks;
  const std::vector<std::size_t> mine = layout.owners.mine();
  std::vector<FieldBlock> own;
  for (std::size_t i = 0; i < mine.size(); ++i)
    own.push_back(field_block<D>(stepper.blocks()[i], stepper.state()[i], derived,
                                 std::sqrt(layout.whole[layout.part[mine[i]].whole].mean_volume),
                                 stepper.surface() == nullptr ? nullptr : &stepper.surface()->phi()[i],
                                 against_gravity(stepper.equations().fluid)));
  if (!ranks.several()) return own;
  std::vector<std::vector<double>> out(static_cast<std::size_t>(ranks.size()));
  for (const FieldBlock& block : own) {
    out[0].insert(out[0].end(), block.nodes.begin(), block.nodes.end());
    for (const auto& field : block.cell_fields)
      out[0].insert(out[0].end(), field.values.begin(), field.values.end());
  }
  const std::vector<std::vector<double>> all = ranks.swap(out);
  std::vector<FieldBlock> wholes;
  if (!ranks.root()) return wholes;
  for (const auto& described : layout.whole) {
    FieldBlock whole;
    whole.name = described.name;
    whole.cells = in_space<D>(described.cells, 1);
    whole.nodes.resize(3 * count(whole.cells, 1));
    for (const auto& field : own.front().cell_fields) {
      const auto values = static_cast<std::size_t>(field.components) * count(whole.cells, 0);
      whole.cell_fields.push_back({field.name, field.components, std::vector<double>(values)});
    }
    wholes.push_back(std::move(whole));
  }
  std::vector<const double*> next;
  for (const auto& values : all) next.push_back(values.data());
  for (std::size_t b = 0; b < layout.size(); ++b) {
    const double*& from = next[static_cast<std::size_t>(layout.owners.rank[b])];
    FieldBlock& whole = wholes[layout.part[b].whole];
    const std::array<int, 3> part = in_space<D>(layout.shape[b].extent.n, 1),
                             first = in_space<D>(layout.part[b].first, 0);
    paste(part, first, whole.cells, 1, 3, from, whole.nodes);
    for (auto& field : whole.cell_fields)
      paste(part, first, whole.cells, 0, static_cast<std::size_t>(field.components), from, field.values);
  }
  return wholes;
}

template FieldBlock field_block<2>(const Block<2>&, const State<2>&, const DerivedFields&, double,
                                   const Field*, const std::array<double, 2>&);
template FieldBlock field_block<3>(const Block<3>&, const State<3>&, const DerivedFields&, double,
                                   const Field*, const std::array<double, 3>&);
template std::vector<FieldBlock> whole_field_blocks(const Stepper<2>&, const DerivedFields&);
template std::vector<FieldBlock> whole_field_blocks(const Stepper<3>&, const DerivedFields&);

}  // namespace littoral::fv
