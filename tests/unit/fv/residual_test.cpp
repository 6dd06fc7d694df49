#include <gtest/gtest.h>

#include "grids.hpp"

namespace littoral::fv {
namespace {

template <int D>
Residual<D> evaluate(Block<D>& block, const Equations<D>& equations, State<D>& q,
                     const BackwardDifference& time = BackwardDifference::steady()) {
  evaluate_windows(block, equations, 0.0);
  fill_ghosts(block, q);
  History<D> history;
  history.resize(block.extent.size);
  Residual<D> r;
  equations.residual(block, q, time, history, Forcing<D>{}, r);
  return r;
}

template <int D>
double stream_residual(Limiter limiter, double inverse_c2, double viscosity) {
  Block<D> block = deformed_box<D>(8);
  Equations<D> equations;
  equations.fluid.inverse_c2 = inverse_c2;
  equations.fluid.viscosity = viscosity;
  equations.limiter = limiter;
  set_reference_pressure(block, equations.fluid);
  const std::array<double, 3> stream = {1.0, -0.3, 0.7};
  std::array<Prescribed, D> velocity;
  for (std::size_t k = 0; k < D; ++k)
    velocity[k] = [u = stream[k]](const std::array<double, 3>&, double) { return u; };
  close_with<D>(block, Condition::state, velocity,
                [](const std::array<double, 3>&, double) { return 350.0; });
  State<D> q;
  q.resize(block.extent.size);
  for_each_index<D>({}, block.extent.n, [&](const std::array<int, D>& index) {
    const auto c = static_cast<std::size_t>(block.extent.at(index));
    q.p[c] = 350.0;
    for (std::size_t k = 0; k < D; ++k) q.u[k][c] = stream[k];
  });
  const Residual<D> r = evaluate(block, equations, q);
  const double face = std::pow(0.125, D - 1);
  return largest(block, r, 1000.0 * face, 1000.0 * face);
}

TEST(ResidualTest, UniformStreamIsASolutionOnADeformedGrid) {
  for (const Limiter limiter : {Limiter::none, Limiter::van_albada})
    for (const double inverse_c2 : {0.0, 1e-2})
      for (const double viscosity : {0.0, 0.01}) {
        EXPECT_LT(stream_residual<2>(limiter, inverse_c2, viscosity), 1e-12);
        EXPECT_LT(stream_residual<3>(limiter, inverse_c2, viscosity), 1e-12);
      }
}

template <int D>
double rest_residual(double inverse_c2, Condition condition) {
  Block<D> block = deformed_box<D>(8);
  Equations<D> equations;
  equations.fluid.inverse_c2 = inverse_c2;
  equations.fluid.viscosity = 1e-3;
  equations.fluid.gravity[D - 1] = -9.81;
  set_reference_pressure(block, equations.fluid);
  close_with<D>(block, condition);
  State<D> q;
  q.resize(block.extent.size);
  q.p = block.reference_pressure;
  const Residual<D> r = evaluate(block, equations, q, BackwardDifference::first_order(0.01));
  const double weight = 1000.0 * 9.81 * std::pow(0.125, D);
  return largest(block, r, 1000.0 * std::pow(0.125, D - 1), weight);
}

TEST(ResidualTest, WaterAtRestStaysAtRestOnADeformedGrid) {
  // pressures are carried relative to the exact hydrostatic one: nothing but round-off is left
  for (const Condition condition :
       {Condition::wall, Condition::slip, Condition::symmetry, Condition::outflow})
    for (const double inverse_c2 : {0.0, 1.0 / 98.1}) {
      EXPECT_LT(rest_residual<2>(inverse_c2, condition), 1e-12) << name(condition);
      EXPECT_LT(rest_residual<3>(inverse_c2, condition), 1e-12) << name(condition);
    }
}

TEST(ResidualTest, RowsOfBlankedAndFringeCellsAreZero) {
  Block<2> block = deformed_box<2>(6);
  Equations<2> equations;
  set_reference_pressure(block, equations.fluid);
  close_with<2>(block, Condition::wall);
  const auto blanked = static_cast<std::size_t>(block.extent.at({2, 3}));
  const auto fringe = static_cast<std::size_t>(block.extent.at({3, 3}));
  const auto forced = static_cast<std::size_t>(block.extent.at({4, 4}));
  block.status[blanked] = CellStatus::blanked;
  block.status[fringe] = CellStatus::fringe;
  block.status[forced] = CellStatus::forced;
  set_solved_mask(block);
  State<2> q;
  q.resize(block.extent.size);
  for (std::size_t c = 0; c < q.p.size(); ++c) {
    q.p[c] = std::sin(1.0 * static_cast<double>(c));
    q.u[0][c] = std::cos(2.0 * static_cast<double>(c));
  }
  const Residual<2> r = evaluate(block, equations, q);
  for (const std::size_t c : {blanked, fringe}) {
    EXPECT_EQ(r.mass[c], 0.0);
    EXPECT_EQ(r.momentum[0][c], 0.0);
    EXPECT_EQ(r.momentum[1][c], 0.0);
  }
  EXPECT_NE(r.mass[forced], 0.0);
}

TEST(ResidualTest, ForcingActsOnForcedCellsOnly) {
  Block<2> block = deformed_box<2>(6);
  Equations<2> equations;
  set_reference_pressure(block, equations.fluid);
  close_with<2>(block, Condition::wall);
  State<2> q;
  q.resize(block.extent.size);
  Forcing<2> forcing;
  const auto c = static_cast<std::size_t>(block.extent.at({2, 2}));
  forcing.rate.assign(block.extent.size, 0.0);
  forcing.rate[c] = 50.0;
  forcing.target.resize(block.extent.size);
  forcing.target.u[0][c] = 0.2;
  forcing.target.p[c] = 3.0;
  forcing.pressure_rate = forcing.rate;
  forcing.psi = 0.01;
  evaluate_windows(block, equations, 0.0);
  fill_ghosts(block, q);
  History<2> history;
  history.resize(block.extent.size);
  Residual<2> r;
  equations.residual(block, q, BackwardDifference::steady(), history, forcing, r);
  // (21): V K/delta rho0 (u - u*) and V K/delta psi (p - p*), with q = 0
  EXPECT_NEAR(r.momentum[0][c], -block.volume[c] * 50.0 * 1000.0 * 0.2, 1e-12);
  EXPECT_NEAR(r.mass[c], -block.volume[c] * 50.0 * 0.01 * 3.0, 1e-14);
  r.momentum[0][c] = r.mass[c] = 0.0;
  EXPECT_LT(largest(block, r, 1.0, 1.0), 1e-13);
  // a damping zone leaves p alone
  forcing.pressure_rate.clear();
  equations.residual(block, q, BackwardDifference::steady(), history, forcing, r);
  EXPECT_NEAR(r.momentum[0][c], -block.volume[c] * 50.0 * 1000.0 * 0.2, 1e-12);
  EXPECT_EQ(r.mass[c], 0.0);
}

TEST(ResidualTest, FacesBetweenCellsConserveMassAndMomentum) {
  // closed by walls, the sum of all rows is the walls' pressure force alone: no mass is made inside
  Block<3> block = deformed_box<3>(5);
  Equations<3> equations;
  equations.fluid.inverse_c2 = 1e-2;
  set_reference_pressure(block, equations.fluid);
  close_with<3>(block, Condition::wall);
  State<3> q;
  q.resize(block.extent.size);
  for (std::size_t c = 0; c < q.p.size(); ++c) {
    const double s = static_cast<double>(c);
    q.p[c] = 100.0 * std::sin(s);
    for (std::size_t k = 0; k < 3; ++k) q.u[k][c] = std::cos(s + static_cast<double>(k));
  }
  const Residual<3> r = evaluate(block, equations, q);
  double sum = 0.0, size = 0.0;
  for (double m : r.mass) {
    sum += m;
    size += std::abs(m);
  }
  EXPECT_LT(std::abs(sum), 1e-13 * size);
}

}  // namespace
}  // namespace littoral::fv
