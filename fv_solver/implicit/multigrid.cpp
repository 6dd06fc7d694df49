#include "implicit/multigrid.hpp"

#include <algorithm>

namespace littoral::fv {

template <int D, class Real>
struct Multigrid<D, Real>::BlockLevel {
  LevelGrid<D> grid;
  std::array<int, D> ratio{};                    // to the next level
  State<D> state;                                // frozen; of the finest level only a view, see build
  std::vector<int> directions;                   // of the lines, stiffest first
  std::vector<LineOperator<D, Real>> operators;  // one a direction
  std::unique_ptr<Transfer<D>> transfer;         // to the next level
  Correction<D, Real> b, e, r;
};

template <int D, class Real>
struct Multigrid<D, Real>::Level {
  std::vector<BlockLevel> blocks;
  std::vector<JoinSide<D>> joins;
  JoinLinks<D> links;  // first ghost layer
  LevelOverlap<D> overlap;

  void set_joins(std::vector<JoinSide<D>> sides) {
    joins = std::move(sides);
    std::vector<Extent<D>> extents;
    for (const auto& block : blocks) extents.push_back(block.grid.extent);
    links = JoinLinks<D>(joins, extents, 1);
  }
  std::vector<const LevelGrid<D>*> grids() const {
    std::vector<const LevelGrid<D>*> all;
    for (const auto& block : blocks) all.push_back(&block.grid);
    return all;
  }
};

template <int D, class Real>
Multigrid<D, Real>::Multigrid(std::vector<LevelGrid<D>> blocks, const MultigridOptions& options,
                              std::vector<JoinSide<D>> joins, LevelOverlap<D> overlap)
    : options_(options) {
  if (!joins.empty() || !overlap.empty()) options_.coarsest_sweeps *= 2;
  levels_.push_back(std::make_unique<Level>());
  for (auto& grid : blocks) {
    levels_[0]->blocks.emplace_back();
    levels_[0]->blocks.back().grid = std::move(grid);
  }
  levels_[0]->set_joins(std::move(joins));
  levels_[0]->overlap = std::move(overlap);
  for (;;) {
    Level& level = *levels_.back();
    const std::vector<const LevelGrid<D>*> grids = level.grids();
    if (!level.overlap.empty()) link_corrections<D>(level.overlap, grids, level.joins);
    for (auto& block : level.blocks) {
      block.directions = stiff_directions(block.grid);
      for (int d : block.directions) block.operators.emplace_back(block.grid, d);
      for (Correction<D, Real>* field : {&block.b, &block.e, &block.r})
        field->assign_zero(block.grid.extent.size);
    }
    const std::vector<std::array<int, D>> ratios = joint_ratios<D>(grids, level.joins);
    bool coarsens = false;
    for (const auto& ratio : ratios)
      for (int r : ratio) coarsens = coarsens || r > 1;
    if (!coarsens || static_cast<int>(levels_.size()) >= options_.max_levels) break;
    auto next = std::make_unique<Level>();
    for (std::size_t i = 0; i < level.blocks.size(); ++i) {
      BlockLevel& block = level.blocks[i];
      block.ratio = ratios[i];
      next->blocks.emplace_back();
      next->blocks.back().grid = coarsen<D>(block.grid, block.ratio);
      block.transfer = std::make_unique<Transfer<D>>(block.grid, next->blocks.back().grid, block.ratio);
    }
    next->set_joins(coarse_joins<D>(level.joins, ratios));
    next->links.copy([&](std::size_t i) -> Field& { return next->blocks[i].grid.volume; }, true);
    if (!level.overlap.empty())
      next->overlap = coarsen_overlap<D>(level.overlap, grids, ratios, next->grids());
    levels_.push_back(std::move(next));
  }
  closed_ = true;
  for (const auto& block : levels_[0]->blocks) {
    for_each_cell<D>(block.grid.extent, [&](const auto&, std::ptrdiff_t c) {
      const CellStatus status = block.grid.status[static_cast<std::size_t>(c)];
      if (status == CellStatus::fringe || status == CellStatus::forced) closed_ = false;
    });
    for (const auto& direction : block.grid.edge)
      for (const auto& side : direction)
        for (const EdgeCondition condition : side)
          if (condition != EdgeCondition::wall && condition != EdgeCondition::slip &&
              condition != EdgeCondition::inflow && condition != EdgeCondition::link)
            closed_ = false;
  }
}

template <int D, class Real>
Multigrid<D, Real>::~Multigrid() = default;
template <int D, class Real>
Multigrid<D, Real>::Multigrid(Multigrid&&) noexcept = default;
template <int D, class Real>
Multigrid<D, Real>& Multigrid<D, Real>::operator=(Multigrid&&) noexcept = default;

template <int D, class Real>
void Multigrid<D, Real>::set_forcing(const std::vector<const Field*>& forcing) {
  for (std::size_t i = 0; i < forcing.size(); ++i)
    levels_[0]->blocks[i].grid.forcing = forcing[i] == nullptr ? Field{} : *forcing[i];
  for (std::size_t l = 0; l + 1 < levels_.size(); ++l)
    for (std::size_t i = 0; i < forcing.size(); ++i) {
      const BlockLevel& block = levels_[l]->blocks[i];
      levels_[l + 1]->blocks[i].grid.forcing =
          block.grid.forcing.empty() ? Field{} : coarsen<D>(block.grid, block.ratio).forcing;
    }
}

template <int D, class Real>
void Multigrid<D, Real>::build(const std::vector<const State<D>*>& states,
                               const CorrectionPhysics<D>& physics,
                               const std::vector<const Field*>& forcing) {
  if (!forcing.empty()) set_forcing(forcing);
  // A free pressure level makes the coarsest operator singular; the right side has no such part, so a small
  // anchor there changes nothing but the division by zero.
  constexpr double k_anchor = 1e-4;
  for (std::size_t l = 0; l < levels_.size(); ++l) {
    const bool coarsest = l + 1 == levels_.size();
    const double anchor = coarsest && closed_ && physics.fluid.inverse_c2 == 0.0 ? k_anchor : 0.0;
    for (std::size_t i = 0; i < levels_[l]->blocks.size(); ++i) {
      BlockLevel& block = levels_[l]->blocks[i];
      const State<D>& state = l == 0 ? *states[i] : block.state;
      for (auto& op : block.operators) op.build(block.grid, state, physics, anchor);
      if (coarsest) continue;
      BlockLevel& next = levels_[l + 1]->blocks[i];
      average_state<D>(block.grid, block.ratio, state, next.grid, next.state);
    }
    if (coarsest) continue;
    Level& next = *levels_[l + 1];
    next.links.copy([&](std::size_t i) -> Field& { return next.blocks[i].state.p; }, true);
    for (std::size_t k = 0; k < D; ++k)
      next.links.copy([&](std::size_t i) -> Field& { return next.blocks[i].state.u[k]; }, true);
  }
}

template <int D, class Real>
Correction<D, Real>& Multigrid<D, Real>::right_side(std::size_t i) {
  return levels_[0]->blocks[i].b;
}
template <int D, class Real>
Correction<D, Real>& Multigrid<D, Real>::correction(std::size_t i) {
  return levels_[0]->blocks[i].e;
}
template <int D, class Real>
int Multigrid<D, Real>::n_levels() const {
  return static_cast<int>(levels_.size());
}
template <int D, class Real>
const LevelGrid<D>& Multigrid<D, Real>::grid(int level, std::size_t i) const {
  return levels_[static_cast<std::size_t>(level)]->blocks[i].grid;
}
template <int D, class Real>
const std::vector<int>& Multigrid<D, Real>::directions(std::size_t i) const {
  return levels_[0]->blocks[i].directions;
}

template <int D, class Real>
void Multigrid<D, Real>::exchange(Level& level) {
  if (!level.overlap.links.empty()) interpolate(level);
  for (auto& block : level.blocks)
    for (auto& field : block.e.q) fill_periodic(block.grid, field);
  for (std::size_t k = 0; k <= D; ++k)
    level.links.copy([&](std::size_t i) -> std::vector<Real>& { return level.blocks[i].e.q[k]; }, true);
}

template <int D, class Real>
void Multigrid<D, Real>::interpolate(Level& level) {
  for (std::size_t k = 0; k <= D; ++k) {
    level.overlap.links.interpolate(
        [&](std::size_t i) -> std::vector<Real>& { return level.blocks[i].e.q[k]; });
    for (const auto& r : level.overlap.links.receivers) {
      BlockLevel& block = level.blocks[r.block];
      const auto c = static_cast<std::size_t>(r.cell);
      block.b.q[k][c] = block.e.q[k][c];
    }
  }
}

template <int D, class Real>
template <class FieldOf>
void Multigrid<D, Real>::fill_for_transfer(Level& level, FieldOf&& field_of) {
  for (auto& block : level.blocks) fill_correction_ghosts(block.grid, field_of(block));
  for (std::size_t k = 0; k <= D; ++k)
    level.links.copy([&](std::size_t i) -> std::vector<Real>& { return field_of(level.blocks[i]).q[k]; });
}

template <int D, class Real>
void Multigrid<D, Real>::sweep(Level& level, bool forward, bool from_zero) {
  std::size_t steps = 0;  // colours of all directions, in turn
  for (const auto& block : level.blocks) {
    std::size_t colours = 0;
    for (const auto& op : block.operators) colours += static_cast<std::size_t>(op.layout().n_colours());
    steps = std::max(steps, colours);
  }
  for (std::size_t step = 0; step < steps; ++step) {
    for (auto& block : level.blocks) {
      std::size_t rest = forward ? step : steps - 1 - step;
      for (const auto& op : block.operators) {
        const auto n = static_cast<std::size_t>(op.layout().n_colours());
        if (rest < n) {
          op.smooth(static_cast<int>(rest), block.b, block.e, from_zero && step == 0);
          break;
        }
        rest -= n;
      }
    }
    exchange(level);
  }
}

template <int D, class Real>
void Multigrid<D, Real>::residual(std::size_t i, Correction<D, Real>& r) {
  BlockLevel& block = levels_[0]->blocks[i];
  r.assign_zero(block.grid.extent.size);
  block.operators[0].residual(block.b, block.e, r);
}

template <int D, class Real>
void Multigrid<D, Real>::cycle(bool fresh) {
  descend(0, fresh);
}

template <int D, class Real>
void Multigrid<D, Real>::descend(std::size_t l, bool fresh) {
  Level& level = *levels_[l];
  if (fresh)
    for (auto& block : level.blocks)
      for (auto& field : block.e.q) std::fill(field.begin(), field.end(), Real(0));
  if (!fresh || !level.overlap.links.empty()) exchange(level);
  if (l + 1 == levels_.size()) {
    for (int s = 0; s < options_.coarsest_sweeps; ++s) {
      sweep(level, true);
      sweep(level, false);
    }
    return;
  }
  for (int s = 0; s < options_.pre_sweeps; ++s) sweep(level, true, fresh && s == 0);
  Level& next = *levels_[l + 1];
  for (auto& block : level.blocks) {
    const LineOperator<D, Real>& op = block.operators[0];
    const bool alone = level.blocks.size() == 1 && level.joins.empty() && block.operators.size() == 1;
    if (alone && fresh && options_.pre_sweeps == 1 && op.layout().n_colours() == 2)
      op.residual_after_sweep(block.e, block.r);
    else
      op.residual(block.b, block.e, block.r);
  }
  fill_for_transfer(level, [](BlockLevel& block) -> Correction<D, Real>& { return block.r; });
  for (std::size_t i = 0; i < level.blocks.size(); ++i)
    level.blocks[i].transfer->restrict_residual(level.blocks[i].r, next.blocks[i].b);
  descend(l + 1, true);
  fill_for_transfer(next, [](BlockLevel& block) -> Correction<D, Real>& { return block.e; });
  for (std::size_t i = 0; i < level.blocks.size(); ++i)
    level.blocks[i].transfer->add_prolonged(next.blocks[i].e, level.blocks[i].e);
  exchange(level);
  for (int s = 0; s < options_.post_sweeps; ++s) sweep(level, false);
}

template class Multigrid<2, float>;
template class Multigrid<2, double>;
template class Multigrid<3, float>;
template class Multigrid<3, double>;

}  // namespace littoral::fv
