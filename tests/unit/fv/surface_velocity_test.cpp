#include <gtest/gtest.h>

#include <cmath>

#include "grids.hpp"
#include "level_set/extend.hpp"
#include "level_set/reinitialise.hpp"

namespace littoral::fv {
namespace {

/// A level surface at z = level in a tank of ten rows, whose flow bends: w = z^3.
struct Bend {
  std::vector<Block<2>> blocks;
  Exchange<2> exchange;
  Band<2> band;
  SurfacePatches<2> patches;
  std::vector<Field> phi{1};
  VectorField<2> u;
  SurfaceVelocity<2> velocity;

  Bend() {
    Block<2> block = make_block<2>("tank", {6, 10}, {}, [](const std::array<int, 2>& i) {
      return std::array<double, 2>{0.1 * i[0], 0.1 * i[1]};
    });
    close_with<2>(block, Condition::slip);
    blocks.push_back(std::move(block));
    exchange = Exchange<2>(blocks, {});
    for (Field& component : u) component.assign(blocks[0].extent.size, 0.0);
    for (std::size_t c = 0; c < u[1].size(); ++c) u[1][c] = std::pow(blocks[0].centre[1][c], 3);
    set_level(0.5);
    locate_surface<2>(blocks, exchange, phi, 4, band, patches);
  }
  void set_level(double level) {
    phi[0].resize(blocks[0].extent.size);
    for (std::size_t c = 0; c < phi[0].size(); ++c) phi[0][c] = blocks[0].centre[1][c] - level;
  }
  double rise(bool settled) {
    std::vector<VectorField<2>> u_s(1);
    velocity.follow(blocks, exchange, band, patches, phi, {&u}, settled, u_s);
    return u_s[0][1][static_cast<std::size_t>(blocks[0].extent.at({3, 4}))];
  }
};

/// Halfway between two centres the stencil changes; in an inner iteration that moved the surface back and
/// forth across that place, the velocity at either end sending it to the other.
TEST(SurfaceVelocityTest, ASettledStencilIsContinuousWhereItWouldChange) {
  Bend bend;
  constexpr double step = 1e-6;
  bend.set_level(0.5 - step);
  const double below = bend.rise(false);
  bend.set_level(0.5 + step);
  const double held = bend.rise(true), chosen = bend.rise(false);
  EXPECT_NEAR(held, below, 10.0 * step);
  EXPECT_GT(std::abs(chosen - below), 100.0 * step);  // what is held is worth holding
}

}  // namespace
}  // namespace littoral::fv
