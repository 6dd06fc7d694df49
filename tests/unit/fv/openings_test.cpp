#include <gtest/gtest.h>

#include "dual_time/plain.hpp"
#include "dual_time/stepper.hpp"
#include "grids.hpp"
#include "implicit/multigrid_solver.hpp"

namespace littoral::fv {
namespace {

InnerTolerance tight() {
  InnerTolerance tolerance;
  tolerance.drop = 1e-8;
  tolerance.floor = 1e-12;
  tolerance.max_cycles = 100;
  return tolerance;
}

/// Channel on a skewed grid, stream U = 1 from the left, slip above and below.
Stepper<2> channel(int n, FluxScheme flux = FluxScheme::upwind3) {
  Block<2> block = deformed_box<2>(n, 0.0, 0.0, 1.0);
  close_with<2>(block, Condition::slip);
  for (Window<2>& w : block.windows) {
    if (w.direction != 0) continue;
    w.condition = w.side == 0 ? Condition::inflow : Condition::convective;
    w.velocity[0] = [](const std::array<double, 3>&, double) { return 1.0; };
  }
  Equations<2> equations;
  equations.flux = flux;
  return Stepper<2>({block}, equations, std::make_unique<MultigridSolver<2>>(), tight());
}

PointState<2> vortex(const std::array<double, 2>& x, double) {
  const double dx = (x[0] - 0.6) / 0.12, dz = (x[1] - 0.5) / 0.12,
               e = 0.3 * std::exp(-0.5 * (dx * dx + dz * dz));
  return {0.0, {1.0 + e * dz, -e * dx}};
}

TEST(ConvectiveOutletTest, AUniformStreamPasses) {
  for (const FluxScheme flux : {FluxScheme::upwind3, FluxScheme::central4}) {
    Stepper<2> stepper = channel(8, flux);
    stepper.initialise(
        [](const std::array<double, 2>&, double) {
          return PointState<2>{0.0, {1.0, 0.0}};
        },
        0.0);
    for (int step = 0; step < 5; ++step) stepper.advance(0.1);
    const Block<2>& block = stepper.blocks()[0];
    for_each_index<2>({}, block.extent.n, [&](const std::array<int, 2>& index) {
      const auto c = static_cast<std::size_t>(block.extent.at(index));
      EXPECT_NEAR(stepper.state()[0].u[0][c], 1.0, 1e-12);
      EXPECT_NEAR(stepper.state()[0].u[1][c], 0.0, 1e-12);
      EXPECT_NEAR(stepper.state()[0].p[c], 0.0, 1e-9);
    });
  }
}

TEST(ConvectiveOutletTest, AContinuedRunIsTheSameToTheBit) {
  Stepper<2> whole = channel(12), second = channel(12);
  whole.initialise(vortex, 0.0);
  for (int step = 0; step < 4; ++step) whole.advance(0.05);
  second.recall(whole.memory());
  for (int step = 0; step < 3; ++step) {
    whole.advance(0.05);
    second.advance(0.05);
  }
  EXPECT_EQ(whole.state()[0].p, second.state()[0].p);
  EXPECT_EQ(whole.state()[0].u[0], second.state()[0].u[0]);
}

TEST(ConvectiveOutletTest, AStepUndoneLeavesNoTrace) {
  Stepper<2> once = channel(12), twice = channel(12);
  for (Stepper<2>* stepper : {&once, &twice}) {
    stepper->initialise(vortex, 0.0);
    for (int step = 0; step < 3; ++step) stepper->advance(0.05);
  }
  twice.advance(0.08);
  twice.restore();
  once.advance(0.05);
  twice.advance(0.05);
  EXPECT_EQ(once.state()[0].p, twice.state()[0].p);
}

/// Stream U = 1 from the left under a flat surface, on sheared cells that widen along both directions: the
/// largest difference from the stream, of phi from the distance, and of the water's volume from what came in
/// and left, after the water has passed once
double stream_under_surface(double level, Condition opening, double inverse_c2 = 0.0) {
  Block<2> block = deformed_box<2>(10, 0.0);
  close_with<2>(block, Condition::slip);
  const Prescribed surface = [=](const std::array<double, 3>& x, double) { return 2.0 * (x[2] - level); };
  for (Window<2>& w : block.windows) {
    if (w.direction != 0) continue;
    w.condition = w.side == 0 && opening != Condition::far_field ? Condition::inflow : opening;
    w.velocity[0] = [](const std::array<double, 3>&, double) { return 1.0; };
    w.surface = surface;
  }
  Equations<2> equations;
  equations.fluid.gravity = {0.0, -9.81};
  equations.fluid.inverse_c2 = inverse_c2;
  Stepper<2> stepper({block}, equations, std::make_unique<MultigridSolver<2>>(), tight());
  stepper.initialise(
      [&](const std::array<double, 2>& x, double) {
        return PointState<2>{equations.fluid.hydrostatic({0.0, x[1] - level}), {1.0, 0.0}};
      },
      0.0);
  stepper.set_surface(surface);
  for (int step = 0; step < 5; ++step) stepper.advance(0.2);
  double largest = std::abs(stepper.surface()->budget().error);
  const Block<2>& made = stepper.blocks()[0];
  for_each_index<2>({}, made.extent.n, [&](const std::array<int, 2>& index) {
    const auto c = static_cast<std::size_t>(made.extent.at(index));
    const double height = made.centre[1][c] - level;
    if (std::abs(height) < 0.1)
      largest = std::max(largest, std::abs(stepper.surface()->phi()[0][c] - height));
    if (made.solved[c] == 0.0) return;
    largest = std::max(largest, std::abs(stepper.state()[0].u[0][c] - 1.0));
    largest = std::max(largest, std::abs(stepper.state()[0].u[1][c]));
  });
  return largest;
}

TEST(SurfaceThroughOpeningsTest, AStreamUnderAFlatSurfacePassesAtAnyLevel) {
  // near a face, a centre, and between; z = 0 is the bottom
  for (const double level : {0.45, 0.5, 0.512})
    EXPECT_LT(stream_under_surface(level, Condition::outflow), 1e-9) << level;
  for (const Condition opening : {Condition::convective, Condition::far_field, Condition::state})
    EXPECT_LT(stream_under_surface(0.48, opening), 1e-9) << name(opening);
  // c = 100 m/s: second order in the cells, for the density of water at rest is no constant
  EXPECT_LT(stream_under_surface(0.47, Condition::outflow, 1e-4), 1e-5);
}

TEST(SpongeTest, DampsAsItsRateSaysAndLeavesTheRestAlone) {
  // a stream along x that does not vary along x, with the zone in the upper half: each row on its own
  Block<2> block = deformed_box<2>(8, 0.0, 0.0, 0.0, {true, false});
  close_with<2>(block, Condition::slip);
  for (Window<2>& w : block.windows)
    if (w.direction == 0) w.condition = Condition::periodic;
  Stepper<2> stepper({block}, Equations<2>{}, std::make_unique<MultigridSolver<2>>(), tight());
  stepper.initialise(
      [](const std::array<double, 2>&, double) {
        return PointState<2>{0.0, {1.0, 0.0}};
      },
      0.0);
  Sponge<2> sponge;
  sponge.axis = 2;
  sponge.from = 0.5;
  sponge.to = 1.0;
  sponge.rate = 3.0;
  sponge.velocity[0] = [](const std::array<double, 3>&, double) { return 0.25; };
  stepper.set_sponges({sponge});
  const double dt = 0.1;
  stepper.advance(dt);  // implicit Euler
  for_each_index<2>({}, block.extent.n, [&](const std::array<int, 2>& index) {
    const auto c = static_cast<std::size_t>(block.extent.at(index));
    const double s = std::max(0.0, (block.centre[1][c] - 0.5) / 0.5), sigma = 3.0 * s * s;
    EXPECT_NEAR(stepper.state()[0].u[0][c], (1.0 + dt * sigma * 0.25) / (1.0 + dt * sigma), 1e-8);
  });
}

/// What a partner forces it forces alone; the zone's other cells of the same block keep their p.
TEST(SpongeTest, LeavesForcedCellsToThePartner) {
  Block<2> block = deformed_box<2>(8, 0.0, 0.0, 0.0, {true, false});
  close_with<2>(block, Condition::slip);
  for (Window<2>& w : block.windows)
    if (w.direction == 0) w.condition = Condition::periodic;
  const std::size_t size = block.extent.size;
  for_each_index<2>({}, block.extent.n, [&](const std::array<int, 2>& index) {
    if (index[1] < 4) block.status[static_cast<std::size_t>(block.extent.at(index))] = CellStatus::forced;
  });
  Stepper<2> stepper({block}, Equations<2>{}, std::make_unique<MultigridSolver<2>>(), tight());
  stepper.initialise([](const std::array<double, 2>&, double) { return PointState<2>{}; }, 0.0);
  Sponge<2> sponge;
  sponge.axis = 2;
  sponge.to = 1e-9;  // at full strength everywhere
  sponge.rate = 3.0;
  sponge.velocity[0] = [](const std::array<double, 3>&, double) { return 0.25; };
  stepper.set_sponges({sponge});
  Forcing<2>& forcing = stepper.forcing()[0];
  forcing.rate.assign(size, 0.0);
  forcing.target.resize(size);
  for (std::size_t c = 0; c < size; ++c)
    if (block.status[c] == CellStatus::forced) forcing.rate[c] = 5.0, forcing.target.u[0][c] = -1.0;
  forcing.pressure_rate = forcing.rate;
  forcing.psi = 1.0;
  constexpr double dt = 0.1;
  stepper.advance(dt);  // implicit Euler
  for_each_index<2>({}, block.extent.n, [&](const std::array<int, 2>& index) {
    const auto c = static_cast<std::size_t>(block.extent.at(index));
    const double rate = index[1] < 4 ? 5.0 : 3.0, target = index[1] < 4 ? -1.0 : 0.25;
    EXPECT_NEAR(stepper.state()[0].u[0][c], dt * rate * target / (1.0 + dt * rate), 1e-8);
  });
}

TEST(SpongeTest, RadiusAndLowerSide) {
  Sponge<3> ring;
  ring.axis = 3;
  ring.centre = {1.0, 0.0, 0.0};
  ring.from = 2.0;
  ring.to = 4.0;
  ring.rate = 8.0;
  EXPECT_EQ(ring.strength({1.0, 1.9, 0.0}), 0.0);
  EXPECT_NEAR(ring.strength({1.0, 0.0, -3.0}), 8.0 * 0.25, 1e-14);
  EXPECT_NEAR(ring.strength({9.0, 0.0, 0.0}), 8.0, 1e-14);
  Sponge<3> lower;
  lower.from = -1.0;
  lower.to = -2.0;
  lower.rate = 1.0;
  lower.power = 1.0;
  EXPECT_NEAR(lower.strength({-1.5, 0.0, 0.0}), 0.5, 1e-14);
  EXPECT_EQ(lower.strength({0.0, 0.0, 0.0}), 0.0);
}

TEST(FluxSchemeTest, CentralLosesLessOfAVortexThanUpwind) {
  const auto kept = [](FluxScheme flux) {
    Block<2> block = deformed_box<2>(16, 0.0, 0.0, 0.0, {true, true});
    close_with<2>(block, Condition::periodic);
    Equations<2> equations;
    equations.flux = flux;
    InnerTolerance tolerance = tight();
    tolerance.drop = 1e-4;
    Stepper<2> stepper({block}, equations, std::make_unique<MultigridSolver<2>>(), tolerance);
    const auto energy = [&] {
      double sum = 0.0;
      for_each_index<2>({}, block.extent.n, [&](const std::array<int, 2>& index) {
        const auto c = static_cast<std::size_t>(block.extent.at(index));
        for (const auto& u : stepper.state()[0].u) sum += u[c] * u[c] * block.volume[c];
      });
      return sum;
    };
    stepper.initialise(
        [](const std::array<double, 2>& x, double) {
          const double k = 2.0 * M_PI;
          return PointState<2>{
              250.0 * (std::cos(2.0 * k * x[0]) + std::cos(2.0 * k * x[1])),
              {std::sin(k * x[0]) * std::cos(k * x[1]), -std::cos(k * x[0]) * std::sin(k * x[1])}};
        },
        0.0);
    const double before = energy();
    for (int step = 0; step < 20; ++step) stepper.advance(0.02);
    return energy() / before;
  };
  const double upwind = kept(FluxScheme::upwind3), central = kept(FluxScheme::central4);
  EXPECT_LT(upwind, 1.0);
  EXPECT_LT(central, 1.001);               // inviscid: what is gained can only be the time scheme's
  EXPECT_LT(1.0 - central, 1.0 - upwind);  // the dissipation of p_f, with c0, is the same
}

}  // namespace
}  // namespace littoral::fv
