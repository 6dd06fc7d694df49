#include <gtest/gtest.h>

#include <numeric>

#include "dual_time/plain.hpp"
#include "dual_time/stepper.hpp"
#include "grids.hpp"
#include "implicit/multigrid_solver.hpp"
#include "physics/wall_loads.hpp"

namespace littoral::fv {
namespace {

InnerTolerance tight() {
  InnerTolerance tolerance;
  tolerance.drop = 1e-8;
  tolerance.floor = 1e-11;
  tolerance.max_cycles = 200;
  return tolerance;
}

/// Channel between plates at z = 0 and 1, periodic along x; stretching moves cells towards the lower plate.
Stepper<2> channel(int n, double stretching, double lid_speed) {
  Block<2> block = make_block<2>("channel", {4, n}, {true, false}, [=](const std::array<int, 2>& i) {
    const double s = static_cast<double>(i[1]) / n;
    return std::array<double, 2>{0.25 * i[0],
                                 stretching == 0.0 ? s : std::expm1(stretching * s) / std::expm1(stretching)};
  });
  close_with<2>(block, Condition::wall);
  block.windows[0].condition = block.windows[1].condition = Condition::periodic;
  block.windows[3].velocity[0] = [=](const std::array<double, 3>&, double) { return lid_speed; };
  block.windows[3].name = "lid";
  Equations<2> equations;
  equations.fluid.viscosity = 0.1;
  return Stepper<2>({block}, equations, std::make_unique<MultigridSolver<2>>(), tight());
}

double worst_profile_error(const Stepper<2>& stepper, const std::function<double(double)>& exact) {
  const Block<2>& block = stepper.blocks()[0];
  double worst = 0.0;
  for (int j = 0; j < block.extent.n[1]; ++j) {
    const auto c = static_cast<std::size_t>(block.extent.at({1, j}));
    worst = std::max(worst, std::abs(stepper.state()[0].u[0][c] - exact(block.centre[1][c])));
  }
  return worst;
}

TEST(ChannelTest, CouetteIsLinearOnAnyGrid) {
  for (const double stretching : {0.0, 2.0}) {
    Stepper<2> stepper = channel(16, stretching, 1.0);
    stepper.initialise([](const std::array<double, 2>&, double) { return PointState<2>{}; }, 0.0);
    for (int step = 0; step < 6; ++step) stepper.advance(1e3);
    EXPECT_LT(worst_profile_error(stepper, [](double z) { return z; }), 1e-6);
    // the water holds the lid back with mu du/dz, 4 cells of .25
    const WallLoads f = wall_loads<2>(stepper.blocks(), stepper.equations(), stepper.state(), "lid", {});
    EXPECT_NEAR(f.viscous.force[0], -1000.0 * 0.1 * 1.0, 1e-3);
    EXPECT_NEAR(f.viscous.moment[1], 1.0 * f.viscous.force[0], 1e-6);  // the lid lies at z = 1
    EXPECT_NEAR(f.pressure.force[0], 0.0, 1e-6);
    // y+ = d sqrt(nu du/dz)/nu
    const Block<2>& block = stepper.blocks()[0];
    const double d = 1.0 - block.centre[1][static_cast<std::size_t>(block.extent.at({0, 15}))];
    const WallUnits units = wall_units<2>(stepper.blocks(), stepper.equations(), stepper.state(), "lid");
    EXPECT_NEAR(units.largest, d / std::sqrt(0.1), 1e-6);
    EXPECT_NEAR(units.mean, units.largest, 1e-9);
  }
}

TEST(ChannelTest, PoiseuilleIsAParabola) {
  // u = z(1-z)/2 under the force mu: quadratic ghosts and central friction are exact for it on equal cells,
  // so the limit is the inner tolerance; on stretched cells second order, gate 0.1% of the largest
  for (const auto& [stretching, gate] : {std::pair{0.0, 1e-7}, std::pair{1.0, 1e-3 * 0.125}}) {
    Stepper<2> stepper = channel(32, stretching, 0.0);
    stepper.set_source([](const std::array<double, 2>&, double) {
      Source<2> s;
      s.momentum[0] = 1000.0 * 0.1;
      return s;
    });
    stepper.initialise([](const std::array<double, 2>&, double) { return PointState<2>{}; }, 0.0);
    for (int step = 0; step < 6; ++step) stepper.advance(1e3);
    EXPECT_LT(worst_profile_error(stepper, [](double z) { return 0.5 * z * (1.0 - z); }), gate);
  }
}

TEST(OpenBoundaryTest, ADisturbanceLeavesAStreamUnderGravity) {
  // inflow and outflow, or far field at both ends: what is left after 6 transits is the stream over
  // still-water pressure; 1e-3 is what an outflow that holds the pressure gives back of a 20% disturbance
  for (const auto& [in, out] : {std::pair{Condition::inflow, Condition::outflow},
                                std::pair{Condition::far_field, Condition::far_field}}) {
    Block<2> block = make_block<2>("flume", {24, 8}, {}, [](const std::array<int, 2>& i) {
      return std::array<double, 2>{i[0] / 8.0, i[1] / 8.0};
    });
    close_with<2>(block, Condition::slip, {[](const auto&, double) { return 1.0; }, {}});
    block.windows[0].condition = in;
    block.windows[1].condition = out;
    block.windows[3].condition = Condition::symmetry;
    Equations<2> equations;
    equations.fluid.gravity = {0.0, -9.81};
    Stepper<2> stepper({block}, equations, std::make_unique<MultigridSolver<2>>(), tight());
    stepper.initialise(
        [&](const std::array<double, 2>& x, double) {
          const double bump = std::exp(-20.0 * (std::pow(x[0] - 1.0, 2) + std::pow(x[1] - 0.5, 2)));
          return PointState<2>{equations.fluid.hydrostatic(x), {1.0 + 0.2 * bump, 0.0}};
        },
        0.0);
    stepper.tolerance().drop = 1e-3;
    for (int step = 0; step < 90; ++step) stepper.advance(0.2);
    const State<2>& q = stepper.state()[0];
    for_each_index<2>({}, block.extent.n, [&](const std::array<int, 2>& index) {
      const auto c = static_cast<std::size_t>(block.extent.at(index));
      EXPECT_NEAR(q.u[0][c], 1.0, 1e-3);
      EXPECT_NEAR(q.u[1][c], 0.0, 1e-3);
      EXPECT_NEAR(q.p[c], stepper.blocks()[0].reference_pressure[c], 1.0);  // 1e-3 rho U^2
    });
  }
}

/// A smooth flow that solves nothing, and the sources that make it a solution: the rates of (3) by
/// fourth-order differences of its exact fluxes (error 1e-10 of the terms).
template <int D>
struct Manufactured {
  Fluid<D> fluid;
  using X = std::array<double, D>;
  static constexpr double k = 2.0;

  PointState<D> flow(const X& x, double t) const {
    PointState<D> s;
    const double swing = 1.0 + 0.2 * std::sin(1.5 * t);
    double product = 1.0;
    for (std::size_t d = 0; d < D; ++d) product *= std::cos(k * x[d] - 0.3 * static_cast<double>(d));
    s.p = fluid.density * 0.5 * product * swing;
    for (std::size_t c = 0; c < D; ++c) {
      double wave = 0.4 * std::sin(k * x[c] + 0.4 + static_cast<double>(c));
      for (std::size_t d = 0; d < D; ++d)
        if (d != c) wave *= std::cos(k * x[d] + 0.2 * static_cast<double>(c));
      s.u[c] = (c == 0 ? 0.8 : 0.5) + wave * swing;
    }
    return s;
  }
  template <class F>
  static auto slope(F&& f) {
    const double e = 2e-3;
    return (8.0 * (f(e) - f(-e)) - (f(2.0 * e) - f(-2.0 * e))) / (12.0 * e);
  }
  static X moved(X x, std::size_t d, double e) {
    x[d] += e;
    return x;
  }
  double traction(const X& x, double t, std::size_t c, std::size_t d) const {
    const double a = slope([&](double e) { return flow(moved(x, d, e), t).u[c]; });
    const double b = slope([&](double e) { return flow(moved(x, c, e), t).u[d]; });
    return fluid.density * fluid.viscosity * (a + b);
  }
  Source<D> source(const X& x, double t) const {
    Source<D> s;
    const auto rho = [&](const PointState<D>& q) { return fluid.rho(q.p); };
    s.mass = slope([&](double e) { return rho(flow(x, t + e)); });
    for (std::size_t d = 0; d < D; ++d)
      s.mass += slope([&](double e) {
        const auto q = flow(moved(x, d, e), t);
        return rho(q) * q.u[d];
      });
    for (std::size_t c = 0; c < D; ++c) {
      s.momentum[c] = slope([&](double e) {
        const auto q = flow(x, t + e);
        return rho(q) * q.u[c];
      });
      for (std::size_t d = 0; d < D; ++d)
        s.momentum[c] += slope([&](double e) {
          const X y = moved(x, d, e);
          const auto q = flow(y, t);
          return rho(q) * q.u[c] * q.u[d] + (c == d ? q.p : 0.0) - traction(y, t, c, d);
        });
    }
    return s;
  }
};

/// L2 error of u after time .2 on n cells a direction of a deformed box, n/4 steps.
template <int D>
double manufactured_error(int n, double inverse_c2) {
  Manufactured<D> made;
  made.fluid.inverse_c2 = inverse_c2;
  made.fluid.viscosity = 0.02;
  // the same smooth mapping on every level: only then is the order that of the scheme
  std::array<int, D> cells;
  cells.fill(n);
  Block<D> block = make_block<D>("made", cells, {}, [n](const std::array<int, D>& index) {
    std::array<double, D> s, x;
    for (std::size_t d = 0; d < D; ++d) s[d] = static_cast<double>(index[d]) / n;
    for (std::size_t d = 0; d < D; ++d) x[d] = s[d] + 0.06 * s[d] * s[d] + (d == 0 ? 0.15 * s[D - 1] : 0.0);
    return x;
  });
  std::array<Prescribed, D> velocity;
  const auto place = [](const std::array<double, 3>& x) {
    if constexpr (D == 2)
      return std::array<double, 2>{x[0], x[2]};
    else
      return x;
  };
  for (std::size_t c = 0; c < D; ++c)
    velocity[c] = [=](const std::array<double, 3>& x, double t) { return made.flow(place(x), t).u[c]; };
  close_with<D>(block, Condition::state, velocity,
                [=](const std::array<double, 3>& x, double t) { return made.flow(place(x), t).p; });
  Equations<D> equations;
  equations.fluid = made.fluid;
  InnerTolerance tolerance = tight();
  tolerance.drop = 1e-6;
  Stepper<D> stepper({block}, equations, std::make_unique<MultigridSolver<D>>(), tolerance);
  stepper.initialise([&](const auto& x, double t) { return made.flow(x, t); }, 0.0);
  stepper.set_source([=](const auto& x, double t) { return made.source(x, t); });
  const int steps = n / 2;
  for (int step = 0; step < steps; ++step) stepper.advance(0.2 / steps);
  double sum = 0.0, volume = 0.0;
  for_each_index<D>({}, block.extent.n, [&](const std::array<int, D>& index) {
    const auto c = static_cast<std::size_t>(block.extent.at(index));
    std::array<double, D> x;
    for (std::size_t d = 0; d < D; ++d) x[d] = block.centre[d][c];
    const PointState<D> exact = made.flow(x, stepper.time());
    for (std::size_t d = 0; d < D; ++d) {
      const double e = stepper.state()[0].u[d][c] - exact.u[d];
      sum += block.volume[c] * e * e;
    }
    volume += block.volume[c];
  });
  return std::sqrt(sum / volume);
}

TEST(ManufacturedTest, ErrorsFallWithSecondOrderIn2D) {
  for (const double inverse_c2 : {0.0, 0.01}) {
    const double coarse = manufactured_error<2>(12, inverse_c2), fine = manufactured_error<2>(24, inverse_c2);
    EXPECT_GT(std::log2(coarse / fine), 1.8) << coarse << " " << fine;
  }
}

TEST(ManufacturedTest, ErrorsFallWithSecondOrderIn3D) {
  const double coarse = manufactured_error<3>(6, 0.0), fine = manufactured_error<3>(12, 0.0);
  EXPECT_GT(std::log2(coarse / fine), 1.8) << coarse << " " << fine;
}

}  // namespace
}  // namespace littoral::fv
