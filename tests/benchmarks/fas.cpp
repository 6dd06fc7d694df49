#include "fas.hpp"

#include <algorithm>
#include <cmath>

#include "boundary/ghosts.hpp"
#include "grid/loops.hpp"
#include "grid/metrics.hpp"
#include "implicit/multigrid_solver.hpp"
#include "littoral/error.hpp"

namespace littoral::fv {
namespace {

using Float = Correction<2, float>;
using Double = Correction<2, double>;

/// The block of every second node, with the same windows.
Block<2> every_second_node(const Block<2>& fine) {
  std::array<int, 2> cells;
  for (std::size_t d = 0; d < 2; ++d) cells[d] = fine.extent.n[d] / 2;
  Block<2> coarse = make_block<2>(fine.name, cells, fine.periodic, [&](const std::array<int, 2>& index) {
    const auto n = static_cast<std::size_t>(fine.node_extent.at({2 * index[0], 2 * index[1]}));
    return std::array<double, 2>{fine.node[0][n], fine.node[1][n]};
  });
  coarse.face_names = fine.face_names;
  for (Window<2> w : fine.windows) {
    for (std::size_t d = 0; d < 2; ++d) {
      w.lower[d] /= 2;
      w.upper[d] /= 2;
    }
    coarse.windows.push_back(std::move(w));
  }
  return coarse;
}

bool halves(const std::vector<Block<2>>& blocks) {
  constexpr int k_fewest = 8;
  for (const Block<2>& block : blocks)
    for (const int n : block.extent.n)
      if (n % 2 != 0 || n < k_fewest) return false;
  return true;
}

}  // namespace

struct FasSolver::Level {
  std::vector<Block<2>> own;  // of a coarse level
  std::vector<Block<2>>* blocks = nullptr;
  Exchange<2> own_exchange;
  std::vector<History<2>> none;
  std::vector<Forcing<2>> unforced;
  std::unique_ptr<StepProblem<2>> problem;

  std::vector<LevelGrid<2>> grids;
  std::vector<std::vector<LineOperator<2, float>>> operators;  // [block]
  std::vector<std::unique_ptr<Transfer<2>>> transfer;          // to the next level
  std::vector<State<2>> q, start;
  std::vector<Residual<2>> rows;
  std::vector<Double> r, aim;  // scaled residual less its aim
  std::vector<Float> b, e, kept, other;
  double per_mass = 1.0, per_momentum = 1.0, p_unit = 1.0;

  void prepare(Relaxation relaxation) {
    for (const Block<2>& block : *blocks) {
      grids.push_back(level_grid(block));
      operators.emplace_back();
      std::vector<int> directions = stiff_directions(grids.back());
      if (relaxation == Relaxation::adi) directions = {1 - directions[0], directions[0]};
      for (const int d : directions) operators.back().emplace_back(grids.back(), d);
      for (auto* all : {&r, &aim}) all->emplace_back().assign_zero(block.extent.size);
      for (auto* all : {&b, &e, &kept, &other}) all->emplace_back().assign_zero(block.extent.size);
    }
  }
  template <class Body>
  void each_solved(Body&& body) {
    for (std::size_t i = 0; i < grids.size(); ++i)
      for_each_cell<2>(grids[i].extent, [&](const auto&, std::ptrdiff_t c) {
        if (grids[i].solved(c)) body(i, static_cast<std::size_t>(c));
      });
  }
  double norm_after_evaluation() {
    problem->evaluate(q, rows);
    each_solved([&](std::size_t i, std::size_t c) {
      r[i].q[0][c] = per_mass * rows[i].mass[c] - aim[i].q[0][c];
      for (std::size_t k = 0; k < 2; ++k)
        r[i].q[k + 1][c] = per_momentum * rows[i].momentum[k][c] - aim[i].q[k + 1][c];
    });
    return problem->norm(rows);
  }
  void add(std::size_t i, std::size_t c, double p, double u, double w) {
    q[i].p[c] += p_unit * p;
    q[i].u[0][c] += u;
    q[i].u[1][c] += w;
  }
};

FasSolver::FasSolver(const FasOptions& options, const OversetOptions& overset)
    : options_(options), overset_(overset) {}
FasSolver::~FasSolver() = default;
int FasSolver::n_levels() const { return static_cast<int>(levels_.size()); }

void FasSolver::set_levels(const StepProblem<2>& problem) {
  levels_.push_back(std::make_unique<Level>());
  levels_[0]->blocks = &problem.blocks;
  levels_[0]->prepare(options_.relaxation);
  while (static_cast<int>(levels_.size()) < options_.max_levels && halves(*levels_.back()->blocks)) {
    Level& fine = *levels_.back();
    auto next = std::make_unique<Level>();
    for (const Block<2>& block : *fine.blocks) next->own.push_back(every_second_node(block));
    next->blocks = &next->own;
    OversetAssembly<2> overlap;
    try {
      overlap = assemble_overset<2>(next->own, overset_);
    } catch (const ConfigError&) {  // so coarse that a cell finds no donor
      break;
    }
    next->own_exchange = Exchange<2>(next->own, overlap.links);
    for (Block<2>& block : next->own) set_reference_pressure(block, problem.equations.fluid);
    next->own_exchange.share_references(next->own);
    for (std::size_t i = 0; i < next->own.size(); ++i) {  // what lies in the finer grid's hole stays as it is
      Block<2>& coarse = next->own[i];
      for_each_index<2>({}, coarse.extent.n, [&](const std::array<int, 2>& index) {
        bool known = false;
        for (const int a : {0, 1})
          for (const int b : {0, 1}) {
            const Block<2>& above = (*fine.blocks)[i];
            const auto child =
                static_cast<std::size_t>(above.extent.at({2 * index[0] + a, 2 * index[1] + b}));
            known = known || above.solved[child] != 0.0;
          }
        CellStatus& status = coarse.status[static_cast<std::size_t>(coarse.extent.at(index))];
        if (!known && status == CellStatus::computed) status = CellStatus::fringe;
      });
      set_solved_mask(coarse);
      next->none.emplace_back().resize(coarse.extent.size);
      next->q.emplace_back().resize(coarse.extent.size);
    }
    next->unforced.resize(next->own.size());
    next->prepare(options_.relaxation);
    for (std::size_t i = 0; i < next->own.size(); ++i)
      fine.transfer.push_back(
          std::make_unique<Transfer<2>>(fine.grids[i], next->grids[i], std::array<int, 2>{2, 2}));
    levels_.push_back(std::move(next));
  }
}

void FasSolver::relax(Level& level, bool forward) {
  level.each_solved([&](std::size_t i, std::size_t c) {
    for (std::size_t k = 0; k < 3; ++k) level.b[i].q[k][c] = static_cast<float>(-level.r[i].q[k][c]);
  });
  for (std::size_t i = 0; i < level.grids.size(); ++i) {
    const auto& operators = level.operators[i];
    Float& e = level.e[i];
    e.assign_zero(level.grids[i].extent.size);
    if (options_.relaxation == Relaxation::lines) {
      for (std::size_t n = 0; n < operators.size(); ++n) {
        const auto& op = operators[forward ? n : operators.size() - 1 - n];
        const int colours = op.layout().n_colours();
        for (int colour = 0; colour < colours; ++colour) {
          op.smooth(forward ? colour : colours - 1 - colour, level.b[i], e);
          for (auto& field : e.q) fill_periodic(level.grids[i], field);
        }
      }
      continue;
    }
    for (int colour = 0; colour < operators[0].layout().n_colours(); ++colour)
      operators[0].smooth(colour, level.b[i], e, true);
    for (auto& field : e.q) fill_periodic(level.grids[i], field);
    // D e = b - O_2 e, so what is left is the second direction's lines, all with these neighbours
    level.kept[i] = e;
    Float sum = e;
    for (int colour = 0; colour < operators[1].layout().n_colours(); ++colour) {
      level.other[i] = level.kept[i];
      operators[1].smooth(colour, level.b[i], level.other[i]);
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t c = 0; c < sum.q[k].size(); ++c)
          sum.q[k][c] += level.other[i].q[k][c] - level.kept[i].q[k][c];
    }
    e = std::move(sum);
  }
  level.each_solved([&](std::size_t i, std::size_t c) {
    level.add(i, c, static_cast<double>(level.e[i].q[0][c]), static_cast<double>(level.e[i].q[1][c]),
              static_cast<double>(level.e[i].q[2][c]));
  });
}

void FasSolver::cycle(std::size_t l, const StepProblem<2>& problem, bool residual_is_current) {
  Level& level = *levels_[l];
  const bool last = l + 1 == levels_.size();
  const int sweeps = last && l > 0 ? options_.coarsest : options_.pre;
  for (int s = 0; s < sweeps; ++s) {
    if (s > 0 || !residual_is_current) level.norm_after_evaluation();
    relax(level, true);
  }
  if (last) return;
  Level& next = *levels_[l + 1];
  level.norm_after_evaluation();
  for (std::size_t i = 0; i < level.grids.size(); ++i) {
    average_state<2>(level.grids[i], {2, 2}, level.q[i], next.grids[i], next.q[i]);
    for (std::size_t k = 0; k < 3; ++k)
      std::copy(level.r[i].q[k].begin(), level.r[i].q[k].end(), level.kept[i].q[k].begin());
    fill_correction_ghosts(level.grids[i], level.kept[i]);
    level.transfer[i]->restrict_residual(level.kept[i], next.b[i]);
    next.aim[i].assign_zero(next.grids[i].extent.size);
  }
  next.norm_after_evaluation();
  next.start = next.q;
  next.each_solved([&](std::size_t i, std::size_t c) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double asked = static_cast<double>(next.b[i].q[k][c]);
      next.aim[i].q[k][c] = next.r[i].q[k][c] - asked;
      next.r[i].q[k][c] = asked;
    }
  });
  cycle(l + 1, problem, true);
  next.problem->exchange.states(*next.blocks, next.q);
  for (std::size_t i = 0; i < level.grids.size(); ++i) {
    for_each_cell<2>(next.grids[i].extent, [&](const auto&, std::ptrdiff_t cell) {
      const auto c = static_cast<std::size_t>(cell);
      next.e[i].q[0][c] = static_cast<float>((next.q[i].p[c] - next.start[i].p[c]) / next.p_unit);
      for (std::size_t k = 0; k < 2; ++k)
        next.e[i].q[k + 1][c] = static_cast<float>(next.q[i].u[k][c] - next.start[i].u[k][c]);
    });
    fill_correction_ghosts(next.grids[i], next.e[i]);
    level.e[i].assign_zero(level.grids[i].extent.size);
    level.transfer[i]->add_prolonged(next.e[i], level.e[i]);
  }
  level.each_solved([&](std::size_t i, std::size_t c) {
    level.add(i, c, static_cast<double>(level.e[i].q[0][c]), static_cast<double>(level.e[i].q[1][c]),
              static_cast<double>(level.e[i].q[2][c]));
  });
  for (int s = 0; s < options_.post; ++s) {
    level.norm_after_evaluation();
    relax(level, false);
  }
}

StepReport FasSolver::solve(const StepProblem<2>& problem, const InnerTolerance& tolerance,
                            std::vector<State<2>>& q) {
  if (levels_.empty()) set_levels(problem);
  CorrectionPhysics<2> physics{problem.equations.fluid, problem.equations.speeds, problem.time};
  physics.jump = options_.jump;
  Level& finest = *levels_[0];
  finest.q = q;
  finest.problem = std::make_unique<StepProblem<2>>(problem);
  for (std::size_t l = 0; l < levels_.size(); ++l) {
    Level& level = *levels_[l];
    level.per_mass = physics.speeds.c0 / physics.fluid.density;
    level.per_momentum = 1.0 / physics.fluid.density;
    level.p_unit = physics.fluid.density * physics.speeds.c0;
    if (l > 0) {
      for (std::size_t i = 0; i < level.own.size(); ++i) {
        average_state<2>(levels_[l - 1]->grids[i], {2, 2}, levels_[l - 1]->q[i], level.grids[i], level.q[i]);
        evaluate_windows(level.own[i], problem.equations, problem.t);
      }
      level.problem = std::make_unique<StepProblem<2>>(
          StepProblem<2>{level.own, level.own_exchange, problem.equations, problem.time, level.none,
                         level.unforced, nullptr, problem.t});
    }
    level.problem->exchange.states(*level.blocks, level.q);
    for (std::size_t i = 0; i < level.grids.size(); ++i)
      for (auto& op : level.operators[i]) op.build(level.grids[i], level.q[i], physics);
  }
  std::vector<double> weights, r, d;
  finest.each_solved([&](std::size_t i, std::size_t c) {
    weights.insert(weights.end(), 3, 1.0 / finest.grids[i].volume[c]);
  });
  Anderson anderson(options_.anderson_depth, weights);
  StepReport report;
  for (;; ++report.cycles) {
    report.norms.push_back(finest.norm_after_evaluation());
    report.converged = tolerance.met(report.norms.back(), report.norms.front());
    if (report.converged || report.cycles == tolerance.max_cycles || !std::isfinite(report.norms.back()))
      break;
    r.clear();
    d.clear();
    finest.each_solved([&](std::size_t i, std::size_t c) {
      for (const auto& field : finest.r[i].q) r.push_back(field[c]);
    });
    const std::vector<State<2>> before = finest.q;
    cycle(0, problem, true);
    finest.each_solved([&](std::size_t i, std::size_t c) {
      d.push_back((finest.q[i].p[c] - before[i].p[c]) / finest.p_unit);
      for (std::size_t k = 0; k < 2; ++k) d.push_back(finest.q[i].u[k][c] - before[i].u[k][c]);
    });
    anderson.mix(r, d);
    for (std::size_t i = 0; i < before.size(); ++i) finest.q[i] = before[i];
    std::size_t at = 0;
    finest.each_solved([&](std::size_t i, std::size_t c) {
      finest.add(i, c, d[at], d[at + 1], d[at + 2]);
      at += 3;
    });
  }
  q = finest.q;
  return report;
}

}  // namespace littoral::fv
