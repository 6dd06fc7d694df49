#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "coupling/samples.hpp"
#include "coupling_support.hpp"

namespace littoral::sph {
namespace {

const LinearEos k_eos{1000.0, 10.0, 0.0};
constexpr double k_dx = 0.05;

coupler::Targets points(const std::vector<coupler::Vec3>& places) {
  coupler::Targets targets;
  for (const auto& x : places) {
    targets.x.push_back(x[0]);
    targets.y.push_back(x[1]);
    targets.z.push_back(x[2]);
    targets.wants.push_back(coupler::wants_state | coupler::wants_phi);
  }
  return targets;
}

template <int D>
coupler::Samples sample(const Particles<D>& particles, const coupler::Targets& targets, SampleMethod method,
                        const Layers<D>& layers) {
  coupler::Samples samples;
  samples.resize(targets.size(), true);
  sample_states(particles, layers, {method, (D == 2 ? 4.0 : 2.7) * k_dx, true}, targets, samples);
  return samples;
}

template <int D>
Particles<D> jittered(const test::FormulaExterior& field) {
  Point<D> lower, upper;
  lower.fill(0.0);
  upper.fill(1.0);
  auto particles = test::lattice<D>(lower, upper, k_dx, k_eos, field);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> shake(-0.15 * k_dx, 0.15 * k_dx);
  for (std::size_t i = 0; i < particles.n_owned; ++i) {
    for (auto& column : particles.x) column[i] += shake(random);
    std::int64_t hint = -1;
    const auto state = field.at(to_vec3<D>(at<D>(particles.x, i)), 0.0, hint);
    particles.p[i] = state->p;
    for (std::size_t d = 0; d < D; ++d) particles.u[d][i] = state->u[space_axis<D>(d)];
  }
  return particles;
}

const std::vector<coupler::Vec3> k_places = {
    {0.5, 0.5, 0.5}, {0.31, 0.62, 0.47}, {0.5, 0.5, 0.99}, {0.02, 0.5, 0.98}};

template <int D>
void constants_are_exact(SampleMethod method) {  // C2
  const test::FormulaExterior field([](const coupler::Vec3&, double) {
    return coupler::DonorState{3.0, {1.0, -2.0, 0.5}, 0.0};
  });
  const auto particles = jittered<D>(field);
  const auto targets = points(k_places);
  const auto samples = sample<D>(particles, targets, method, test::unit_box<D>({}, 0.0, 0.0));
  for (std::size_t t = 0; t < targets.size(); ++t) {
    EXPECT_EQ(samples.status[t], coupler::SampleStatus::ok);
    EXPECT_NEAR(samples.p[t], 3.0, 1e-12);  // round-off of a sum of 81 terms
    EXPECT_NEAR(samples.u[t], 1.0, 1e-12);
    EXPECT_NEAR(samples.v[t], D == 3 ? -2.0 : 0.0, 1e-12);
    EXPECT_NEAR(samples.w[t], 0.5, 1e-12);
  }
}

TEST(SamplesTest, BesideWallsLinearFieldsAreExactAndTheCoverageIsOfWhatTheyLeave) {
  const auto linear = [](const coupler::Vec3& x, double) {
    const double p = 3.0 + 2.0 * x[0] - x[1] + 5.0 * x[2];
    return coupler::DonorState{p, {1.0 + x[2], x[0] - x[1], 0.5 * x[1]}, 0.0};
  };
  const auto particles = test::lattice<3>({0, 0, 0}, {1, 1, 1}, k_dx, k_eos, test::FormulaExterior(linear));
  support::BodySpec tank;
  tank.size = {1, 1, 4};
  tank.position = {0.5, 0.5, 2};
  tank.fluid = support::BodySpec::Fluid::inside;
  Numerics<3> numerics;
  numerics.eos = k_eos;
  numerics.spacing = k_dx;
  numerics.kernel_radius = 2.7 * k_dx;
  numerics.skin = 0.3 * k_dx;
  DomainBox<3> box;
  box.lower.fill(-4 * k_dx);
  box.upper.fill(1.0 + 4 * k_dx);
  std::vector<Body> bodies;
  bodies.emplace_back(tank, false, 1.0);
  Walls<3> walls(std::move(bodies), numerics, box, Lattice<3>{box.lower, k_dx});
  walls.build(particles, 0.5 * numerics.skin);
  const auto targets = points({{0.001, 0.001, 0.001}, {0.3, 0.001, 0.5}, {0.5, 0.5, 0.001}});
  coupler::Samples samples;
  samples.resize(targets.size(), true);
  sample_states(particles, test::unit_box<3>({}, 0.0, 0.0), {SampleMethod::corrected, 2.7 * k_dx, true},
                targets, samples, &walls);
  for (std::size_t t = 0; t < targets.size(); ++t) {
    EXPECT_EQ(samples.status[t],
              coupler::SampleStatus::ok);  // in a corner the water has an eighth of the kernel
    EXPECT_NEAR(samples.coverage[t], 1.0, 0.03);
    const auto exact = linear({targets.x[t], targets.y[t], targets.z[t]}, 0.0);
    EXPECT_NEAR(samples.p[t], exact.p, 1e-11);
    EXPECT_NEAR(samples.u[t], exact.u[0], 1e-11);
    EXPECT_NEAR(samples.w[t], exact.u[2], 1e-11);
  }
}

TEST(SamplesTest, ARegionThatHasRunDryIsDryNotUncovered) {
  const auto targets = points({{0.5, 0.0, 0.5}, {0.5, 0.0, -0.25}});
  const auto open_below = test::unit_box<2>({{{false, false}, {true, false}}}, 0.1, 0.4);
  const auto samples = sample<2>(Particles<2>{}, targets, SampleMethod::corrected, open_below);
  EXPECT_EQ(samples.status[0], coupler::SampleStatus::dry);
  EXPECT_EQ(samples.status[1], coupler::SampleStatus::uncovered) << "outside the box as before";
  EXPECT_EQ(samples.coverage[0], 0.0);
}

TEST(SamplesTest, ConstantsAreExact) {
  constants_are_exact<2>(SampleMethod::shepard);
  constants_are_exact<2>(SampleMethod::corrected);
  constants_are_exact<3>(SampleMethod::shepard);
  constants_are_exact<3>(SampleMethod::corrected);
  constants_are_exact<2>(SampleMethod::quadratic);
  constants_are_exact<3>(SampleMethod::quadratic);
}

test::FormulaExterior parabolic() {
  return test::FormulaExterior([](const coupler::Vec3& x, double) {
    return coupler::DonorState{2.0 - x[2] * x[2] + x[0] * x[2], {x[2] * x[2], x[1] * x[0], x[0] * x[0]}, 0.0};
  });
}

TEST(SamplesTest, QuadraticIsExactForParabolasWhereTheKernelIsWhole) {
  const auto field = parabolic();
  const auto targets = points({{0.5, 0.5, 0.5}, {0.31, 0.62, 0.47}, {0.5, 0.5, 1.0}});
  const auto plane =
      sample<2>(jittered<2>(field), targets, SampleMethod::quadratic, test::unit_box<2>({}, 0, 0));
  const auto space =
      sample<3>(jittered<3>(field), targets, SampleMethod::quadratic, test::unit_box<3>({}, 0, 0));
  for (std::size_t t = 0; t < 2; ++t) {
    std::int64_t hint = -1;
    const auto exact = *field.at({targets.x[t], targets.y[t], targets.z[t]}, 0.0, hint);
    EXPECT_NEAR(plane.p[t], exact.p, 1e-12);
    EXPECT_NEAR(plane.w[t], exact.u[2], 1e-12);
    EXPECT_NEAR(space.p[t], exact.p, 1e-12);
    EXPECT_NEAR(space.v[t], exact.u[1], 1e-12);
  }
  const auto corrected =
      sample<2>(jittered<2>(field), targets, SampleMethod::corrected, test::unit_box<2>({}, 0, 0));
  // R^2 .0694 of the second derivative, 2, over 2: what the kernel's second moment adds
  EXPECT_NEAR(corrected.w[0] - 0.25, 0.0694 * 16 * k_dx * k_dx, 0.1 * 0.0694 * 16 * k_dx * k_dx);
  EXPECT_EQ(plane.w[2], corrected.w[2]) << "on the surface both are the fit of first order";
}

test::FormulaExterior linear() {
  return test::FormulaExterior([](const coupler::Vec3& x, double) {
    return coupler::DonorState{2.0 - 3.0 * x[2] + x[0], {x[2], 0.5 * x[1], -x[0]}, 0.0};
  });
}

TEST(SamplesTest, CorrectedIsExactForLinearFieldsEvenAtTheSurface) {  // C2
  const auto field = linear();
  const auto targets = points(k_places);
  const auto plane =
      sample<2>(jittered<2>(field), targets, SampleMethod::corrected, test::unit_box<2>({}, 0, 0));
  const auto space =
      sample<3>(jittered<3>(field), targets, SampleMethod::corrected, test::unit_box<3>({}, 0, 0));
  for (std::size_t t = 0; t < targets.size(); ++t) {
    std::int64_t hint = -1;
    const auto exact = *field.at(k_places[t], 0.0, hint);
    EXPECT_NEAR(plane.p[t], exact.p, 1e-12);
    EXPECT_NEAR(plane.w[t], exact.u[2], 1e-12);
    EXPECT_NEAR(space.p[t], exact.p, 1e-12);
    EXPECT_NEAR(space.v[t], exact.u[1], 1e-12);
  }
}

TEST(SamplesTest, ShepardIsNearlyLinearInTheBulkAndTooDeepAtASurface) {  // C2, 1e-2 dx grad; trap 5
  const auto field = linear();
  const auto particles = test::lattice<2>({0, 0}, {1, 1}, k_dx, k_eos, field);
  const auto targets = points({{0.5, 0.0, 0.5}, {0.5, 0.0, 0.51}, {0.5, 0.0, 1.0}});
  const auto samples = sample<2>(particles, targets, SampleMethod::shepard, test::unit_box<2>({}, 0, 0));
  const double gradient = std::sqrt(10.0);
  EXPECT_NEAR(samples.p[0], 2.0 - 1.5 + 0.5, 1e-2 * k_dx * gradient);
  EXPECT_NEAR(samples.p[1], 2.0 - 1.53 + 0.5, 1e-2 * k_dx * gradient);
  // mean depth of half a Wendland disc: 0.212 R, to the 1% that a lattice of R = 4 dx leaves
  EXPECT_NEAR((samples.p[2] - (2.0 - 3.0 + 0.5)) / 3.0, 0.212 * 4 * k_dx, 0.01 * 4 * k_dx);
  EXPECT_NEAR(samples.coverage[2], 0.5, 0.01);
}

TEST(SamplesTest, TellWaterFromAirFromElsewhere) {
  const auto particles = test::lattice<2>({0, -0.5}, {1, 1}, k_dx, k_eos, linear());
  const auto layers = test::unit_box<2>({{{false, false}, {true, false}}}, 0.1, 0.4);
  const auto samples =
      sample<2>(particles, points({{0.5, 0, 0.5}, {0.5, 0, 1.3}, {0.5, 0, -0.2}, {0.5, 0, -0.05}}),
                SampleMethod::corrected, layers);
  EXPECT_EQ(samples.status[0], coupler::SampleStatus::ok);
  EXPECT_EQ(samples.status[1], coupler::SampleStatus::dry);
  EXPECT_EQ(samples.status[2], coupler::SampleStatus::uncovered) << "in the driven layer";
  EXPECT_EQ(samples.status[3], coupler::SampleStatus::ok) << "in the blending layer";
}

TEST(SamplesTest, DrivenParticlesDoNotCount) {
  auto particles = test::lattice<2>({0, -0.5}, {1, 1}, k_dx, k_eos, linear());
  for (std::size_t i = 0; i < particles.n_owned; ++i)
    if (particles.x[1][i] < -0.1) particles.p[i] = 1e30;
  const auto layers = test::unit_box<2>({{{false, false}, {true, false}}}, 0.1, 0.4);
  const auto samples = sample<2>(particles, points({{0.5, 0, -0.05}}), SampleMethod::corrected, layers);
  EXPECT_NEAR(samples.p[0], 2.0 + 0.15 + 0.5, 1e-12);
}

TEST(SamplesTest, ALineOfParticlesFallsBackToShepard) {
  Particles<2> particles;
  for (int k = 0; k < 20; ++k)
    particles.append({{k_dx * k, 0.5}, {1.0, 0.0}, 3 * k_dx * k_dx, 7.5, 4.0, Zone::interior});
  const auto samples =
      sample<2>(particles, points({{0.5, 0, 0.5}}), SampleMethod::corrected, test::unit_box<2>({}, 0, 0));
  EXPECT_EQ(samples.status[0], coupler::SampleStatus::ok);
  EXPECT_NEAR(samples.p[0], 4.0, 1e-12);
}

/// Still water 1 deep over a symmetry plane at z = 0, rows of the lattice up to z = 1.
TEST(SamplesTest, HydrostaticPressureIsExactBesideASymmetryPlaneAndZeroOnTheSurface) {
  const test::FormulaExterior field([](const coupler::Vec3& x, double) {
    return coupler::DonorState{1e4 * (1.0 - x[2]), {0.0, 0.0, 0.0}, 0.0};
  });
  Point<2> lower{0.0, 0.0}, upper{1.0, 1.0};
  auto particles = test::lattice<2>(lower, upper, k_dx, k_eos, field);
  particles.p.resize(particles.size());
  for (std::size_t i = 0; i < particles.n_owned; ++i)
    if (particles.x[1][i] > 1.0 - k_dx) {
      particles.surface[i] = SurfaceFlag::surface;
      particles.normal[0][i] = 0.0;
      particles.normal[1][i] = 1.0;
    }
  DomainBox<2> domain;
  domain.lower = {0.0, 0.0};
  domain.upper = {1.0, 2.0};
  domain.sides[0] = {support::Scene::Side::periodic, support::Scene::Side::periodic};
  domain.sides[1] = {support::Scene::Side::symmetry, support::Scene::Side::open};
  Ghosts<2> ghosts(domain);
  ghosts.create(particles, 4 * k_dx);
  const auto targets = points(
      {{0.5, 0, 0.025}, {0.5, 0, 0.1}, {0.02, 0, 0.5}, {0.5, 0, 0.87}, {0.5, 0, 0.99}, {0.5, 0, 1.02}});
  const auto layers = test::unit_box<2>({{{false, false}, {false, false}}}, 0.1, 0.4);
  const SampleRules rules{SampleMethod::corrected, 4 * k_dx, true, {0.0, 0.0, -1e4}};
  coupler::Samples samples;
  samples.resize(targets.size(), true);
  sample_states<2>(particles, layers, rules, targets, samples, nullptr, &ghosts);
  const SurfaceDistance<2> surface(particles, ghosts, 4 * k_dx, k_dx, 6 * k_dx);
  sample_level_set(surface, 3 * k_dx, targets, samples);
  constrain_pressure(particles, layers, surface, k_dx, 0.0, targets, samples);
  for (std::size_t t = 0; t < targets.size(); ++t)
    EXPECT_NEAR(samples.p[t], 1e4 * (1.0 - targets.z[t]), 1e-8) << targets.z[t];
  // whatever a layer at the surface carries, p is the surface's on it
  for (std::size_t i = 0; i < particles.size(); ++i) particles.p[i] += 300.0;
  const auto on_surface = points({{0.5, 0, 1.0}});
  samples.resize(1, true);
  sample_states<2>(particles, layers, rules, on_surface, samples, nullptr, &ghosts);
  EXPECT_NEAR(samples.p[0], 300.0, 1e-8);
  sample_level_set(surface, 3 * k_dx, on_surface, samples);
  constrain_pressure(particles, layers, surface, k_dx, 0.0, on_surface, samples);
  EXPECT_NEAR(samples.p[0], 0.0, 1e-8);
}

TEST(SamplesTest, LevelSetOfAPlaneAndACircle) {  // (20), gate 0.25 dx
  const double R = 0.7;
  Particles<2> particles;
  const int n = static_cast<int>(2 * 3.14159265 * R / k_dx);
  for (int k = 0; k < n; ++k) {
    const double a = 2 * 3.14159265358979 * k / n;
    particles.append({{(R - 0.5 * k_dx) * std::cos(a), (R - 0.5 * k_dx) * std::sin(a)}, {}, 1, 1, 0, {}});
    particles.surface.back() = SurfaceFlag::surface;
    particles.normal[0].back() = std::cos(a);
    particles.normal[1].back() = std::sin(a);
  }
  const auto targets = points({{0.6, 0, 0.3}, {0.5, 0, 0.5}, {0.5, 0, 0.6}, {0.1, 0, 0.1}});
  coupler::Samples samples;
  samples.resize(targets.size(), true);
  samples.coverage.assign(targets.size(), 1.0);
  const SurfaceDistance<2> surface(particles, Ghosts<2>(DomainBox<2>{}), 4 * k_dx, k_dx, 6 * k_dx);
  sample_level_set(surface, 6 * k_dx, targets, samples);
  for (std::size_t t = 0; t < 3; ++t)
    EXPECT_NEAR(samples.phi[t], std::hypot(targets.x[t], targets.z[t]) - R, 0.25 * k_dx);
  EXPECT_EQ(samples.phi[3], -6 * k_dx) << "far inside: the band's end";
}

/// phi of a row of surface particles at the points, on [0, 1] with these conditions along x.
coupler::Samples level_set_of_row(const std::function<double(double)>& z, double shift,
                                  support::Scene::Side side, const coupler::Targets& targets) {
  DomainBox<2> domain;
  domain.lower = {0.0, -1.0};
  domain.upper = {1.0, 2.0};
  domain.sides[0] = {side, side};
  domain.sides[1] = {support::Scene::Side::open, support::Scene::Side::open};
  Particles<2> particles;
  for (int k = 0; k < 20; ++k) {
    const double x = (k + 0.5) * k_dx, slope = (z(x + 1e-6) - z(x - 1e-6)) / 2e-6;
    const double moved = x + shift < 1.0 ? x + shift : x + shift - 1.0;
    particles.append({{moved, z(x)}, {}, 1, 1, 0, {}});
    particles.surface.back() = SurfaceFlag::surface;
    particles.normal[0].back() = -slope / std::hypot(1.0, slope);
    particles.normal[1].back() = 1.0 / std::hypot(1.0, slope);
  }
  Ghosts<2> ghosts(domain);
  ghosts.create(particles, 4 * k_dx);
  coupler::Samples samples;
  samples.resize(targets.size(), true);
  samples.coverage.assign(targets.size(), 1.0);
  sample_level_set(SurfaceDistance<2>(particles, ghosts, 4 * k_dx, k_dx, 3 * k_dx), 3 * k_dx, targets,
                   samples);
  return samples;
}

TEST(SamplesTest, LevelSetDoesNotSeeWhereThePeriodBegins) {
  const auto wave = [](double x) { return 0.5 + 0.05 * std::sin(2 * 3.14159265358979 * (x - 0.45)); };
  const auto seam = points({{0.01, 0, 0.5}, {0.99, 0, 0.55}, {0.03, 0, 0.48}});
  const auto inside = points({{0.51, 0, 0.5}, {0.49, 0, 0.55}, {0.53, 0, 0.48}});
  const auto at_seam = level_set_of_row(wave, 0.5, support::Scene::Side::periodic, seam);
  const auto away = level_set_of_row(wave, 0.0, support::Scene::Side::periodic, inside);
  // the same particles seen from the same places: round-off of positions and of the order of the sum
  for (std::size_t t = 0; t < seam.size(); ++t) EXPECT_NEAR(at_seam.phi[t], away.phi[t], 1e-12);
}

}  // namespace
}  // namespace littoral::sph
