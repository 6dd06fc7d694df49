#include "implicit/multigrid.hpp"

#include <algorithm>

#include "implicit/held_directions.hpp"

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
  std::vector<BlockLevel> blocks;          // this rank's
  std::vector<BlockShape<D>> shapes;       // of all blocks
  std::vector<JoinSide<D>> joins;          // of all blocks
  std::vector<std::array<int, D>> ratios;  // of all blocks, to the next level
  JoinLinks<D> links;                      // first ghost layer
  LevelOverlap<D> overlap;
  std::size_t n_steps = 0;  // of a sweep: colours of all directions, the most of any block of any rank
  std::vector<std::vector<Real*>> e_arrays, r_arrays;  // [block][component] of the corrections, residuals

  void set_links(const Owners& owners) {
    std::vector<Extent<D>> extents;
    for (const auto& shape : shapes) extents.push_back(shape.extent);
    links = JoinLinks<D>(joins, extents, 1, owners);
  }
  void count_steps(const Ranks& ranks) {
    for (const auto& block : blocks) {
      std::size_t colours = 0;
      for (const auto& op : block.operators) colours += static_cast<std::size_t>(op.layout().n_colours());
      n_steps = std::max(n_steps, colours);
    }
    n_steps = static_cast<std::size_t>(ranks.largest(static_cast<double>(n_steps)));
  }
  std::vector<const LevelGrid<D>*> grids() const {
    std::vector<const LevelGrid<D>*> all;
    for (const auto& block : blocks) all.push_back(&block.grid);
    return all;
  }
};

template <int D, class Real>
Multigrid<D, Real>::Multigrid(std::vector<LevelGrid<D>> blocks, const MultigridOptions& options,
                              const Layout<D>& layout, LevelOverlap<D> overlap)
    : options_(options), owners_(layout.owners) {
  if (!layout.joins.empty() || !overlap.empty()) options_.coarsest_sweeps *= 2;
  const std::vector<std::size_t> mine = owners_.mine();
  levels_.push_back(std::make_unique<Level>());
  for (auto& grid : blocks) {
    levels_[0]->blocks.emplace_back();
    levels_[0]->blocks.back().grid = std::move(grid);
  }
  levels_[0]->shapes = layout.shape;
  levels_[0]->joins = layout.joins;
  levels_[0]->set_links(owners_);
  levels_[0]->overlap = std::move(overlap);
  for (;;) {
    Level& level = *levels_.back();
    const std::vector<const LevelGrid<D>*> grids = level.grids();
    if (!level.overlap.empty()) link_corrections<D>(level.overlap, grids, level.shapes, level.joins, layout);
    for (auto& block : level.blocks) {
      block.directions = stiff_directions(block.grid);
      for (int d : block.directions) block.operators.emplace_back(block.grid, d);
      for (Correction<D, Real>* field : {&block.b, &block.e, &block.r})
        field->assign_zero(block.grid.extent.size);
      level.e_arrays.emplace_back();
      level.r_arrays.emplace_back();
      for (auto& field : block.e.q) level.e_arrays.back().push_back(field.data());
      for (auto& field : block.r.q) level.r_arrays.back().push_back(field.data());
    }
    level.count_steps(owners_.ranks);
    level.ratios =
        joint_ratios<D>(level.shapes, level.joins, all_held_directions<D>(grids, level.shapes, owners_));
    bool coarsens = false;
    for (const auto& ratio : level.ratios)
      for (int r : ratio) coarsens = coarsens || r > 1;
    if (!coarsens || static_cast<int>(levels_.size()) >= options_.max_levels) break;
    auto next = std::make_unique<Level>();
    next->shapes = coarse_shapes<D>(level.shapes, level.ratios);
    next->joins = coarse_joins<D>(level.joins, level.ratios);
    for (std::size_t i = 0; i < level.blocks.size(); ++i) {
      BlockLevel& block = level.blocks[i];
      block.ratio = level.ratios[mine[i]];
      next->blocks.emplace_back();
      next->blocks.back().grid = coarsen<D>(block.grid, block.ratio);
      block.transfer = std::make_unique<Transfer<D>>(block.grid, next->blocks.back().grid, block.ratio);
    }
    next->set_links(owners_);
    next->links.copy([&](std::size_t i) -> Field& { return next->blocks[i].grid.volume; }, true);
    if (!level.overlap.empty()) next->overlap = coarsen_overlap<D>(level.overlap, grids, next->grids());
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
  closed_ = !owners_.ranks.any(!closed_);
}

namespace {

template <int D>
Layout<D> apart(const std::vector<LevelGrid<D>>& blocks) {
  Layout<D> layout;
  layout.owners = Owners::all_here(blocks.size());
  for (const auto& grid : blocks) layout.shape.push_back({grid.extent, grid.periodic});
  return layout;
}

}  // namespace

template <int D, class Real>
Multigrid<D, Real>::Multigrid(std::vector<LevelGrid<D>> blocks, const MultigridOptions& options)
    : Multigrid(blocks, options, apart(blocks), {}) {}

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
void Multigrid<D, Real>::set_surface(const std::vector<Field>& phi) {
  for (std::size_t i = 0; i < phi.size(); ++i) levels_[0]->blocks[i].grid.phi = phi[i];
  for (std::size_t l = 0; l < levels_.size(); ++l) {
    Level& level = *levels_[l];
    if (l > 0) level.links.copy([&](std::size_t i) -> Field& { return level.blocks[i].grid.phi; }, true);
    for (std::size_t i = 0; i < phi.size(); ++i) {
      BlockLevel& block = level.blocks[i];
      find_surface(block.grid);
      if (l + 1 < levels_.size()) coarsen_phi<D>(block.grid, block.ratio, levels_[l + 1]->blocks[i].grid);
    }
  }
  for (std::size_t l = 0; l + 1 < levels_.size(); ++l)
    for (std::size_t i = 0; i < phi.size(); ++i) {
      BlockLevel& block = levels_[l]->blocks[i];
      block.transfer->set_solved(block.grid, levels_[l + 1]->blocks[i].grid);
    }
}

template <int D, class Real>
void Multigrid<D, Real>::build(const std::vector<const State<D>*>& states,
                               const CorrectionPhysics<D>& physics, const std::vector<const Field*>& forcing,
                               const std::vector<Field>* phi) {
  if (!forcing.empty()) set_forcing(forcing);
  if (phi != nullptr) set_surface(*phi);
  floating_ = closed_ && phi == nullptr && physics.fluid.inverse_c2 == 0.0;
  // A free pressure level makes the coarsest operator singular; the right side has no such part, so a small
  // anchor there changes nothing but the division by zero.
  constexpr double k_anchor = 1e-4;
  for (std::size_t l = 0; l < levels_.size(); ++l) {
    const bool coarsest = l + 1 == levels_.size();
    const double anchor = coarsest && floating_ ? k_anchor : 0.0;
    CorrectionPhysics<D> here = physics;
    here.jump = options_.jump[std::min(l, options_.jump.size() - 1)];
    for (std::size_t i = 0; i < levels_[l]->blocks.size(); ++i) {
      BlockLevel& block = levels_[l]->blocks[i];
      const State<D>& state = l == 0 ? *states[i] : block.state;
      for (auto& op : block.operators) op.build(block.grid, state, here, anchor);
      if (coarsest) continue;
      BlockLevel& next = levels_[l + 1]->blocks[i];
      average_state<D>(block.grid, block.ratio, state, next.grid, next.state);
    }
    if (coarsest) continue;
    Level& next = *levels_[l + 1];
    std::vector<std::vector<double*>> fields;
    for (auto& block : next.blocks) {
      fields.push_back({block.state.p.data()});
      for (auto& u : block.state.u) fields.back().push_back(u.data());
    }
    next.links.template copy_fields<double>(fields, true);
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
  level.links.template copy_fields<Real>(level.e_arrays, true);
}

template <int D, class Real>
void Multigrid<D, Real>::interpolate(Level& level) {
  level.overlap.links.interpolate(
      D + 1,
      [&](std::size_t i, std::size_t c, double* value) {
        for (std::size_t k = 0; k <= D; ++k) value[k] = static_cast<double>(level.blocks[i].e.q[k][c]);
      },
      [&](std::size_t i, std::size_t c, const double* value) {
        BlockLevel& block = level.blocks[i];
        for (std::size_t k = 0; k <= D; ++k) block.e.q[k][c] = block.b.q[k][c] = static_cast<Real>(value[k]);
      });
}

template <int D, class Real>
void Multigrid<D, Real>::fill_for_transfer(Level& level, Correction<D, Real> BlockLevel::*field,
                                           const std::vector<std::vector<Real*>>& arrays) {
  for (auto& block : level.blocks) fill_correction_ghosts(block.grid, block.*field);
  level.links.template copy_fields<Real>(arrays);
}

template <int D, class Real>
void Multigrid<D, Real>::sweep(Level& level, bool forward, bool from_zero) {
  const std::size_t steps = level.n_steps;
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
  const bool coarsest = l + 1 == levels_.size();
  // One block that is swept once in two colours: the first reads nothing, the second what the first has
  // written, so there is no need of zeros before, and of the residual only the first's is not zero after.
  const bool two_colours = fresh && !coarsest && options_.pre_sweeps == 1 && level.blocks.size() == 1 &&
                           level.joins.empty() && level.overlap.links.empty() &&
                           level.blocks[0].operators.size() == 1 &&
                           level.blocks[0].operators[0].layout().n_colours() == 2;
  if (fresh && !two_colours)
    for (auto& block : level.blocks)
      for (auto& field : block.e.q) std::fill(field.begin(), field.end(), Real(0));
  if (!fresh || !level.overlap.links.empty()) exchange(level);
  if (coarsest) {
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
    if (two_colours)
      op.residual_after_sweep(block.e, block.r);
    else
      op.residual(block.b, block.e, block.r);
  }
  fill_for_transfer(level, &BlockLevel::r, level.r_arrays);
  for (std::size_t i = 0; i < level.blocks.size(); ++i)
    level.blocks[i].transfer->restrict_residual(level.blocks[i].r, next.blocks[i].b);
  descend(l + 1, true);
  fill_for_transfer(next, &BlockLevel::e, next.e_arrays);
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
