#include "implicit/inner_solver.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "grid/loops.hpp"
#include "implicit/anderson.hpp"
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
      return EdgeCondition::link;
    case Condition::far_field:
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
    auto& edge = grid.edge[dir][static_cast<std::size_t>(window.side)];
    for_each_index<D>(lower, upper, [&](const std::array<int, D>& index) {
      edge[grid.face_index(window.direction, index)] = edge_condition(window.condition);
    });
  }
  return grid;
}

template <int D>
struct InnerSolver<D>::Impl {
  InnerOptions options;
  std::vector<LevelGrid<D>> grids;
  std::vector<std::vector<std::ptrdiff_t>> cells;  // solved cells of each block
  std::vector<std::string> names;
  Multigrid<D, float> multigrid;
  std::vector<Residual<D>> rows;
  std::vector<double> weights;  // 1/V for each unknown
  std::vector<double> q, r, d;  // flat: cells of block 0, then of block 1, ...; D+1 values a cell
  double total_volume = 0.0;
  double thinnest = 0.0;  // smallest cell thickness [m]
  bool floating = false;  // the level of p is free

  Impl(const std::vector<Block<D>>& blocks, const InnerOptions& given)
      : options(given), grids(all_grids(blocks)), multigrid(grids, given.multigrid) {
    thinnest = std::numeric_limits<double>::max();
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      names.push_back(blocks[b].name);
      cells.emplace_back();
      const LevelGrid<D>& grid = grids[b];
      for_each_cell<D>(grid.extent, [&](const auto&, std::ptrdiff_t c) {
        if (!grid.solved(c)) return;
        cells[b].push_back(c);
        const double volume = grid.volume[static_cast<std::size_t>(c)];
        total_volume += volume;
        for (std::size_t i = 0; i <= D; ++i) weights.push_back(1.0 / volume);
        for (std::size_t e = 0; e < D; ++e) {
          double s2 = 0.0;
          for (std::size_t k = 0; k < D; ++k) {
            const double a = grid.area[e][k][static_cast<std::size_t>(c)];
            s2 += a * a;
          }
          if (s2 > 0.0) thinnest = std::min(thinnest, volume / std::sqrt(s2));
        }
      });
    }
    for (auto* field : {&q, &r, &d}) field->resize(weights.size());
    rows.resize(blocks.size());
  }

  static std::vector<LevelGrid<D>> all_grids(const std::vector<Block<D>>& blocks) {
    std::vector<LevelGrid<D>> all;
    for (const auto& block : blocks) all.push_back(level_grid(block));
    return all;
  }

  /// Scaled unknowns and residual as flat arrays; the multigrid's right side is -r.
  double collect(const std::vector<State<D>>& state, const CorrectionPhysics<D>& physics) {
    const double per_p = 1.0 / (physics.fluid.density * physics.speeds.c0);
    const double per_mass = physics.speeds.c0 / physics.fluid.density;
    const double per_momentum = 1.0 / physics.fluid.density;
    double sum = 0.0;
    std::size_t at = 0;
    for (std::size_t b = 0; b < cells.size(); ++b) {
      auto& right = multigrid.right_side(b);
      for (const std::ptrdiff_t cell : cells[b]) {
        const auto c = static_cast<std::size_t>(cell);
        double local = 0.0;
        for (std::size_t i = 0; i <= D; ++i, ++at) {
          q[at] = i == 0 ? per_p * state[b].p[c] : state[b].u[i - 1][c];
          r[at] = i == 0 ? per_mass * rows[b].mass[c] : per_momentum * rows[b].momentum[i - 1][c];
          right.q[i][c] = static_cast<float>(-r[at]);
          local += weights[at] * r[at] * r[at];
        }
        if (!std::isfinite(local)) throw StabilityError(place(b, cell) + ": the residual is not finite");
        sum += local;
      }
    }
    return std::sqrt(sum / std::max(total_volume, 1e-300));
  }

  std::string place(std::size_t block, std::ptrdiff_t cell) const {
    const std::array<int, D> index = grids[block].extent.index(cell);
    std::string text = "block " + names[block] + " cell (";
    for (std::size_t d_ = 0; d_ < D; ++d_) text += (d_ ? "," : "") + std::to_string(index[d_]);
    return text + ")";
  }

  void read_correction() {
    std::size_t at = 0;
    double mean = 0.0;
    for (std::size_t b = 0; b < cells.size(); ++b) {
      const auto& e = multigrid.correction(b);
      for (const std::ptrdiff_t cell : cells[b]) {
        const auto c = static_cast<std::size_t>(cell);
        mean += static_cast<double>(e.q[0][c]) / weights[at];
        for (std::size_t i = 0; i <= D; ++i) d[at++] = static_cast<double>(e.q[i][c]);
      }
    }
    if (!floating) return;
    mean /= total_volume;  // the level of p is free: keep it where it was
    for (std::size_t k = 0; k < d.size(); k += D + 1) d[k] -= mean;
  }

  void apply(std::vector<State<D>>& state, const CorrectionPhysics<D>& physics) const {
    const double p_unit = physics.fluid.density * physics.speeds.c0;
    std::size_t at = 0;
    for (std::size_t b = 0; b < cells.size(); ++b)
      for (const std::ptrdiff_t cell : cells[b]) {
        const auto c = static_cast<std::size_t>(cell);
        state[b].p[c] += p_unit * d[at++];
        for (std::size_t i = 0; i < D; ++i) state[b].u[i][c] += d[at++];
      }
  }

  /// What round-off leaves of the residual of fields this large.
  double round_off(const std::vector<State<D>>& state, const CorrectionPhysics<D>& physics) const {
    double p = 0.0;
    for (std::size_t b = 0; b < cells.size(); ++b)
      for (const std::ptrdiff_t c : cells[b])
        p = std::max(p, std::abs(state[b].p[static_cast<std::size_t>(c)] - physics.fluid.reference_pressure));
    const double c0 = physics.speeds.c0;
    return 4.0 * std::numeric_limits<double>::epsilon() * (c0 * c0 + p / physics.fluid.density) / thinnest;
  }
};

template <int D>
InnerSolver<D>::InnerSolver(const std::vector<Block<D>>& blocks, const InnerOptions& options)
    : impl_(std::make_unique<Impl>(blocks, options)) {}
template <int D>
InnerSolver<D>::~InnerSolver() = default;

template <int D>
InnerReport InnerSolver<D>::solve(const Evaluate& evaluate, std::vector<State<D>>& q,
                                  const CorrectionPhysics<D>& physics,
                                  const std::vector<Forcing<D>>& forcing) {
  Impl& s = *impl_;
  s.floating = s.multigrid.closed() && physics.fluid.inverse_c2 == 0.0;
  InnerReport report;
  Anderson anderson(s.options.anderson_depth, s.weights);
  double goal = 0.0;
  for (;; ++report.cycles) {
    evaluate(q, s.rows);
    report.norms.push_back(s.collect(q, physics));
    if (report.cycles == 0)
      goal = std::max({s.options.drop * report.norms[0], s.options.absolute, s.round_off(q, physics)});
    report.converged = report.norms.back() <= goal;
    if (report.converged || report.cycles == s.options.max_cycles) return report;
    if (report.cycles == 0) {
      std::vector<const State<D>*> frozen;
      for (const auto& state : q) frozen.push_back(&state);
      std::vector<const Field*> rates;
      for (const auto& f : forcing) rates.push_back(f.active() ? &f.rate : nullptr);
      s.multigrid.build(frozen, physics, rates);
    }
    s.multigrid.cycle();
    s.read_correction();
    anderson.mix(s.q, s.r, s.d);
    s.apply(q, physics);
  }
}

template class InnerSolver<2>;
template class InnerSolver<3>;
template LevelGrid<2> level_grid(const Block<2>&);
template LevelGrid<3> level_grid(const Block<3>&);

}  // namespace littoral::fv
