#include <gtest/gtest.h>

#include "coupling_models.hpp"

// The grid's side of a free surface that passes through the particles' region, the particles played by a
// formula.
namespace littoral::fv {
namespace {

using coupler::Schedule;
using test::march;
using test::top_scene;
using test::water_box;

/// A standing wave on water .7 deep, the particles' box upright in its middle: the surface passes its faces.
struct SurfaceWave {
  support::Scene scene = top_scene(1.0);
  double level = 0.7, amplitude, k = 2.0 * std::acos(-1.0);
  double omega = std::sqrt(k * std::tanh(k * level));

  SurfaceWave(support::Scene::CouplingKind kind, Schedule schedule, double a) : amplitude(a) {
    scene.regions[0].lower = {0.25, 0.0, 0.0};
    scene.regions[0].upper[0] = 0.75;
    scene.coupling.kind = kind;
    scene.coupling.schedule.schedule = schedule;
    scene.coupling.window.dt = 0.03;
    scene.initial.surface = support::Formula("z - 0.7", {});  // that there is one
    scene.fluid.sound_speed = 100.0;  // the formulas are those of an incompressible fluid: g H/c^2 = 7e-5
    scene.reference_velocity = 1.0;
  }
  coupler::Flow flow() const {
    return [wave = coupler::standing_wave(test::k_density, 1.0, level, k, amplitude), this](
               const coupler::Vec3& x, double t) {
      return wave({x[0], x[1], x[2] - level}, t);
    };
  }
  /// Largest of the elevation's errors over the columns after `windows` [m]; nowhere: water that came from
  /// there, of all there is.
  double error_after(int windows, double* nowhere = nullptr) const {
    const auto exact = flow();
    auto stepper = test::stepper_for<2>({water_box<2>(32, true)}, scene,
                                        [exact](const std::array<double, 2>& x, double t) {
                                          const coupler::FlowState s = exact({x[0], 0.0, x[1]}, t);
                                          return PointState<2>{s.p, {s.u[0], s.u[2]}};
                                        });
    stepper.tolerance().floor = 1e-8;
    stepper.set_surface([exact](const coupler::Vec3& x, double t) { return exact(x, t).phi; });
    Coupled<2> coupled(scene, 10.0, coupler::analytic_sph_partner(exact, test::plan_of(scene)));
    coupled.begin(stepper);
    march(coupled, stepper, windows);
    if (nowhere != nullptr) *nowhere = stepper.surface()->budget().relative_error();
    const Block<2>& block = stepper.blocks()[0];
    const Field& phi = stepper.surface()->phi()[0];
    double worst = 0.0;
    for (int i = 0; i < block.extent.n[0]; ++i)
      for (int j = 0; j + 1 < block.extent.n[1]; ++j) {
        const auto c = static_cast<std::size_t>(block.extent.at({i, j})),
                   up = static_cast<std::size_t>(block.extent.at({i, j + 1}));
        if (block.status[c] == CellStatus::blanked || !(phi[c] < 0.0 && phi[up] >= 0.0)) continue;
        const double z =
            block.centre[1][c] + (block.centre[1][up] - block.centre[1][c]) * phi[c] / (phi[c] - phi[up]);
        worst = std::max(worst, std::abs(exact({block.centre[0][c], 0.0, z}, stepper.time()).phi));
      }
    return worst;
  }
};

void expect_surface_follows(support::Scene::CouplingKind kind, Schedule schedule) {
  EXPECT_LT(SurfaceWave(kind, schedule, 0.0).error_after(5), 1e-5) << coupler::name(schedule);
  // a quarter of a period, when it is highest; the formula is linear: k a = .02
  EXPECT_LT(SurfaceWave(kind, schedule, 0.003).error_after(20), 0.05 * 0.003) << coupler::name(schedule);
}

TEST(CoupledTest, ASurfaceThatPassesTheRegionIsImposedAtRestAndInAWave) {
  expect_surface_follows(support::Scene::CouplingKind::imposed, Schedule::serial);
}

TEST(CoupledTest, WaterThatGoesToTheParticlesIsNotLost) {
  // a quarter of a period takes 2 a / k of water through the two faces, at nodes, .0027 of what the grid has
  double nowhere = 1.0;
  const SurfaceWave wave(support::Scene::CouplingKind::imposed, Schedule::serial, 0.003);
  (void)wave.error_after(20, &nowhere);
  EXPECT_LT(std::abs(nowhere), 2e-4);
}

TEST(CoupledTest, ASurfaceThatPassesTheRegionIsForcedAtRestAndInAWave) {
  expect_surface_follows(support::Scene::CouplingKind::forced, Schedule::predicted);
}

}  // namespace
}  // namespace littoral::fv
