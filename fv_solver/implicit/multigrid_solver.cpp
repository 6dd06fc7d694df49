#include "implicit/multigrid_solver.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "grid/loops.hpp"
#include "implicit/anderson.hpp"
#include "implicit/ordered_sum.hpp"
#include "littoral/error.hpp"

namespace littoral::fv {

namespace {

EdgeCondition edge_condition(Condition condition) {
  switch (condition) {
    case Condition::wall:
      return EdgeCondition::wall;
    case Condition::slip:
    case Condition::symmetry:
      return EdgeCondition::slip;
    case Condition::inflow:
      return EdgeCondition::inflow;
    case Condition::outflow:
      return EdgeCondition::outflow;
    case Condition::periodic:
    case Condition::join:
    case Condition::overset:
      return EdgeCondition::link;
    case Condition::far_field:
      return EdgeCondition::far_field;
    case Condition::convective:
    case Condition::state:
    case Condition::fringe:
      break;
  }
  return EdgeCondition::imposed;
}

}  // namespace

template <int D>
LevelGrid<D> level_grid(const Block<D>& block) {
  LevelGrid<D> grid(block.extent.n);
  grid.volume = block.volume;
  for (std::size_t d = 0; d < D; ++d) grid.area[d] = block.area[d];
  grid.status = block.status;
  grid.periodic = block.periodic;
  for (const Window<D>& window : block.windows) {
    const auto dir = static_cast<std::size_t>(window.direction);
    auto lower = window.lower, upper = window.upper;
    lower[dir] = 0;
    upper[dir] = 1;
    grid.far_speed = std::max(grid.far_speed, window.wave_speed);
    auto& edge = grid.edge[dir][static_cast<std::size_t>(window.side)];
    for_each_index<D>(lower, upper, [&](const std::array<int, D>& index) {
      edge[grid.face_index(window.direction, index)] = edge_condition(window.condition);
    });
  }
  return grid;
}

/// The hierarchy for one set of blocks and statuses, and the work arrays over their solved cells.
template <int D, class Real>
struct MultigridSolver<D, Real>::Levels {
  std::vector<LevelGrid<D>> grids;
  std::vector<std::vector<std::ptrdiff_t>> cells;  // solved cells of each block
  Multigrid<D, Real> multigrid;
  std::vector<Residual<D>> rows;
  std::vector<double> weights;  // 1/V for each unknown
  Anderson anderson;
  std::vector<Real> r, d;  // scaled, flat: cells of block 0, then of block 1, ...; D+1 values a cell
  Ranks ranks;
  double total_volume = 0.0;  // of all ranks

  Levels(const std::vector<Block<D>>& blocks, const Layout<D>& layout, const MultigridSolverOptions& options)
      : grids(all_grids(blocks)),
        multigrid(grids, options.multigrid, layout, level_overlap(blocks, layout)),
        anderson(0, {}),
        ranks(layout.owners.ranks) {
    for (const LevelGrid<D>& grid : grids) {
      cells.emplace_back();
      for_each_cell<D>(grid.extent, [&](const auto&, std::ptrdiff_t c) {
        if (!grid.solved(c)) return;
        cells.back().push_back(c);
        total_volume += grid.volume[static_cast<std::size_t>(c)];
        weights.insert(weights.end(), D + 1, 1.0 / grid.volume[static_cast<std::size_t>(c)]);
      });
    }
    for (auto* field : {&r, &d}) field->resize(weights.size());
    total_volume = ranks.sum(total_volume);
    anderson = Anderson(options.anderson_depth, weights, ranks);
    rows.resize(blocks.size());
  }

  static std::vector<LevelGrid<D>> all_grids(const std::vector<Block<D>>& blocks) {
    std::vector<LevelGrid<D>> all;
    for (const auto& block : blocks) all.push_back(level_grid(block));
    return all;
  }

  /// comm collective
  bool fits(const std::vector<Block<D>>& blocks) const {
    bool differs = blocks.size() != grids.size();
    for (std::size_t b = 0; b < blocks.size() && !differs; ++b)
      differs = blocks[b].status != grids[b].status || blocks[b].extent.n != grids[b].extent.n;
    return !ranks.any(differs);
  }

  /// body(block, offset of the cell, place of its first value in the flat arrays) for every solved cell.
  template <class Body>
  void for_each_solved(Body&& body) const {
    std::size_t begin = 0;
    for (std::size_t b = 0; b < cells.size(); ++b) {
      const auto n = static_cast<std::ptrdiff_t>(cells[b].size());
#pragma omp parallel for schedule(static) if (n > k_worth_threads)
      for (std::ptrdiff_t i = 0; i < n; ++i) {
        const auto k = static_cast<std::size_t>(i);
        body(b, static_cast<std::size_t>(cells[b][k]), begin + k * (D + 1));
      }
      begin += cells[b].size() * (D + 1);
    }
  }

  /// The residual, scaled as face_jacobian has it; the right side of the correction is -r.
  void collect(const CorrectionPhysics<D>& physics) {
    const double per_mass = physics.speeds.c0 / physics.fluid.density;
    const double per_momentum = 1.0 / physics.fluid.density;
    for_each_solved([&](std::size_t b, std::size_t c, std::size_t at) {
      auto& right = multigrid.right_side(b);
      for (std::size_t i = 0; i <= D; ++i) {
        const double row = i == 0 ? per_mass * rows[b].mass[c] : per_momentum * rows[b].momentum[i - 1][c];
        r[at + i] = static_cast<Real>(row);
        right.q[i][c] = static_cast<Real>(-row);
      }
    });
  }

  void read_correction() {
    for_each_solved([&](std::size_t b, std::size_t c, std::size_t at) {
      const auto& e = multigrid.correction(b);
      for (std::size_t i = 0; i <= D; ++i) d[at + i] = e.q[i][c];
    });
    if (!multigrid.floating()) return;
    const auto n = static_cast<std::ptrdiff_t>(d.size() / (D + 1));
    const auto sum =
        ordered_sums<1>(n, [&](std::ptrdiff_t begin, std::ptrdiff_t end, std::array<double, 1>& s) {
          for (auto k = static_cast<std::size_t>(begin); k < static_cast<std::size_t>(end); ++k)
            s[0] += static_cast<double>(d[k * (D + 1)]) / weights[k * (D + 1)];
        });
    const double mean = ranks.sum(sum[0]) / total_volume;  // the level of p is free: keep it where it was
    for (std::size_t k = 0; k < d.size(); k += D + 1) d[k] -= static_cast<Real>(mean);
  }

  void apply(std::vector<State<D>>& state, const CorrectionPhysics<D>& physics) const {
    const double p_unit = physics.fluid.density * physics.speeds.c0;
    for_each_solved([&](std::size_t b, std::size_t c, std::size_t at) {
      state[b].p[c] += p_unit * static_cast<double>(d[at]);
      for (std::size_t i = 0; i < D; ++i) state[b].u[i][c] += static_cast<double>(d[at + 1 + i]);
    });
  }

  /// The norm that round-off leaves of fields this large: no cycle gets below it.
  double round_off(const std::vector<Block<D>>& blocks, const std::vector<State<D>>& state,
                   const CorrectionPhysics<D>& physics) const {
    double p = 0.0, speed = physics.speeds.c0;
    for (std::size_t b = 0; b < cells.size(); ++b)
      for (const std::ptrdiff_t cell : cells[b]) {
        const auto c = static_cast<std::size_t>(cell);
        p = std::max(p, std::abs(state[b].p[c] - blocks[b].reference_pressure[c]));
        for (std::size_t k = 0; k < D; ++k) speed = std::max(speed, std::abs(state[b].u[k][c]));
      }
    return 8.0 * std::numeric_limits<double>::epsilon() *
           ranks.largest(speed + p / (physics.fluid.density * physics.speeds.c0));
  }

  /// comm collective
  [[noreturn]] void complain(const std::vector<Block<D>>& blocks, int cycle) const {
    ranks.together<StabilityError>([&] { name_cell(blocks, cycle); });
    throw StabilityError("the norm of the residual is not finite");
  }

  /// throws StabilityError where the residual of an own cell is not finite
  void name_cell(const std::vector<Block<D>>& blocks, int cycle) const {
    std::size_t at = 0;
    for (std::size_t b = 0; b < cells.size(); ++b)
      for (const std::ptrdiff_t cell : cells[b])
        for (std::size_t i = 0; i <= D; ++i)
          if (!std::isfinite(r[at++])) {
            throw StabilityError("block '" + blocks[b].name + "' cell " +
                                 cell_name<D>(blocks[b], grids[b].extent.index(cell)) +
                                 ": the residual is not finite after " + std::to_string(cycle) +
                                 " inner cycles; try a smaller time step");
          }
  }
};

template <int D, class Real>
MultigridSolver<D, Real>::MultigridSolver(const MultigridSolverOptions& options) : options_(options) {}
template <int D, class Real>
MultigridSolver<D, Real>::~MultigridSolver() = default;

template <int D, class Real>
StepReport MultigridSolver<D, Real>::solve(const StepProblem<D>& problem, const InnerTolerance& tolerance,
                                           std::vector<State<D>>& q) {
  if (!levels_ || !levels_->fits(problem.blocks))
    levels_ = std::make_unique<Levels>(problem.blocks, problem.exchange.layout(), options_);
  Levels& levels = *levels_;
  CorrectionPhysics<D> physics{problem.equations.fluid, problem.equations.speeds, problem.time};
  std::vector<const Field*> rates;
  for (const auto& forcing : problem.forcing) {
    rates.push_back(forcing.active() ? &forcing.rate : nullptr);
    physics.forcing_psi = std::max(physics.forcing_psi, forcing.psi);  // in damping zones an approximation
  }
  levels.anderson.forget();
  StepReport report;
  double round_off = 0.0;
  long water = -1;  // version of the surface for which the levels were built
  for (;; ++report.cycles) {
    problem.evaluate(q, levels.rows);
    problem.timed(StepPhases::residual, [&] { report.norms.push_back(problem.norm(levels.rows)); });
    problem.timed(StepPhases::mixing, [&] { levels.collect(physics); });
    if (!std::isfinite(report.norms.back())) levels.complain(problem.blocks, report.cycles);
    if (report.cycles == 0) round_off = levels.round_off(problem.blocks, q, physics);
    report.converged =
        tolerance.met(report.norms.back(), report.norms.front()) || report.norms.back() <= round_off;
    if (report.converged || report.cycles == tolerance.max_cycles) return report;
    // cells that turned to water or air have other rows, and what was mixed before is not theirs
    const long now = problem.surface != nullptr ? problem.surface->version() : 0;
    if (report.cycles == 0 || now != water) {
      std::vector<const State<D>*> frozen;
      for (const auto& state : q) frozen.push_back(&state);
      problem.timed(StepPhases::jacobian, [&] {
        levels.multigrid.build(frozen, physics, rates,
                               problem.surface != nullptr ? &problem.surface->phi() : nullptr);
      });
      levels.anderson.forget();
      water = now;
    }
    problem.timed(StepPhases::correction, [&] { levels.multigrid.cycle(); });
    problem.timed(StepPhases::mixing, [&] {
      levels.read_correction();
      levels.anderson.mix(levels.r, levels.d);
      levels.apply(q, physics);
    });
  }
}

template class MultigridSolver<2, float>;
template class MultigridSolver<3, float>;
template class MultigridSolver<2, double>;
template class MultigridSolver<3, double>;
template LevelGrid<2> level_grid(const Block<2>&);
template LevelGrid<3> level_grid(const Block<3>&);

}  // namespace littoral::fv
