#include <gtest/gtest.h>

#include "coupling/drive_layers.hpp"
#include "coupling_support.hpp"
#include "littoral/error.hpp"

namespace littoral::sph {
namespace {

const LinearEos k_eos{1000.0, 10.0, 0.0};

TEST(DriveLayersTest, BlendsBySeventeenAndDrivesOutside) {
  const test::FormulaExterior fv([](const coupler::Vec3& x, double t) {
    return coupler::DonorState{100.0 * x[2] + t, {x[0], 0.0, 2.0}, 0.0};
  });
  const auto layers = test::unit_box<2>({{{false, false}, {false, true}}}, 0.25, 0.5);
  Particles<2> particles;
  for (double z : {0.9, 1.125, 1.5})
    particles.append({{0.5, z}, {-1.0, -1.0}, 1e-4, 0.1, 7.0, Zone::interior});
  const LayerCount count = drive_layers(particles, layers, fv, k_eos, 0.1, 3.0);
  EXPECT_EQ(count.blending, 1u);
  EXPECT_EQ(count.driven, 1u);
  EXPECT_EQ(particles.p[0], 7.0);
  EXPECT_EQ(particles.u[1][0], -1.0);
  EXPECT_DOUBLE_EQ(particles.p[1], 0.5 * 7.0 + 0.5 * (112.5 + 3.0));
  EXPECT_DOUBLE_EQ(particles.u[0][1], 0.5 * -1.0 + 0.5 * 0.5);
  EXPECT_DOUBLE_EQ(particles.p[2], 153.0);
  EXPECT_DOUBLE_EQ(particles.u[1][2], 2.0);
  for (std::size_t i : {1u, 2u}) {
    EXPECT_DOUBLE_EQ(particles.rho[i], k_eos.density(particles.p[i]));
    EXPECT_DOUBLE_EQ(particles.V[i] * particles.rho[i], 0.1) << "the mass stays";
  }
  EXPECT_EQ(particles.zone[2], Zone::driven);
}

TEST(DriveLayersTest, ParticleWithoutDonorsIsAnErrorUnlessThereIsAir) {
  const auto nothing = [](const coupler::Vec3&, double) { return std::optional<coupler::DonorState>(); };
  const auto layers = test::unit_box<3>(test::all_open<3>(), 0.25, 0.5);
  Particles<3> particles;
  particles.append({{0.5, 0.5, 1.5}, {0.0, 0.0, 0.0}, 1e-4, 0.1, 7.0, Zone::interior});
  try {
    drive_layers(particles, layers, test::FormulaExterior(nothing), k_eos, 0.1, 0.0);
    FAIL() << "expected CouplingError";
  } catch (const CouplingError& error) {
    EXPECT_NE(std::string(error.what()).find("(0.5, 0.5, 1.5)"), std::string::npos) << error.what();
  }
  const auto count = drive_layers(particles, layers, test::FormulaExterior(nothing, true), k_eos, 0.1, 0.0);
  EXPECT_EQ(count.unreached, 1u);
  EXPECT_EQ(particles.p[0], 7.0);
}

}  // namespace
}  // namespace littoral::sph
