#include "io/fields.hpp"

#include <cmath>

#include "grid/loops.hpp"
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

}  // namespace

template <int D>
support::FieldSeries::Block field_block(const Block<D>& block, const State<D>& q,
                                        const DerivedFields& derived) {
  support::FieldSeries::Block out;
  out.name = block.name;
  support::OutputField velocity{"velocity", 3, {}}, pressure{"pressure", 1, {}},
      excess{"pressure_beyond_hydrostatic", 1, {}}, status{"status", 1, {}};
  double volume = 0.0;
  for_each_index<D>({}, block.extent.n, [&](const std::array<int, D>& index) {
    const auto c = static_cast<std::size_t>(block.extent.at(index));
    volume += block.volume[c];
    pressure.values.push_back(q.p[c]);
    excess.values.push_back(q.p[c] - block.reference_pressure[c]);
    status.values.push_back(static_cast<double>(block.status[c]));
    velocity.values.push_back(q.u[0][c]);
    velocity.values.push_back(D == 2 ? 0.0 : q.u[1][c]);
    velocity.values.push_back(q.u[D - 1][c]);
  });
  out.cell_fields = {std::move(velocity), std::move(pressure), std::move(excess), std::move(status)};
  add_derived<D>(block, q, derived, out);

  const double half = 0.5 * std::sqrt(volume / static_cast<double>(block.extent.cells()));
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

template support::FieldSeries::Block field_block<2>(const Block<2>&, const State<2>&, const DerivedFields&);
template support::FieldSeries::Block field_block<3>(const Block<3>&, const State<3>&, const DerivedFields&);

}  // namespace littoral::fv
