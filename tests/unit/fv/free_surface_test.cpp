#include "free_surface/free_surface.hpp"

#include <gtest/gtest.h>

#include "dual_time/prescribed.hpp"
#include "dual_time/stepper.hpp"
#include "free_surface/line_stencil.hpp"
#include "grid/space.hpp"
#include "grids.hpp"
#include "implicit/multigrid_solver.hpp"
#include "physics/wall_loads.hpp"

// What the free surface does to the flow; phi itself: level_set_test.cpp.
namespace littoral::fv {
namespace {

constexpr double k_g = 9.81, k_rho = 1000.0;

TEST(LineWeightsTest, LinearPressuresAreExactWhereverTheSurfaceIs) {
  const auto p = [](double x) { return 3.0 - 2.0 * x; };  // x: from the water cell towards the air
  for (const double theta : {1e-12, 0.1, 0.4999, 0.5, 0.5001, 0.9, 1.0})
    for (const double behind : {0.7, 1.0, 1.4})
      for (const double at : {0.5, 1.0}) {
        const LineWeights w = line_weights(line_stencil(theta, true, 0.5), theta, behind, at);
        EXPECT_NEAR(w.own * p(0.0) + w.behind * p(-behind) + w.surface * p(theta), p(at), 1e-12);
        EXPECT_NEAR(w.own + w.behind + w.surface, 1.0, 1e-14);
        EXPECT_LE(std::abs(w.own) + std::abs(w.behind), 4.0);  // no small denominator
      }
  // the face's pressure does not jump where the stencil is switched
  const LineWeights below = line_weights(line_stencil(0.5 - 1e-13, true, 0.5), 0.5 - 1e-13, 1.0, 0.5),
                    above = line_weights(line_stencil(0.5, true, 0.5), 0.5, 1.0, 0.5);
  EXPECT_NEAR(below.own, above.own, 1e-12);
  EXPECT_NEAR(below.behind, above.behind, 1e-12);
  EXPECT_EQ(line_stencil(0.2, false, 0.5), LineStencil::surface);  // a film of one cell
}

TEST(LineWeightsTest, CrossingsStayBetweenTheCells) {
  EXPECT_DOUBLE_EQ(crossing(-0.3, 0.1), 0.75);
  EXPECT_EQ(crossing(1e-9, 0.1), 0.0);
  EXPECT_EQ(crossing(-0.1, -1e-9), 1.0);
}

template <int D>
Stepper<D> tank_with_surface(Block<D> block, const Fluid<D>& fluid, const FlowFunction<D>& flow,
                             const Prescribed& surface, double drop = 1e-3) {
  Equations<D> equations;
  equations.fluid = fluid;
  InnerTolerance tolerance;
  tolerance.drop = drop;
  tolerance.floor = 1e-12;
  Stepper<D> stepper({std::move(block)}, equations, std::make_unique<MultigridSolver<D>>(), tolerance);
  stepper.initialise(flow, 0.0);
  stepper.set_surface(surface);
  return stepper;
}

template <int D>
double fastest(const Stepper<D>& stepper, const std::array<double, D>& stream = {}) {
  double speed = 0.0;
  const Block<D>& block = stepper.blocks()[0];
  for (std::size_t c = 0; c < block.solved.size(); ++c)
    for (std::size_t k = 0; k < D && block.solved[c] != 0.0; ++k)
      speed = std::max(speed, std::abs(stepper.state()[0].u[k][c] - stream[k]));
  return speed;
}

/// Water at rest under a plane at any angle, in a tank whose cells are skewed, stretched and curved.
template <int D>
double speed_at_rest(double degrees, double height) {
  Fluid<D> fluid;
  const double angle = degrees * M_PI / 180.0;
  fluid.gravity[0] = k_g * std::sin(angle);
  fluid.gravity[D - 1] = -k_g * std::cos(angle);
  Block<D> block = deformed_box<D>(10);
  close_with<D>(block, Condition::slip);
  const auto level = [=](const std::array<double, D>& x) {  // over the surface
    return (x[D - 1] - height) * std::cos(angle) - (x[0] - 0.7) * std::sin(angle);
  };
  auto stepper = tank_with_surface<D>(
      block, fluid,
      [&](const std::array<double, D>& x, double) {
        return PointState<D>{-k_rho * k_g * level(x), {}};
      },
      [&](const std::array<double, 3>& x, double) {
        std::array<double, D> at;
        for (std::size_t k = 0; k < D; ++k) at[k] = x[axis_in_space<D>(k)];
        return level(at);
      });
  for (int step = 0; step < 3; ++step) stepper.advance(0.02);
  return fastest<D>(stepper);
}

TEST(FreeSurfaceTest, WaterAtRestStaysAtRestAtAnyHeightAndAngleOnAnyGrid) {
  // p - P is one constant on the surface and below: nothing but round-off of 1e4 Pa is left
  for (const double height : {0.43, 0.5, 0.512, 0.55})
    for (const double angle : {0.0, 7.0, 20.0})
      EXPECT_LT(speed_at_rest<2>(angle, height), 1e-9) << height << ' ' << angle;
  EXPECT_LT(speed_at_rest<3>(20.0, 0.51), 1e-9);
}

TEST(FreeSurfaceTest, AColumnRisesUniformlyAndItsFreshCellsMoveWithIt) {
  // inflow from below: the column moves up by W t; cells that turn to water must hold W in all time levels
  constexpr double w = 0.5, dt = 0.02, start = 0.313;
  Block<2> block = make_block<2>("column", {6, 16}, {true, false}, [](const std::array<int, 2>& i) {
    return std::array<double, 2>{i[0] / 16.0, i[1] / 16.0};
  });
  close_with<2>(block, Condition::slip);
  block.windows[0].condition = block.windows[1].condition = Condition::periodic;
  block.windows[2].condition = Condition::inflow;
  block.windows[2].velocity[1] = [](const std::array<double, 3>&, double) { return w; };
  auto stepper = tank_with_surface<2>(
      block, Fluid<2>{},
      [](const std::array<double, 2>&, double) {
        return PointState<2>{0.0, {0.0, w}};
      },
      [](const std::array<double, 3>& x, double) { return x[2] - start; });
  for (int step = 0; step < 30; ++step) stepper.advance(dt);
  EXPECT_LT(fastest<2>(stepper, {0.0, w}), 1e-9);
  const double volume = water_volume<2>(stepper.blocks(), stepper.surface()->phi());
  EXPECT_NEAR(volume, 6.0 / 16.0 * (start + w * 30 * dt), 1e-9);
}

TEST(FreeSurfaceTest, ADropOfOneCellFallsFreely) {
  Fluid<2> fluid;
  fluid.gravity = {0.0, -k_g};
  Block<2> block = make_block<2>("tank", {12, 12}, {true, false}, [](const std::array<int, 2>& i) {
    return std::array<double, 2>{i[0] / 12.0, i[1] / 12.0};
  });
  close_with<2>(block, Condition::slip);
  block.windows[0].condition = block.windows[1].condition = Condition::periodic;
  const std::array<int, 2> drop = {6, 8};
  const double x = block.centre[0][static_cast<std::size_t>(block.extent.at(drop))], z = 8.5 / 12.0;
  auto stepper = tank_with_surface<2>(
      block, fluid, [](const std::array<double, 2>&, double) { return PointState<2>{}; },
      [=](const std::array<double, 3>& at, double) {
        return std::min(at[2] - 0.21, std::hypot(at[0] - x, at[2] - z) - 0.07);
      });
  constexpr double dt = 0.005;
  for (int step = 1; step <= 3; ++step) {
    EXPECT_TRUE(stepper.advance(dt).converged);
    const auto c = static_cast<std::size_t>(stepper.blocks()[0].extent.at(drop));
    ASSERT_EQ(stepper.blocks()[0].solved[c], 1.0);
    // nothing pushes it: p = p0 all around, whatever the mass row of its one cell would have asked for
    EXPECT_NEAR(stepper.state()[0].u[1][c], -k_g * dt * step, 0.02 * k_g * dt * step);
  }
}

TEST(FreeSurfaceTest, AFilmThinnerThanHalfACellGoesWithTheWaterOrDriesUp) {
  // a slab three cells high, before it a film without a single centre in it, ten cells long
  constexpr int n = 40;
  constexpr double h = 1.0 / n, speed = 0.7, dt = 0.4 * h / speed;
  Block<2> block = make_block<2>("floor", {n, 8}, {true, false}, [=](const std::array<int, 2>& i) {
    return std::array<double, 2>{h * i[0], h * i[1]};
  });
  close_with<2>(block, Condition::slip);
  block.windows[0].condition = block.windows[1].condition = Condition::periodic;
  const auto slab = [=](double x, double z, double moved) {
    const double film = std::max(std::abs(x - moved - 0.4) - 0.15, z - 0.31 * h);
    return std::min(film, std::max(std::abs(x - moved - 0.2) - 0.1, z - 3.2 * h));
  };
  auto stepper = tank_with_surface<2>(
      block, Fluid<2>{},
      [=](const std::array<double, 2>&, double) {
        return PointState<2>{0.0, {speed, 0.0}};
      },
      [=](const std::array<double, 3>& x, double) { return slab(x[0], x[2], 0.0); });
  constexpr int steps = 12;
  for (int step = 0; step < steps; ++step) stepper.advance(dt);
  EXPECT_LT(fastest<2>(stepper, {speed, 0.0}), 1e-6 * speed);
  const Block<2>& now = stepper.blocks()[0];
  double far = 0.0;  // where water ends
  for (int i = 0; i < n; ++i) {
    const auto c = static_cast<std::size_t>(now.extent.at({i, 0}));
    if (stepper.surface()->phi()[0][c] < 0.4 * h) far = now.centre[0][c] - steps * speed * dt;
  }
  EXPECT_NEAR(far, 0.3, 2.5 * h);
  constexpr double slab_volume = 0.2 * 3.2 * h, beside = 0.31 * h * 2.0 * h;
  const double volume = water_volume<2>(stepper.blocks(), stepper.surface()->phi());
  EXPECT_GT(volume, 0.95 * slab_volume);  // its corners round off
  EXPECT_LT(volume, 1.01 * slab_volume + beside);
}

TEST(FreeSurfaceTest, WallsBearTheLoadOfTheirWetPartAlone) {
  Fluid<2> fluid;
  fluid.gravity = {0.0, -k_g};
  Equations<2> equations;
  equations.fluid = fluid;
  for (const double depth : {0.43, 0.5, 0.512, 0.55}) {
    Block<2> block = make_block<2>("tank", {6, 10}, {}, [](const std::array<int, 2>& i) {
      return std::array<double, 2>{i[0] / 10.0, i[1] / 10.0};
    });
    close_with<2>(block, Condition::slip);
    for (auto& w : block.windows) w.name = w.direction == 0 && w.side == 1 ? "right" : "rest";
    auto stepper = tank_with_surface<2>(
        block, fluid,
        [=](const std::array<double, 2>& x, double) {
          return PointState<2>{x[1] < depth ? k_rho * k_g * (depth - x[1]) : 7e3, {}};  // nobody's in the air
        },
        [=](const std::array<double, 3>& x, double) { return x[2] - depth; });
    const WallLoads load = wall_loads<2>(stepper.blocks(), equations, stepper.state(), "right", {}, {},
                                         &stepper.surface()->phi());
    EXPECT_NEAR(load.total().force[0], 0.5 * k_rho * k_g * depth * depth, 1e-9 * k_rho * k_g);
  }
}

/// Two discs of water, the left one drawn out by a vortex that ends before the other, which is at rest.
Stepper<2> two_discs(LevelSetOptions::VolumeCorrection correction) {
  Block<2> block = make_block<2>("plane", {32, 16}, {}, [](const std::array<int, 2>& i) {
    return std::array<double, 2>{i[0] / 16.0, i[1] / 16.0};
  });
  close_with<2>(block, Condition::slip);
  const auto vortex = [](const std::array<double, 2>& x, double) {
    const double s = std::sin(M_PI * x[0]), c = std::sin(M_PI * x[1]);
    if (x[0] > 1.0) return std::array<double, 2>{};
    return std::array<double, 2>{s * s * std::sin(2.0 * M_PI * x[1]), -c * c * std::sin(2.0 * M_PI * x[0])};
  };
  Stepper<2> stepper({std::move(block)}, Equations<2>{}, std::make_unique<PrescribedFlow<2>>(vortex), {});
  stepper.initialise(
      [&](const std::array<double, 2>& x, double t) {
        return PointState<2>{0.0, vortex(x, t)};
      },
      0.0);
  LevelSetOptions options;
  options.volume_correction = correction;
  stepper.set_surface(
      [](const std::array<double, 3>& x, double) {
        return std::min(std::hypot(x[0] - 0.5, x[2] - 0.6), std::hypot(x[0] - 1.5, x[2] - 0.5)) - 0.25;
      },
      options);
  return stepper;
}

TEST(VolumeCorrectionTest, EachBodyKeepsItsVolumeAndOneAtRestIsLeftAlone) {
  using Correction = LevelSetOptions::VolumeCorrection;
  Field plain;  // phi without the correction
  for (const Correction correction : {Correction::none, Correction::local}) {
    Stepper<2> stepper = two_discs(correction);
    const double volume = stepper.surface()->budget().volume;
    for (int step = 0; step < 15; ++step) stepper.advance(0.02);
    const VolumeBudget& water = stepper.surface()->budget();
    EXPECT_NEAR(water.volume - volume, water.error, 1e-14);  // nothing comes in
    const Field& phi = stepper.surface()->phi()[0];
    if (correction == Correction::none) {
      EXPECT_GT(std::abs(water.error), 1e-5 * volume);  // there is something to correct
      plain = phi;
      continue;
    }
    EXPECT_LT(std::abs(water.error), 1e-8 * volume);
    const Block<2>& block = stepper.blocks()[0];
    for_each_index<2>({20, 0}, block.extent.n, [&](const std::array<int, 2>& index) {
      const auto c = static_cast<std::size_t>(block.extent.at(index));
      // both settle beside the surface, from starts that differ there
      if (std::abs(plain[c]) >= 0.5 / 16.0) return;
      EXPECT_NEAR(phi[c], plain[c], 1e-9);
    });
  }
}

/// Standing wave of length 1 over depth .5 from its crest: its first mode after some steps, over the start.
struct Wave {
  Stepper<2> stepper;
  int n;
  double elevation_mode() const {
    const Block<2>& block = stepper.blocks()[0];
    const Field& phi = stepper.surface()->phi()[0];
    double mode = 0.0;
    for (int i = 0; i < block.extent.n[0]; ++i)
      for (int j = 0; j + 1 < block.extent.n[1]; ++j) {
        const auto low = static_cast<std::size_t>(block.extent.at({i, j})),
                   up = static_cast<std::size_t>(block.extent.at({i, j + 1}));
        if (phi[low] >= 0.0 || phi[up] < 0.0) continue;
        const double z =
            block.centre[1][low] + crossing(phi[low], phi[up]) * (block.centre[1][up] - block.centre[1][low]);
        mode += 2.0 / n * z * std::cos(2.0 * M_PI * block.centre[0][low]);
      }
    return mode;
  }
};

Wave standing_wave(int n, double amplitude) {
  Fluid<2> fluid;
  fluid.gravity = {0.0, -k_g};
  const double h = 1.0 / n, bottom = -0.5 - 0.3 * h;  // the still level .3 above a face
  Block<2> block = make_block<2>("tank", {n, 3 * n / 4}, {true, false}, [=](const std::array<int, 2>& i) {
    return std::array<double, 2>{h * i[0], bottom + h * i[1]};
  });
  close_with<2>(block, Condition::slip);
  block.windows[0].condition = block.windows[1].condition = Condition::periodic;
  return {tank_with_surface<2>(
              block, fluid,
              [](const std::array<double, 2>& x, double) {
                return PointState<2>{-k_rho * k_g * x[1], {}};
              },
              [=](const std::array<double, 3>& x, double) {
                return x[2] - amplitude * std::cos(2.0 * M_PI * x[0]);
              }),
          n};
}

TEST(FreeSurfaceTest, AStandingWaveSwingsThroughWithoutLoss) {
  const double k = 2.0 * M_PI, h = 1.0 / 32.0;
  const double period = 2.0 * M_PI / std::sqrt(k_g * k * std::tanh(k * (0.5 + 0.3 * h)));
  Wave wave = standing_wave(32, 0.01);
  const double start = wave.elevation_mode(),
               volume = water_volume<2>(wave.stepper.blocks(), wave.stepper.surface()->phi());
  constexpr int steps = 64;  // half a period
  for (int step = 0; step < steps; ++step) wave.stepper.advance(0.5 * period / steps);
  EXPECT_NEAR(wave.elevation_mode() / start, -1.0, 0.01);
  EXPECT_NEAR(water_volume<2>(wave.stepper.blocks(), wave.stepper.surface()->phi()) / volume, 1.0, 2e-4);
}

TEST(FreeSurfaceTest, StepsRepeatAndContinueToTheBit) {
  Wave wave = standing_wave(16, 0.04);
  constexpr double dt = 0.02;
  for (int step = 0; step < 4; ++step) wave.stepper.advance(dt);
  const auto memory = wave.stepper.memory();
  const auto run = [&](Stepper<2>& stepper) {
    for (int step = 0; step < 3; ++step) stepper.advance(dt);
    return stepper.memory();
  };
  Wave other = standing_wave(16, 0.04), third = standing_wave(16, 0.04);
  other.stepper.recall(memory);
  third.stepper.recall(memory);
  const auto plain = run(wave.stepper), continued = run(other.stepper);
  third.stepper.advance(0.5 * dt);
  third.stepper.restore();
  const auto repeated = run(third.stepper);
  for (const auto* again : {&continued, &repeated}) {
    EXPECT_EQ(again->surface.phi[0], plain.surface.phi[0]);
    EXPECT_EQ(again->surface.phi[1], plain.surface.phi[1]);
    EXPECT_EQ(again->level[0][0].p, plain.level[0][0].p);
    EXPECT_EQ(again->level[0][0].u[0], plain.level[0][0].u[0]);
  }
}

/// What is told of water as thin as a cell after a short step from `level` in a tank of n x n cells.
ThinWater<2> thin_water_under(int n, const std::function<double(double, double)>& level) {
  Fluid<2> fluid;
  fluid.gravity = {0.0, -k_g};
  Block<2> tank = make_block<2>("tank", {n, n}, {}, [n](const std::array<int, 2>& i) {
    return std::array<double, 2>{static_cast<double>(i[0]) / n, static_cast<double>(i[1]) / n};
  });
  close_with<2>(tank, Condition::slip);
  Stepper<2> stepper = tank_with_surface<2>(
      tank, fluid, [](const std::array<double, 2>&, double) { return PointState<2>{}; },
      [&](const std::array<double, 3>& x, double) { return level(x[0], x[2]); });
  stepper.advance(1e-3);
  return stepper.surface()->thin_water();
}

TEST(FreeSurfaceTest, WaterAsThinAsACellIsCounted) {
  constexpr int n = 16;
  const auto sheet_over_pool = [](double low, double high) {
    return [=](double, double z) { return std::min(z - 0.2, std::max(low - z, z - high)); };
  };
  const ThinWater<2> sheet = thin_water_under(n, sheet_over_pool(0.5, 0.5 + 1.0 / n));
  EXPECT_EQ(sheet.cells, n);
  EXPECT_NEAR(sheet.place[1], 0.5 + 0.5 / n, 1e-12);
  EXPECT_EQ(thin_water_under(n, sheet_over_pool(0.5, 0.5 + 3.0 / n)).cells, 0.0);
  const auto drop = [](double x, double z) {
    return std::min(z - 0.2, std::hypot(x - 0.5 - 0.5 / n, z - 0.7 - 0.05 / n) - 0.7 / n);
  };
  EXPECT_GT(thin_water_under(n, drop).cells, 0.0);
}

TEST(FreeSurfaceTest, TheTopOfAGentleCrestIsNotThinThoughAirIsOnBothItsSides) {
  constexpr int n = 16;
  for (const double height : {0.4, 0.45, 0.5})
    for (const double steepness : {1e-9, 0.05, 0.3, 0.7}) {
      const double k = 2.0 * M_PI, shift = 0.5 / n;
      // just over the centres of the row under the crest
      const double level = (std::floor(height * n) + 0.5) / n + 1e-12 - steepness / k;
      const auto wave = [=](double x, double z) {
        return z - level - steepness / k * std::cos(k * (x - 0.5 - shift));
      };
      EXPECT_EQ(thin_water_under(n, wave).cells, 0.0) << height << ' ' << steepness;
    }
}

}  // namespace
}  // namespace littoral::fv
