#include "free_surface/free_surface.hpp"

#include <cmath>

#include "grid/loops.hpp"
#include "grid/metrics.hpp"

namespace littoral::fv {
namespace {

/// Inner cells of water without water across any face.
template <int D>
std::vector<std::ptrdiff_t> cells_alone(const Block<D>& block, const WetMask& wet) {
  std::vector<std::ptrdiff_t> alone;
  for_each_index<D>({}, block.extent.n, [&](const std::array<int, D>& index) {
    const std::ptrdiff_t c = block.extent.at(index);
    if (wet[static_cast<std::size_t>(c)] != 0 && air_all_around<D>(block, wet, c)) alone.push_back(c);
  });
  return alone;
}

bool corrects_volumes(const LevelSetOptions& options) {
  return options.volume_correction == LevelSetOptions::VolumeCorrection::local;
}

/// Residual of phi at which a step ends, over the pseudo sound speed, and rounds of sweeps at most.
constexpr double k_phi_tolerance = 1e-9;
constexpr int k_last_rounds = 20;

}  // namespace

template <int D>
void FreeSurface<D>::initialise(std::vector<Block<D>>& blocks, const Exchange<D>& exchange,
                                const Equations<D>& equations, const Prescribed& surface, double t,
                                std::vector<State<D>>& q) {
  set_.initialise(blocks, exchange, surface, t);
  // Reinitialised over and over phi settles beside the surface, by a factor of ten each time: what that
  // changes in the measured volume must not be taken for lost water.
  constexpr int k_settles = 12;
  for (int i = 0; i < k_settles && corrects_volumes(set_.options); ++i)
    reinitialise<D>(blocks, exchange, set_.options.layers, InterfaceCells::frozen, set_.phi, set_.band,
                    set_.patches);
  past_ = set_.phi;
  start_ = {set_.phi, past_};
  set_masks(blocks, exchange);
  start_pressure_ = settle_start_pressure<D>(blocks, exchange, equations.fluid, set_.band, set_.phi, q);
  continue_all(blocks, exchange, equations.fluid, q);
  budget_ = water(blocks, exchange, equations, BackwardDifference::steady().dt, q);
}

template <int D>
void FreeSurface<D>::statuses_changed(std::vector<Block<D>>& blocks, const Exchange<D>& exchange,
                                      const Equations<D>& equations, const std::vector<State<D>>& q) {
  set_masks(blocks, exchange);
  fringe_ = FringeFaces<D>(blocks, exchange);
  const VolumeBudget now = water(blocks, exchange, equations, BackwardDifference::steady().dt, q);
  budget_.volume = now.volume;  // of the cells solved from now on
  budget_.from_partner = now.from_partner;
}

template <int D>
VolumeBudget FreeSurface<D>::water(const std::vector<Block<D>>& blocks, const Exchange<D>& exchange,
                                   const Equations<D>& equations, double dt,
                                   const std::vector<State<D>>& q) const {
  std::array<double, 3> sums{water_volume<D>(blocks, set_.phi),
                             inflow_through_openings<D>(blocks, equations, dt, set_.phi, q),
                             -fringe_.flux(blocks, exchange, q, &set_.phi, nullptr)};
  exchange.ranks().sum(sums);
  return {sums[0], sums[1], 0.0, sums[2]};
}

template <int D>
void FreeSurface<D>::begin(std::vector<Block<D>>& blocks, const Exchange<D>& exchange,
                           const BackwardDifference& scheme, double ahead,
                           const std::vector<Imposed<D>>& imposed) {
  // anew from phi^n alone, so that a continued run has the same to the bit
  locate_surface<D>(blocks, exchange, set_.phi, set_.options.layers, set_.band, set_.patches);
  start_ = {set_.phi, past_};
  for (std::size_t b = 0; b < blocks.size(); ++b)
    for (std::size_t c = 0; c < set_.phi[b].size(); ++c)
      set_.phi[b][c] += ahead * (set_.phi[b][c] - past_[b][c]);
  for (std::size_t b = 0; b < imposed.size(); ++b)
    for (std::size_t m = 0; m < imposed[b].phi.size(); ++m) {
      const std::size_t c = imposed[b].cell[m];
      const double given = imposed[b].phi[m];
      double& phi = set_.phi[b][c];
      if ((given < 0.0) != (phi < 0.0) || std::abs(given) < k_given_reach * longest_edge(blocks[b], c))
        phi = given;
    }
  exchange.scalar(blocks, set_.phi, ScalarGhosts::level_set);
  set_masks(blocks, exchange);
  scheme_ = scheme;
  budget_before_ = budget_;
  evaluations_ = 0;
}

template <int D>
void FreeSurface<D>::follow(std::vector<Block<D>>& blocks, const Exchange<D>& exchange,
                            const Equations<D>& equations, std::vector<State<D>>& q) {
  exchange.states(blocks, q);
  continue_flow(blocks, exchange, q);
  exchange.states(blocks, q);
  std::vector<const VectorField<D>*> u;
  for (const auto& state : q) u.push_back(&state.u);
  const bool settled = evaluations_ >= k_settling;
  set_.follower.follow(blocks, exchange, set_.band, set_.patches, set_.phi, u, settled,
                       set_.surface_velocity);
  move_phi(blocks, exchange);
  ++evaluations_;
  if (!settled) set_masks(blocks, exchange);
  continue_pressure(blocks, equations.fluid, q);
}

template <int D>
double FreeSurface<D>::move_phi(const std::vector<Block<D>>& blocks, const Exchange<D>& exchange) {
  const SurfaceStep<D> step{scheme_, start_[0], start_[1], set_.forcing, set_.band, set_.patches};
  return transport<D>(blocks, exchange, step, set_.surface_velocity, set_.options.sweeps, set_.phi);
}

template <int D>
void FreeSurface<D>::end(std::vector<Block<D>>& blocks, const Exchange<D>& exchange,
                         const Equations<D>& equations, std::vector<State<D>>& q) {
  for (int round = 0; round < k_last_rounds; ++round)
    if (exchange.ranks().largest(move_phi(blocks, exchange)) <= k_phi_tolerance * equations.speeds.c0) break;
  evaluations_ = 0;
  past_ = start_[0];
  reinitialise<D>(blocks, exchange, set_.options.layers, InterfaceCells::frozen, set_.phi, set_.band,
                  set_.patches, &past_);
  if (corrects_volumes(set_.options))
    restore_volumes<D>(blocks, exchange, set_.band, set_.patches, start_[0], set_.phi, past_);
  set_masks(blocks, exchange);
  continue_all(blocks, exchange, equations.fluid, q);
  budget_.add(water(blocks, exchange, equations, scheme_.dt, q), scheme_.dt);
  thin_water_ = find_thin_water<D>(blocks, exchange, set_.band, set_.phi, wet_);
  rate_ = exchange.ranks().largest(surface_rate<D>(blocks, set_.band, set_.surface_velocity));
}

/// Air without a velocity of its own holds none: extrapolated in time step by step it would run away, and a
/// surface that comes back would meet it.
template <int D>
void FreeSurface<D>::still_air(const std::vector<Block<D>>& blocks, std::vector<State<D>>& q) const {
  for (std::size_t b = 0; b < blocks.size(); ++b)
    for_each_index<D>({}, blocks[b].extent.n, [&](const std::array<int, D>& index) {
      const auto c = static_cast<std::size_t>(blocks[b].extent.at(index));
      if (blocks[b].status[c] == CellStatus::fringe || set_.extension.reached(b, c)) return;
      for (Field& component : q[b].u) component[c] = 0.0;
    });
}

template <int D>
void FreeSurface<D>::release_drops(std::vector<Residual<D>>& r) const {
  for (std::size_t b = 0; b < drops_.size(); ++b)
    for (const std::ptrdiff_t c : drops_[b]) r[b].mass[static_cast<std::size_t>(c)] = 0.0;
}

template <int D>
void FreeSurface<D>::restore(std::vector<Block<D>>& blocks, const Exchange<D>& exchange) {
  set_.phi = start_[0];
  past_ = start_[1];
  budget_ = budget_before_;
  set_masks(blocks, exchange);
}

template <int D>
void FreeSurface<D>::recall(std::vector<Block<D>>& blocks, const Exchange<D>& exchange,
                            const Memory& memory) {
  budget_ = memory.budget;
  rate_ = memory.rate;
  set_.phi = memory.phi[0];
  past_ = memory.phi[1];
  set_masks(blocks, exchange);
}

template <int D>
void FreeSurface<D>::continue_all(const std::vector<Block<D>>& blocks, const Exchange<D>& exchange,
                                  const Fluid<D>& fluid, std::vector<State<D>>& q) {
  exchange.states(blocks, q);
  continue_flow(blocks, exchange, q);
  continue_pressure(blocks, fluid, q);
  still_air(blocks, q);
  exchange.states(blocks, q);
}

template <int D>
void FreeSurface<D>::set_masks(std::vector<Block<D>>& blocks, const Exchange<D>& exchange) {
  bool changed = wet_.size() != blocks.size();
  wet_.resize(blocks.size());
  cut_.resize(blocks.size());
  drops_.resize(blocks.size());
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const Field& phi = set_.phi[b];
    WetMask& wet = wet_[b];
    bool other = wet.size() != phi.size();
    wet.resize(phi.size());
    for (std::size_t c = 0; c < phi.size(); ++c) {
      const std::uint8_t now = phi[c] < 0.0 ? 1 : 0;
      other = other || now != wet[c];
      wet[c] = now;
    }
    if (!other) continue;
    changed = true;
    cut_[b].find(blocks[b], wet);
    drops_[b] = cells_alone<D>(blocks[b], wet);
  }
  if (exchange.ranks().any(changed)) ++version_;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    set_solved_mask(blocks[b]);
    for (std::size_t c = 0; c < wet_[b].size(); ++c)
      if (wet_[b][c] == 0) blocks[b].solved[c] = 0.0;
  }
}

template <int D>
void FreeSurface<D>::continue_flow(const std::vector<Block<D>>& blocks, const Exchange<D>& exchange,
                                   std::vector<State<D>>& q) {
  std::vector<VectorField<D>*> u;
  for (auto& state : q) u.push_back(&state.u);
  // by the mask, which may rest: what is solved must not be taken for air, though its phi has changed sign
  // since
  set_.extension.extend(blocks, exchange, set_.band, set_.patches, wet_, set_.options.extension_layers, u);
}

/// Beyond the surface p - P keeps the value that it has on it: what gradients beside walls and output read,
/// and from which a cell that turns to water starts. Fluxes never read it (CutFaces).
template <int D>
void FreeSurface<D>::continue_pressure(const std::vector<Block<D>>& blocks, const Fluid<D>& fluid,
                                       std::vector<State<D>>& q) const {
  constexpr int k_layers = 2;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const Block<D>& block = blocks[b];
    const Field& phi = set_.phi[b];
    const auto set = [&](std::ptrdiff_t cell) {
      const auto c = static_cast<std::size_t>(cell);
      const SpaceVector<D> n = surface_normal<D>(block, phi, cell);
      SpaceVector<D> foot;
      for (std::size_t k = 0; k < D; ++k) foot[k] = block.centre[k][c] - phi[c] * n[k];
      q[b].p[c] = block.reference_pressure[c] + fluid.reference_pressure - fluid.hydrostatic(foot);
    };
    for (const std::ptrdiff_t cell : set_.band.cells(b, 0, k_layers))
      if (wet_[b][static_cast<std::size_t>(cell)] == 0) set(cell);
    for (const std::ptrdiff_t cell : drops_[b]) set(cell);
  }
}

template class FreeSurface<2>;
template class FreeSurface<3>;

}  // namespace littoral::fv
