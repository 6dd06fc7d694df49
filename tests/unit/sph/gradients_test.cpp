#include "physics/gradients.hpp"

#include <gtest/gtest.h>

#include "clouds.hpp"

namespace littoral::sph {
namespace {

template <int D>
void expect_linear_fields_exact(const std::array<int, D>& n, double radius) {
  auto particles = test::cloud<D>(n, 1.0, 0.3);
  const std::array<double, 3> gp = {1.5, -0.7, 0.4};
  const std::array<std::array<double, 3>, 3> gu = {{{0.2, -0.4, 0.1}, {0.9, 0.3, -0.6}, {-0.8, 0.5, 0.7}}};
  for (std::size_t i = 0; i < particles.n_owned; ++i) {
    particles.p[i] = 3.0;
    for (std::size_t b = 0; b < D; ++b) particles.p[i] += gp[b] * particles.x[b][i];
    for (std::size_t a = 0; a < D; ++a) {
      particles.u[a][i] = -1.0;
      for (std::size_t b = 0; b < D; ++b) particles.u[a][i] += gu[a][b] * particles.x[b][i];
    }
  }
  NeighborList<D> neighbors(radius, 0.2);
  neighbors.build(particles);
  Gradients<D> gradients;
  compute_gradients(particles, neighbors, gradients);
  for (std::size_t i = 0; i < particles.n_owned; ++i)
    for (std::size_t b = 0; b < D; ++b) {
      EXPECT_NEAR(gradients.p[b][i], gp[b], 1e-11);  // round-off times the condition of B on an edge
      for (std::size_t a = 0; a < D; ++a) EXPECT_NEAR(gradients.u[a][b][i], gu[a][b], 1e-11);
    }
}

TEST(GradientsTest, ExactForLinearFieldsOnDisorderedCloudsIn2D) {
  expect_linear_fields_exact<2>({13, 12}, 4.0);
}
TEST(GradientsTest, ExactForLinearFieldsOnDisorderedCloudsIn3D) {
  expect_linear_fields_exact<3>({7, 7, 6}, 2.7);
}

TEST(GradientsTest, ARowOfParticlesHasNone) {
  auto particles = test::cloud<2>({9, 1}, 1.0);
  for (std::size_t i = 0; i < particles.n_owned; ++i) particles.p[i] = particles.x[0][i];
  NeighborList<2> neighbors(4.0, 0.2);
  neighbors.build(particles);
  Gradients<2> gradients;
  compute_gradients(particles, neighbors, gradients);
  for (std::size_t i = 0; i < particles.n_owned; ++i) EXPECT_EQ(gradients.p[0][i], 0.0);
}

}  // namespace
}  // namespace littoral::sph
