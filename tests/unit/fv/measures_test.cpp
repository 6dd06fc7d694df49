#include "physics/measures.hpp"

#include <gtest/gtest.h>

#include "dual_time/plain.hpp"
#include "grids.hpp"
#include "io/gauges.hpp"
#include "littoral/error.hpp"
#include "physics/velocity_gradient.hpp"
#include "physics/wall_loads.hpp"

namespace littoral::fv {
namespace {

template <int D>
Stepper<D> tank(const Equations<D>& equations, const FlowFunction<D>& flow) {
  Block<D> block = deformed_box<D>(7);
  close_with<D>(block, Condition::wall);
  Stepper<D> stepper({block}, equations, std::make_unique<PlainDualTime<D>>(1.0), InnerTolerance{});
  stepper.initialise(flow, 0.0);
  return stepper;
}

TEST(WallForceTest, WaterAtRestWeighsOnItsWallsAndNothingElse) {
  Equations<3> equations;
  equations.fluid.gravity = {0.0, 0.0, -9.81};
  equations.fluid.viscosity = 0.01;
  Stepper<3> stepper = tank<3>(equations, [&](const std::array<double, 3>& x, double) {
    return PointState<3>{equations.fluid.hydrostatic(x), {}};
  });
  const WallLoads f = wall_loads<3>(stepper.blocks(), equations, stepper.state(), "face", {});
  // all faces together carry the weight of the unit volume; face centres integrate the linear pressure over
  // warped faces to second order
  EXPECT_NEAR(f.hydrostatic.force[2], -1000.0 * 9.81, 0.02 * 9810.0);
  EXPECT_NEAR(f.hydrostatic.force[0], 0.0, 0.02 * 9810.0);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(f.dynamic().force[k], 0.0, 1e-9);
    EXPECT_NEAR(f.dynamic().moment[k], 0.0, 1e-9);
  }
  // about another point: the moment changes by the arm times the force
  const coupler::Vec3 about = {0.3, -0.2, 1.1};
  const WallLoads g = wall_loads<3>(stepper.blocks(), equations, stepper.state(), "face", about);
  const coupler::Vec3& w = f.hydrostatic.force;
  const coupler::Vec3 arm = {about[1] * w[2] - about[2] * w[1], about[2] * w[0] - about[0] * w[2],
                             about[0] * w[1] - about[1] * w[0]};
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_NEAR(g.hydrostatic.moment[k], f.hydrostatic.moment[k] - arm[k], 1e-8);
}

TEST(VelocityGradientTest, LinearFieldsAreExactAndVorticesHaveNegativeQ) {
  const auto flow = [](const std::array<double, 3>& x, double) {  // rotation 2 about y, strain along x and z
    return PointState<3>{0.0, {0.5 * x[0] + 2.0 * x[2], 0.1 * x[0], -2.0 * x[0] - 0.5 * x[2]}};
  };
  const Stepper<3> stepper = tank<3>(Equations<3>{}, flow);
  const Block<3>& block = stepper.blocks()[0];
  const VelocityGradient<3> g = velocity_gradient<3>(block, stepper.state()[0], block.extent.at({3, 4, 2}));
  const double expected[3][3] = {{0.5, 0.0, 2.0}, {0.1, 0.0, 0.0}, {-2.0, 0.0, -0.5}};
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t l = 0; l < 3; ++l) EXPECT_NEAR(g[k][l], expected[k][l], 1e-12);
  const coupler::Vec3 curl = vorticity<3>(g);
  EXPECT_NEAR(curl[0], 0.0, 1e-12);
  EXPECT_NEAR(curl[1], 4.0, 1e-12);
  EXPECT_NEAR(curl[2], 0.1, 1e-12);
  EXPECT_NEAR(q_criterion<3>(g), 2.0 * 0.25 - 2.0 * 4.0, 1e-12);  // rotation wins: below 0
  EXPECT_NEAR(vorticity<2>({{{0.0, 2.0}, {-2.0, 0.0}}})[1], 4.0, 1e-15);
}

TEST(IntegralsTest, AStreamHasItsMassAndEnergy) {
  Equations<2> equations;
  equations.fluid.gravity = {0.0, -9.81};
  const Stepper<2> stepper = tank<2>(equations, [](const std::array<double, 2>&, double) {
    return PointState<2>{0.0, {3.0, 4.0}};
  });
  const Block<2>& block = stepper.blocks()[0];
  const Integrals all = integrate<2>(block, equations.fluid, stepper.state()[0], outside_share<2>(block, {}));
  EXPECT_NEAR(all.mass, 1000.0, 1e-10);
  EXPECT_NEAR(all.kinetic_energy, 0.5 * 1000.0 * 25.0, 1e-8);
  EXPECT_NEAR(all.potential_energy, 1000.0 * 9.81 * 0.5, 0.01 * 4905.0);  // centres for centroids
}

TEST(IntegralsTest, TheRegionIsLeftToTheParticles) {
  Block<2> block = deformed_box<2>(8, 0.0, 0.0, 0.0);
  const Field share = outside_share<2>(block, {{{0.25, 0.0, 0.3}, {2.0, 0.0, 2.0}}});
  double outside = 0.0;
  for (std::size_t c = 0; c < share.size(); ++c) outside += share[c] * block.volume[c];
  EXPECT_NEAR(outside, 1.0 - 0.75 * 0.7, 1e-14);  // also where the face cuts a cell
}

TEST(GaugesTest, APointGaugeIsExactForLinearFields) {
  const auto flow = [](const std::array<double, 2>& x, double) {
    return PointState<2>{2.0 * x[0] - x[1], {x[0], 1.0 + x[1]}};
  };
  const Stepper<2> stepper = tank<2>(Equations<2>{}, flow);
  GaugeConfig point;
  point.name = "a";
  point.at = {0.61, 0.0, 0.47};
  const Gauges<2> gauges({point}, stepper);
  EXPECT_EQ(gauges.columns(), (std::vector<std::string>{"a.p", "a.u", "a.w"}));
  const std::vector<double> v = gauges.values(stepper);
  EXPECT_NEAR(v[0], 2.0 * 0.61 - 0.47, 1e-12);
  EXPECT_NEAR(v[1], 0.61, 1e-12);
  EXPECT_NEAR(v[2], 1.47, 1e-12);
}

TEST(GaugesTest, AGaugeNobodyCanServeIsRefused) {
  const Stepper<2> stepper =
      tank<2>(Equations<2>{}, [](const std::array<double, 2>&, double) { return PointState<2>{}; });
  GaugeConfig far;
  far.name = "far";
  far.at = {7.0, 0.0, 0.5};
  EXPECT_THROW((Gauges<2>({far}, stepper)), ConfigError);
  GaugeConfig force;
  force.name = "keel";
  force.kind = GaugeConfig::Kind::force;
  force.wall = "hull";
  EXPECT_THROW((Gauges<2>({force}, stepper)), ConfigError);
}

}  // namespace
}  // namespace littoral::fv
