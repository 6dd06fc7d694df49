#include <gtest/gtest.h>

#include <random>

#include "dual_time/stepper.hpp"
#include "implicit/multigrid_solver.hpp"
#include "split_grids.hpp"

// Blocks joined in any orientation are the one block they were cut from.
namespace littoral::fv {
namespace {

template <int D>
std::array<std::vector<int>, D> cuts_of() {
  if constexpr (D == 2)
    return {std::vector<int>{4, 6, 3}, std::vector<int>{5, 4}};
  else
    return {std::vector<int>{4, 3}, std::vector<int>{3, 4}, std::vector<int>{2, 5}};
}

template <int D>
Equations<D> water(double inverse_c2, double viscosity, Limiter limiter = Limiter::none) {
  Equations<D> e;
  e.fluid.density = 1.0;
  e.fluid.inverse_c2 = inverse_c2;
  e.fluid.viscosity = viscosity;
  e.limiter = limiter;
  return e;
}

/// Residuals of all blocks for states given in the whole's cells.
template <int D>
std::vector<Residual<D>> residuals(std::vector<Block<D>>& blocks, const Equations<D>& equations,
                                   std::vector<State<D>>& q) {
  for (auto& block : blocks) {
    set_reference_pressure(block, equations.fluid);
    evaluate_windows(block, equations, 0.0);
  }
  const Exchange<D> exchange(blocks);
  exchange.states(blocks, q);
  std::vector<Residual<D>> r(blocks.size());
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    History<D> none;
    none.resize(blocks[b].extent.size);
    equations.residual(blocks[b], q[b], BackwardDifference::first_order(0.1), none, Forcing<D>{}, r[b]);
  }
  exchange.share_fluxes(blocks, equations.fluid, q, r);
  return r;
}

template <int D>
State<D> random_state(const Block<D>& block, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  State<D> q;
  q.resize(block.extent.size);
  for_each_index<D>({}, block.extent.n, [&](const std::array<int, D>& index) {
    const auto c = static_cast<std::size_t>(block.extent.at(index));
    q.p[c] = value(random);
    for (std::size_t k = 0; k < D; ++k) q.u[k][c] = 0.5 + value(random);
  });
  return q;
}

template <int D>
std::vector<State<D>> deal(const SplitGrid<D>& s, const State<D>& whole) {
  std::vector<State<D>> q(s.parts.size());
  for (std::size_t b = 0; b < q.size(); ++b) q[b].resize(s.parts[b].extent.size);
  s.for_each_cell_of_parts([&](std::size_t b, std::size_t part, std::size_t from) {
    q[b].p[part] = whole.p[from];
    for (std::size_t k = 0; k < D; ++k) q[b].u[k][part] = whole.u[k][from];
  });
  return q;
}

template <int D>
Window<D> closed_by(int d, int side, unsigned shift) {
  Window<D> w;
  w.name = std::to_string(d) + std::to_string(side);
  const Condition kinds[] = {Condition::wall, Condition::outflow, Condition::inflow,
                             Condition::slip, Condition::state,   Condition::far_field};
  w.condition = kinds[(static_cast<unsigned>(2 * d + side) + shift) % 6];
  for (std::size_t k = 0; k < D; ++k)
    w.velocity[k] = [k](const std::array<double, 3>& x, double) {
      return 0.3 + 0.1 * std::sin(2.0 * M_PI * x[k]);
    };
  return w;
}

/// Random states, all conditions, friction and gravity: each cell's residual is the one block's. Not
/// compared: cells beside two windows, whose common ghosts are filled in the order of the block's own
/// directions.
template <int D>
double difference_from_whole(const std::array<bool, D>& periodic, unsigned seed, Limiter limiter) {
  auto s = split_grid<D>(
      cuts_of<D>(), periodic, periodic[0] ? wavy<D> : skewed<D>,
      [seed](int d, int side) { return closed_by<D>(d, side, seed); }, seed);
  Equations<D> equations = water<D>(1e-2, 0.05, limiter);
  if (!periodic[D - 1]) equations.fluid.gravity[D - 1] = -1.0;
  std::vector<Block<D>> one{s.whole};
  std::vector<State<D>> q_one{random_state(s.whole, seed + 7)};
  auto q = deal(s, q_one[0]);
  const auto r_one = residuals(one, equations, q_one);
  const auto r = residuals(s.parts, equations, q);
  double worst = 0.0;
  s.for_each_cell_of_parts([&](std::size_t b, std::size_t part, std::size_t whole) {
    const auto index = s.whole.extent.index(static_cast<std::ptrdiff_t>(whole));
    int beside = 0;
    for (std::size_t d = 0; d < D; ++d)
      if (!periodic[d] && (index[d] == 0 || index[d] == s.whole.extent.n[d] - 1)) ++beside;
    if (beside > 1) return;
    worst = std::max(worst, std::abs(r[b].mass[part] - r_one[0].mass[whole]));
    for (std::size_t k = 0; k < D; ++k)
      worst = std::max(worst, std::abs(r[b].momentum[k][part] - r_one[0].momentum[k][whole]));
  });
  return worst;
}

TEST(JoinsTest, ResidualIsThatOfTheOneBlockInAnyOrientation) {
  for (unsigned seed = 0; seed < 8; ++seed)
    for (const Limiter limiter : {Limiter::none, Limiter::van_albada}) {
      EXPECT_LT(difference_from_whole<2>({false, false}, seed, limiter), 1e-13) << seed;
      EXPECT_LT(difference_from_whole<2>({true, true}, seed, limiter), 1e-13) << seed;
      EXPECT_LT(difference_from_whole<2>({true, false}, seed, limiter), 1e-13) << seed;
    }
  for (unsigned seed = 0; seed < 8; ++seed) {
    EXPECT_LT(difference_from_whole<3>({false, false, false}, seed, Limiter::none), 1e-13) << seed;
    EXPECT_LT(difference_from_whole<3>({true, true, true}, seed, Limiter::van_albada), 1e-13) << seed;
  }
}

template <int D>
double uniform_stream(unsigned seed) {
  const auto close = [](int, int) {
    Window<D> w;
    w.condition = Condition::state;
    for (std::size_t k = 0; k < D; ++k)
      w.velocity[k] = [k](const std::array<double, 3>&, double) {
        return 1.0 - 0.6 * static_cast<double>(k);
      };
    w.pressure = [](const std::array<double, 3>&, double) { return 3.5; };
    return w;
  };
  auto s = split_grid<D>(cuts_of<D>(), {}, skewed<D>, close, seed);
  const Equations<D> equations = water<D>(1e-2, 0.01);
  std::vector<State<D>> q(s.parts.size());
  for (std::size_t b = 0; b < q.size(); ++b) {
    q[b].resize(s.parts[b].extent.size);
    q[b].p.assign(q[b].p.size(), 3.5);
    for (std::size_t k = 0; k < D; ++k) q[b].u[k].assign(q[b].p.size(), 1.0 - 0.6 * static_cast<double>(k));
  }
  for (auto& block : s.parts) {
    set_reference_pressure(block, equations.fluid);
    evaluate_windows(block, equations, 0.0);
  }
  Exchange<D>(s.parts).states(s.parts, q);
  double worst = 0.0;
  for (std::size_t b = 0; b < q.size(); ++b) {
    History<D> none;
    none.resize(s.parts[b].extent.size);
    Residual<D> r;
    equations.residual(s.parts[b], q[b], BackwardDifference::steady(), none, Forcing<D>{}, r);
    worst = std::max(worst, largest(s.parts[b], r, 1.0, 1.0));
  }
  return worst;
}

TEST(JoinsTest, UniformStreamIsASolutionAcrossJoins) {
  for (unsigned seed = 0; seed < 6; ++seed) {
    EXPECT_LT(uniform_stream<2>(seed), 1e-12);
    EXPECT_LT(uniform_stream<3>(seed), 1e-12);
  }
}

/// Where everything is joined with something, what leaves a cell enters another.
template <int D>
double sum_over_closed_torus(unsigned seed) {
  std::array<bool, D> periodic;
  periodic.fill(true);
  auto s = split_grid<D>(
      cuts_of<D>(), periodic, wavy<D>, [](int d, int side) { return closed_by<D>(d, side, 0); }, seed);
  const Equations<D> equations = water<D>(0.0, 0.05);
  auto q = deal(s, random_state(s.whole, seed));
  for (auto& block : s.parts) set_reference_pressure(block, equations.fluid);
  Exchange<D>(s.parts).states(s.parts, q);
  std::array<double, D + 1> sum{};
  for (std::size_t b = 0; b < q.size(); ++b) {
    History<D> none;
    none.resize(s.parts[b].extent.size);
    Residual<D> r;
    equations.residual(s.parts[b], q[b], BackwardDifference::steady(), none, Forcing<D>{}, r);
    for_each_index<D>({}, s.parts[b].extent.n, [&](const std::array<int, D>& index) {
      const auto c = static_cast<std::size_t>(s.parts[b].extent.at(index));
      sum[D] += r.mass[c];
      for (std::size_t k = 0; k < D; ++k) sum[k] += r.momentum[k][c];
    });
  }
  double worst = 0.0;
  for (double x : sum) worst = std::max(worst, std::abs(x));
  return worst;
}

TEST(JoinsTest, AFaceOfTwoBlocksHasOneFlux) {
  for (unsigned seed = 1; seed < 6; ++seed) {
    EXPECT_LT(sum_over_closed_torus<2>(seed), 1e-13);
    EXPECT_LT(sum_over_closed_torus<3>(seed), 1e-13);
  }
}

/// Steps of the stepper: what the inner solver reaches in blocks is what it reaches in one, at the same cost.
template <int D>
void compare_steps(const std::array<std::vector<int>, D>& cuts, int extra_cycles) {
  std::array<bool, D> periodic;
  periodic.fill(true);
  periodic[D - 1] = false;
  const auto close = [](int, int) {
    Window<D> w;
    w.condition = Condition::wall;
    return w;
  };
  const auto s = split_grid<D>(cuts, periodic, wavy<D>, close, 5);
  const Equations<D> equations = water<D>(0.0, 0.01);
  InnerTolerance tolerance;
  tolerance.drop = 1e-8;
  const auto flow = [](const std::array<double, D>& x, double) {
    PointState<D> q;
    q.u[0] = 1.0 + 0.3 * std::sin(2.0 * M_PI * x[D - 1]) * std::cos(2.0 * M_PI * (x[0] - 0.25 * x[D - 1]));
    q.u[D - 1] = 0.2 * std::cos(2.0 * M_PI * (x[0] - 0.25 * x[D - 1]));
    return q;
  };
  Stepper<D> one({s.whole}, equations, std::make_unique<MultigridSolver<D>>(), tolerance);
  Stepper<D> many(s.parts, equations, std::make_unique<MultigridSolver<D>>(), tolerance);
  one.initialise(flow, 0.0);
  many.initialise(flow, 0.0);
  int cycles_one = 0, cycles_many = 0;
  constexpr int steps = 3;
  for (int i = 0; i < steps; ++i) {
    cycles_one += one.advance(0.02).cycles;
    const StepReport report = many.advance(0.02);
    EXPECT_TRUE(report.converged);
    cycles_many += report.cycles;
  }
  EXPECT_LE(cycles_many, cycles_one + steps * extra_cycles) << cycles_one << " cycles as one block";
  double worst = 0.0;
  s.for_each_cell_of_parts([&](std::size_t b, std::size_t part, std::size_t whole) {
    for (std::size_t k = 0; k < D; ++k)
      worst = std::max(worst, std::abs(many.state()[b].u[k][part] - one.state()[0].u[k][whole]));
  });
  EXPECT_LT(worst, 1e-7) << D;
  std::printf("[ cycles ] %d-D: %d as one block, %d joined\n", D, cycles_one, cycles_many);
}

TEST(JoinsTest, StepsOfTurnedBlocksAreThoseOfOneBlock) {
  compare_steps<2>({std::vector<int>{16, 16}, std::vector<int>{8, 16}}, 2);
  compare_steps<3>({std::vector<int>{8, 8}, std::vector<int>{8}, std::vector<int>{4, 8}}, 2);
}

/// Three blocks around one vertex: no cell is beyond it for all of them. Velocities near the vertex only, so
/// that nothing passes the walls: what leaves one block must enter another.
TEST(JoinsTest, WhereThreeBlocksMeetAFaceStillHasOneFlux) {
  constexpr int n = 8;
  std::vector<Block<2>> blocks;
  const auto ray = [](int k) {
    const double a = M_PI * (0.5 + 2.0 / 3.0 * k);
    return std::array<double, 2>{std::cos(a), std::sin(a)};
  };
  for (int k = 0; k < 3; ++k) {
    blocks.push_back(make_block<2>("third" + std::to_string(k), {n, n}, {}, [&](const std::array<int, 2>& i) {
      std::array<double, 2> x;
      for (std::size_t d = 0; d < 2; ++d) x[d] = (i[0] * ray(k)[d] + i[1] * ray(k + 1)[d]) / n;
      return x;
    }));
    close_with<2>(blocks.back(), Condition::wall);
    for (auto& w : blocks.back().windows) w.request.kind = JoinRequest<2>::Kind::if_met;
  }
  ASSERT_EQ(find_joins(blocks).size(), 3u);
  EXPECT_EQ(Exchange<2>(blocks).irregular().size(), 3u);
  const Equations<2> equations = water<2>(0.0, 0.7);
  std::vector<State<2>> q;
  for (std::size_t b = 0; b < 3; ++b) {
    q.push_back(random_state(blocks[b], 3 + static_cast<unsigned>(b)));
    for_each_index<2>({}, blocks[b].extent.n, [&](const std::array<int, 2>& index) {
      const auto c = static_cast<std::size_t>(blocks[b].extent.at(index));
      if (std::max(index[0], index[1]) < n - 4) return;
      q[b].p[c] = q[b].u[0][c] = q[b].u[1][c] = 0.0;
    });
  }
  const auto r = residuals(blocks, equations, q);
  // the time term is no flux
  std::array<double, 3> sum{};
  for (std::size_t b = 0; b < 3; ++b)
    for_each_index<2>({}, blocks[b].extent.n, [&](const std::array<int, 2>& index) {
      const auto c = static_cast<std::size_t>(blocks[b].extent.at(index));
      sum[2] += r[b].mass[c];
      for (std::size_t k = 0; k < 2; ++k)
        sum[k] += r[b].momentum[k][c] - 10.0 * blocks[b].volume[c] * q[b].u[k][c];
    });
  for (const double total : sum) EXPECT_LT(std::abs(total), 1e-13);
}

/// Decaying vortices over skewed blocks turned at random: the solution of one block, and its order by the
/// differences of the energy left on three grids.
TEST(JoinsTest, DecayingVorticesKeepTheirOrderAcrossJoins) {
  const double nu = 0.02, k = 2.0 * M_PI;
  const auto flow = [=](const std::array<double, 2>& x, double) {
    // in coordinates along the sheared box, whose periods are (1, 0) and (.25, 1)
    const double a = k * (x[0] - 0.25 * x[1]), b = k * x[1];
    PointState<2> q;  // of the stream function sin(a) sin(b) / k
    q.u = {-0.25 * std::cos(a) * std::sin(b) + std::sin(a) * std::cos(b), -std::cos(a) * std::sin(b)};
    return q;
  };
  const auto run = [&](const std::vector<Block<2>>& blocks, int n) {
    InnerTolerance tolerance;
    tolerance.drop = 1e-6;
    auto stepper = std::make_unique<Stepper<2>>(blocks, water<2>(0.0, nu),
                                                std::make_unique<MultigridSolver<2>>(), tolerance);
    stepper->initialise(flow, 0.0);
    for (int i = 0; i < n / 4; ++i) stepper->advance(0.2 / (n / 4));
    return stepper;
  };
  const auto close = [](int, int) { return Window<2>{}; };
  double energy[3];
  for (int level = 0; level < 3; ++level) {
    const int n = 16 << level;
    const auto s = split_grid<2>({std::vector<int>{n / 4, n / 2, n / 4}, {n / 2, n / 2}}, {true, true},
                                 wavy<2>, close, 11);
    const auto one = run({s.whole}, n), many = run(s.parts, n);
    double worst = 0.0;
    energy[level] = 0.0;
    s.for_each_cell_of_parts([&](std::size_t b, std::size_t part, std::size_t whole) {
      for (std::size_t d = 0; d < 2; ++d) {
        const double u = many->state()[b].u[d][part];
        worst = std::max(worst, std::abs(u - one->state()[0].u[d][whole]));
        energy[level] += 0.5 * s.parts[b].volume[part] * u * u;
      }
    });
    EXPECT_LT(worst, 1e-5) << n;
  }
  EXPECT_GT(std::log2((energy[1] - energy[0]) / (energy[2] - energy[1])), 1.8)
      << energy[0] << " " << energy[1] << " " << energy[2];
}

}  // namespace
}  // namespace littoral::fv
