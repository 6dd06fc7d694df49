#pragma once

#include <array>
#include <vector>

#include "free_surface/cut_faces.hpp"
#include "free_surface/fringe_faces.hpp"
#include "free_surface/imposed.hpp"
#include "free_surface/inflow.hpp"
#include "free_surface/start_pressure.hpp"
#include "free_surface/thin_water.hpp"
#include "level_set/level_set.hpp"
#include "physics/equations.hpp"

namespace littoral::fv {

/// The free surface of a scene that has one: the level set, its time levels, and what it does to the flow.
/// The stepper calls, in this order (comm collective, all of them),
///   begin    the band of phi^n and its closest surface points; phi extrapolated
///   follow   in every evaluation of the residual: u continued into the air, phi by (7), (23) with the
///            velocity of the closest surface point (no lag), the cells that are water, the faces that the
///            surface cuts
///   end      phi made a distance again without moving its zero level, u continued about the new surface, so
///            that cells that turn to water hold usable u^n, u^n-1
template <int D>
class FreeSurface {
 public:
  explicit FreeSurface(const LevelSetOptions& options = {}) { set_.options = options; }

  /// The surface at time t from a function < 0 in water; q's u and p continued into the air, p in the water
  /// replaced where it cannot be a first guess (start_pressure()).
  /// throws ConfigError where the function is not finite
  void initialise(std::vector<Block<D>>& blocks, const Exchange<D>& exchange, const Equations<D>& equations,
                  const Prescribed& surface, double t, std::vector<State<D>>& q);
  /// Cells have become fringe, forced or blanked: which of them are solved, anew. q: ghosts current
  void statuses_changed(std::vector<Block<D>>& blocks, const Exchange<D>& exchange,
                        const Equations<D>& equations, const std::vector<State<D>>& q);

  /// A step of `scheme` begins, `ahead` = dt/dt before (0 in the first). Fringe cells get `imposed` phi, that
  /// of the new time: at the surface as it is, further away where its sign is another.
  void begin(std::vector<Block<D>>& blocks, const Exchange<D>& exchange, const BackwardDifference& scheme,
             double ahead, const std::vector<Imposed<D>>& imposed = {});
  /// in/out q: u and p in the air; ghosts not current on return
  void follow(std::vector<Block<D>>& blocks, const Exchange<D>& exchange, const Equations<D>& equations,
              std::vector<State<D>>& q);
  void end(std::vector<Block<D>>& blocks, const Exchange<D>& exchange, const Equations<D>& equations,
           std::vector<State<D>>& q);
  /// Takes the mass rows off cells of water that have air on all sides: they fall freely, their pressure is
  /// the surface's, and nothing depends on it.
  void release_drops(std::vector<Residual<D>>& r) const;
  /// Back to before the last begin.
  void restore(std::vector<Block<D>>& blocks, const Exchange<D>& exchange);

  /// Of a block, as it stands: for Equations::residual.
  BlockSurface<D> block(std::size_t b) { return {set_.phi[b], wet_[b], evaluations_ > k_settling, cut_[b]}; }
  const std::vector<Field>& phi() const { return set_.phi; }
  const std::vector<Field>& phi_before() const { return past_; }  // one step ago
  LevelSet<D>& level_set() { return set_; }
  /// The surface's Courant number of a unit step, as the last step left it [1/s].
  double rate() const { return rate_; }
  /// What initialise found of the pressure it was given.
  const StartPressure& start_pressure() const { return start_pressure_; }
  /// Of the water in all solved cells, as the last step left it.
  const VolumeBudget& budget() const { return budget_; }
  /// Where the level set is not to be trusted, after the last step.
  const ThinWater<D>& thin_water() const { return thin_water_; }
  /// Counts the changes of which cells are water.
  long version() const { return version_; }

  /// What a continuation needs.
  struct Memory {
    std::array<std::vector<Field>, 2> phi;  // [m] phi^n, phi^n-1
    VolumeBudget budget;
    double rate = 0.0;  // [1/s]
  };
  Memory memory() const { return {{set_.phi, past_}, budget_, rate_}; }
  void recall(std::vector<Block<D>>& blocks, const Exchange<D>& exchange, const Memory& memory);

 private:
  /// Evaluations of a step in which cells may still turn to water or air, and stencils may be switched. After
  /// that they rest, so that a surface at a cell's centre or face cannot keep the inner iteration from
  /// converging; phi goes on.
  static constexpr int k_settling = 6;

  void set_masks(std::vector<Block<D>>& blocks, const Exchange<D>& exchange);
  /// Volume and inflows as they are, of all ranks. dt: of the step, for the wave speed at openings
  VolumeBudget water(const std::vector<Block<D>>& blocks, const Exchange<D>& exchange,
                     const Equations<D>& equations, double dt, const std::vector<State<D>>& q) const;
  /// Sweeps of (7), (23); the residual before them [m/s].
  double move_phi(const std::vector<Block<D>>& blocks, const Exchange<D>& exchange);
  void continue_flow(const std::vector<Block<D>>& blocks, const Exchange<D>& exchange,
                     std::vector<State<D>>& q);
  void continue_all(const std::vector<Block<D>>& blocks, const Exchange<D>& exchange, const Fluid<D>& fluid,
                    std::vector<State<D>>& q);
  void still_air(const std::vector<Block<D>>& blocks, std::vector<State<D>>& q) const;
  void continue_pressure(const std::vector<Block<D>>& blocks, const Fluid<D>& fluid,
                         std::vector<State<D>>& q) const;

  LevelSet<D> set_;
  std::vector<Field> past_;                  // [m] phi^n-1, cells new in the band completed
  std::array<std::vector<Field>, 2> start_;  // [m] phi^n, phi^n-1 of the step just done or under way
  BackwardDifference scheme_;
  VolumeBudget budget_, budget_before_;  // now, and before the last begin
  FringeFaces<D> fringe_;
  std::vector<WetMask> wet_;  // [block]
  ThinWater<D> thin_water_;
  StartPressure start_pressure_;
  double rate_ = 0.0;                               // [1/s]
  std::vector<CutFaces<D>> cut_;                    // [block]
  std::vector<std::vector<std::ptrdiff_t>> drops_;  // [block] cells of water alone
  long version_ = 0;
  int evaluations_ = 0;  // of this step
};

}  // namespace littoral::fv
