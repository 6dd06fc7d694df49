#pragma once

#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include "coupling/coupled.hpp"
#include "dual_time/stepper.hpp"
#include "grid/metrics.hpp"
#include "implicit/multigrid_solver.hpp"
#include "littoral/coupler/analytic.hpp"
#include "littoral/support/run_plan.hpp"
#include "littoral/support/scene.hpp"

// A box of water, 1 x 1 (x 1), whose middle or top belongs to the particles.
namespace littoral::fv::test {

constexpr double k_density = 1000.0;

template <int D>
Block<D> water_box(int cells, bool periodic_x, Condition rest = Condition::slip) {
  std::array<int, D> n;
  n.fill(cells);
  std::array<bool, D> periodic{};
  periodic[0] = periodic_x;
  auto block = make_block<D>("box", n, periodic, [=](const std::array<int, D>& i) {
    std::array<double, D> x;
    for (std::size_t d = 0; d < D; ++d) x[d] = static_cast<double>(i[d]) / cells;
    return x;
  });
  for (int d = 0; d < D; ++d)
    for (int side = 0; side < 2; ++side) {
      Window<D> w;
      w.direction = d;
      w.side = side;
      w.upper = block.extent.n;
      w.condition = block.periodic[static_cast<std::size_t>(d)] ? Condition::periodic : rest;
      block.windows.push_back(w);
    }
  return block;
}

/// A scene of one region, dt given, Coupling I unless said.
inline support::Scene scene_with(int dimension, const support::Scene::Region& region, double gravity = 0.0) {
  support::Scene scene;
  scene.dimension = dimension;
  scene.fluid.density = k_density;
  scene.fluid.sound_speed = 10.0;
  scene.gravity = {0, 0, -gravity};
  scene.domain.lower = {-9, -9, -9};  // the region's faces are open on all sides unless a test closes some
  scene.domain.upper = {9, 9, 9};
  scene.regions = {region};
  scene.coupling.kind = support::Scene::CouplingKind::imposed;
  scene.coupling.blending_width = 0.05;
  scene.coupling.driven_width = 0.05;
  scene.coupling.window.dt = 0.01;
  scene.time.end = 1.0;
  return scene;
}

/// The particles have everything above z = .5; periodic in x.
inline support::Scene top_scene(double gravity) {
  support::Scene scene = scene_with(2, {{0, 0, 0.5}, {1, 0, 2}}, gravity);
  scene.domain.lower = {0, 0, 0};
  scene.domain.upper = {1, 0, 2};
  scene.domain.sides[0] = {support::Scene::Side::periodic, support::Scene::Side::periodic};
  return scene;
}

template <int D>
Stepper<D> stepper_for(std::vector<Block<D>> blocks, const support::Scene& scene,
                       const FlowFunction<D>& flow) {
  Equations<D> equations;
  equations.fluid.density = scene.fluid.density;
  equations.fluid.inverse_c2 = 1.0 / (scene.fluid.sound_speed * scene.fluid.sound_speed);
  for (std::size_t k = 0; k < D; ++k) equations.fluid.gravity[k] = scene.gravity[D == 2 && k == 1 ? 2 : k];
  equations.speeds.c0 = 1.0;
  InnerTolerance tolerance;
  tolerance.drop = 1e-4;
  Stepper<D> stepper(std::move(blocks), equations, std::make_unique<MultigridSolver<D>>(), tolerance);
  stepper.initialise(flow, 0.0);
  return stepper;
}

inline coupler::RunPlan plan_of(const support::Scene& scene, double time = 0.0, std::int64_t window = 0) {
  coupler::RunPlan plan;
  plan.schedule = scene.coupling.schedule;
  plan.window = scene.coupling.window;
  plan.start_time = time;
  plan.start_window = window;
  plan.end_time = scene.time.end;
  plan.with_phi = support::level_set_crosses(scene);
  return plan;
}

/// Runs `windows` windows; returns how many it could.
template <int D>
int march(Coupled<D>& coupled, Stepper<D>& stepper, int windows) {
  coupler::Proposal mine;
  mine.dt_stable = std::numeric_limits<double>::infinity();
  for (int i = 0; i < windows; ++i) {
    const auto agreement = coupled.agree(mine);
    if (!agreement || agreement->stop) return i;
    coupled.advance(agreement->window, stepper);
  }
  return windows;
}

}  // namespace littoral::fv::test
