#pragma once

#include <random>

#include "dual_time/stepper.hpp"
#include "grids.hpp"
#include "implicit/multigrid_solver.hpp"
#include "overset/assembly.hpp"
#include "parallel/cut.hpp"
#include "parallel/whole.hpp"
#include "split_grids.hpp"

// Grids, and the same grids cut into pieces and dealt to ranks: whatever is computed must be the same.
namespace littoral::fv::test {

/// A grid as one process would have it.
template <int D>
struct WholeGrid {
  std::vector<Block<D>> blocks;
  OversetLinks<D> overset;
};

/// One rank's part of it.
template <int D>
struct PartGrid {
  std::vector<Block<D>> blocks;
  Exchange<D> exchange;
};

template <int D>
PartGrid<D> part_of_rank(const WholeGrid<D>& whole, const std::vector<Piece<D>>& pieces, const Ranks& ranks) {
  CutGrid<D> grid = cut<D>(whole.blocks, whole.overset, pieces, ranks);
  PartGrid<D> part;
  part.exchange = Exchange<D>(grid.blocks, grid.overset, grid.layout);
  for (const std::size_t b : grid.layout.owners.mine()) part.blocks.push_back(std::move(grid.blocks[b]));
  return part;
}

template <int D>
Window<D> wall_window() {
  Window<D> w;
  w.condition = Condition::wall;
  w.velocity[0] = [](const std::array<double, 3>&, double) { return 0.3; };
  return w;
}

/// Blocks joined in turned directions, periodic in the first, walls in the last.
template <int D>
WholeGrid<D> turned_blocks(unsigned seed) {
  std::array<bool, D> periodic{};
  periodic[0] = true;
  const auto close = [](int, int) { return wall_window<D>(); };
  if constexpr (D == 2)
    return {
        split_grid<2>({std::vector<int>{16, 16}, std::vector<int>{12, 20}}, periodic, wavy<2>, close, seed)
            .parts,
        {}};
  else
    return {split_grid<3>({std::vector<int>{16, 8}, std::vector<int>{8, 8}, std::vector<int>{12}}, periodic,
                          wavy<3>, close, seed)
                .parts,
            {}};
}

/// One block that closes on itself in all directions but the last.
template <int D>
WholeGrid<D> periodic_block() {
  std::array<bool, D> periodic;
  periodic.fill(true);
  periodic[D - 1] = false;
  const auto close = [](int, int) { return wall_window<D>(); };
  std::array<std::vector<int>, D> cells;
  for (std::size_t d = 0; d < D; ++d) cells[d] = {D == 2 ? 32 : 16};
  return {{split_grid<D>(cells, periodic, wavy<D>, close, 0).whole}, {}};
}

/// A ring about a cylinder over a box.
template <int D>
WholeGrid<D> ring_over_box() {
  const auto window = [](Block<D>& block, int direction, int side, Condition condition) {
    Window<D> w;
    w.name = name(condition);
    w.condition = condition;
    w.direction = direction;
    w.side = side;
    w.upper = block.extent.n;
    if (condition == Condition::far_field)
      w.velocity[0] = [](const std::array<double, 3>&, double) { return 1.0; };
    block.windows.push_back(w);
  };
  constexpr int k_around = 64, k_out = 12, k_box = 48, k_span = 8;
  std::array<int, D> cells{};
  std::array<bool, D> periodic{};
  cells[0] = k_around;
  cells[1] = k_out;
  periodic[0] = true;
  if (D == 3) cells[D - 1] = k_span, periodic[D - 1] = true;
  WholeGrid<D> grid;
  Block<D> ring = make_block<D>("ring", cells, periodic, [=](const std::array<int, D>& i) {
    const double r = 0.5 + 0.5 * i[1] / k_out, a = -2.0 * M_PI * i[0] / k_around;
    std::array<double, D> x{};
    if (D == 3) x[D - 1] = static_cast<double>(i[D - 1]) / k_span;
    x[0] = r * std::cos(a);
    x[1] = r * std::sin(a);
    return x;
  });
  cells[0] = cells[1] = k_box;
  periodic[0] = false;
  Block<D> box = make_block<D>("box", cells, periodic, [=](const std::array<int, D>& i) {
    std::array<double, D> x{};
    if (D == 3) x[D - 1] = static_cast<double>(i[D - 1]) / k_span;
    x[0] = 4.0 * i[0] / k_box - 2.0;
    x[1] = 4.0 * i[1] / k_box - 2.0;
    return x;
  });
  for (int side = 0; side < 2; ++side) {
    window(ring, 0, side, Condition::periodic);
    window(ring, 1, side, side == 0 ? Condition::wall : Condition::overset);
    window(box, 0, side, Condition::far_field);
    window(box, 1, side, Condition::far_field);
    for (Block<D>* block : {&ring, &box})
      if (D == 3) window(*block, 2, side, Condition::periodic);
  }
  grid.blocks = {box, ring};
  grid.overset = assemble_overset<D>(grid.blocks, {}).links;
  return grid;
}

template <int D>
Equations<D> thin_water() {
  Equations<D> e;
  e.fluid.density = 1.0;
  e.fluid.viscosity = 0.01;
  e.fluid.inverse_c2 = 1e-2;
  return e;
}

/// Anything but smooth, the same in the same place.
template <int D>
PointState<D> rough_flow(const std::array<double, D>& x, double) {
  PointState<D> s;
  s.p = std::sin(17.0 * x[0] + 5.0) * std::cos(23.0 * x[1]);
  for (std::size_t k = 0; k < D; ++k)
    s.u[k] = 0.5 + std::cos(13.0 * x[0] + 29.0 * x[D - 1] + 2.0 * static_cast<double>(k));
  return s;
}

template <int D>
PointState<D> smooth_flow(const std::array<double, D>& x, double) {
  PointState<D> s;
  for (std::size_t k = 0; k < D; ++k)
    s.u[k] = (k == 0 ? 1.0 : 0.2) + 0.1 * std::cos(2.0 * M_PI * (x[0] + x[D - 1]) + static_cast<double>(k));
  return s;
}

/// Residual of rough_flow in the blocks, as one step's first evaluation has it.
template <int D>
std::vector<Residual<D>> rough_residual(std::vector<Block<D>>& blocks, const Exchange<D>& exchange) {
  const Equations<D> equations = thin_water<D>();
  std::vector<State<D>> q(blocks.size());
  std::vector<History<D>> history(blocks.size());
  const std::vector<Forcing<D>> forcing(blocks.size());
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const std::size_t n = blocks[b].extent.size;
    set_reference_pressure(blocks[b], equations.fluid);
    evaluate_windows(blocks[b], equations, 0.0);
    q[b].resize(n);
    history[b].resize(n);
    for_each_index<D>({}, blocks[b].extent.n, [&](const std::array<int, D>& index) {
      const auto c = static_cast<std::size_t>(blocks[b].extent.at(index));
      std::array<double, D> x;
      for (std::size_t k = 0; k < D; ++k) x[k] = blocks[b].centre[k][c];
      const PointState<D> s = rough_flow<D>(x, 0.0);
      q[b].p[c] = s.p;
      for (std::size_t k = 0; k < D; ++k) q[b].u[k][c] = s.u[k];
    });
  }
  exchange.share_references(blocks);
  const StepProblem<D> problem{blocks,  exchange, equations, BackwardDifference::first_order(0.1),
                               history, forcing};
  std::vector<Residual<D>> r(blocks.size());
  problem.evaluate(q, r);
  return r;
}

/// Largest difference of a field of the parts and of the wholes, in solved cells of this rank.
/// part_field(own block), whole_field(block)
template <int D, class PartField, class WholeField>
double largest_difference(const PartGrid<D>& part, const std::vector<Block<D>>& whole, PartField&& part_field,
                          WholeField&& whole_field) {
  const Layout<D>& layout = part.exchange.layout();
  const std::vector<std::size_t> mine = layout.owners.mine();
  double worst = 0.0;
  for (std::size_t i = 0; i < mine.size(); ++i) {
    const auto& place = layout.part[mine[i]];
    const Extent<D>& extent = layout.shape[mine[i]].extent;
    const Field& one = part_field(i);
    const Field& other = whole_field(place.whole);
    for_each_index<D>({}, extent.n, [&](const std::array<int, D>& index) {
      std::array<int, D> there = index;
      for (std::size_t d = 0; d < D; ++d) there[d] += place.first[d];
      const auto c = static_cast<std::size_t>(whole[place.whole].extent.at(there));
      if (whole[place.whole].solved[c] == 0.0) return;
      worst = std::max(worst, std::abs(one[static_cast<std::size_t>(extent.at(index))] - other[c]));
    });
  }
  return worst;
}

/// Of the residuals in the parts and in the whole.
template <int D>
double residual_difference(WholeGrid<D> whole, const std::vector<Piece<D>>& pieces, const Ranks& ranks) {
  PartGrid<D> part = part_of_rank<D>(whole, pieces, ranks);
  const auto one = rough_residual<D>(part.blocks, part.exchange);
  const auto all = rough_residual<D>(whole.blocks, Exchange<D>(whole.blocks, whole.overset));
  double worst = largest_difference<D>(
      part, whole.blocks, [&](std::size_t i) -> const Field& { return one[i].mass; },
      [&](std::size_t w) -> const Field& { return all[w].mass; });
  for (std::size_t k = 0; k < D; ++k)
    worst = std::max(
        worst, largest_difference<D>(
                   part, whole.blocks, [&](std::size_t i) -> const Field& { return one[i].momentum[k]; },
                   [&](std::size_t w) -> const Field& { return all[w].momentum[k]; }));
  return worst;
}

template <int D>
std::vector<Piece<D>> dealt(const WholeGrid<D>& whole, int n_ranks) {
  return deal<D>(cut_planes<D>(whole.blocks, true), n_ranks);
}

}  // namespace littoral::fv::test
