#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>

#include "coupling_models.hpp"
#include "io/checkpoint.hpp"
#include "littoral/error.hpp"

// The grid's side of every schedule, with the particles played by a formula, in one process.
namespace littoral::fv {
namespace {

using coupler::Schedule;
using test::march;
using test::scene_with;
using test::top_scene;
using test::water_box;

const std::vector<Schedule> k_all = {Schedule::serial, Schedule::predicted, Schedule::iterated,
                                     Schedule::concurrent};

template <int D>
double largest_difference(const Stepper<D>& stepper, const FlowFunction<D>& flow, double p_scale) {
  double worst = 0.0;
  for (std::size_t b = 0; b < stepper.blocks().size(); ++b) {
    const Block<D>& block = stepper.blocks()[b];
    for (std::size_t c = 0; c < block.extent.size; ++c) {
      if (block.solved[c] == 0.0) continue;
      std::array<double, D> x;
      for (std::size_t d = 0; d < D; ++d) x[d] = block.centre[d][c];
      const PointState<D> s = flow(x, stepper.time());
      worst = std::max(worst, std::abs(stepper.state()[b].p[c] - s.p) / p_scale);
      for (std::size_t k = 0; k < D; ++k)
        worst = std::max(worst, std::abs(stepper.state()[b].u[k][c] - s.u[k]));
    }
  }
  return worst;
}

/// A stream of 1 m/s across the box, through the hole in its middle and out again.
template <int D>
void expect_stream_stays(Schedule schedule) {
  auto scene = scene_with(D, {{0.25, 0.25, 0.25}, {0.75, 0.75, 0.75}});
  scene.coupling.schedule.schedule = schedule;
  const FlowFunction<D> stream = [](const std::array<double, D>&, double) {
    PointState<D> s;
    s.p = 30.0;
    s.u.fill(0.5);
    s.u[0] = 1.0;
    return s;
  };
  auto block = water_box<D>(D == 2 ? 24 : 12, false, Condition::state);
  for (auto& w : block.windows) {
    for (std::size_t k = 0; k < D; ++k)
      w.velocity[k] = [k](const std::array<double, 3>&, double) { return k == 0 ? 1.0 : 0.5; };
    w.pressure = [](const std::array<double, 3>&, double) { return 30.0; };
  }
  auto stepper = test::stepper_for<D>({block}, scene, stream);
  Coupled<D> coupled(
      scene, 10.0,
      coupler::analytic_sph_partner(coupler::uniform_stream({1.0, 0.5, D == 3 ? 0.5 : 0.5}, 30.0),
                                    test::plan_of(scene)));
  coupled.begin(stepper);
  EXPECT_EQ(march(coupled, stepper, 10), 10);
  EXPECT_LT(largest_difference<D>(stepper, stream, 1000.0), 1e-10) << coupler::name(schedule);
  // what enters the region leaves it
  EXPECT_NEAR(coupled.ledger().fv_mass_flux, 0.0, 1e-9) << coupler::name(schedule);
}

TEST(CoupledTest, UniformStreamThroughTheRegionStaysInThePlane) {
  for (const Schedule schedule : k_all) expect_stream_stays<2>(schedule);
}

TEST(CoupledTest, UniformStreamThroughTheRegionStaysInSpace) { expect_stream_stays<3>(Schedule::predicted); }

TEST(CoupledTest, WaterAtRestStaysAtRest) {
  for (const Schedule schedule : k_all) {
    auto scene = top_scene(9.81);
    scene.coupling.schedule.schedule = schedule;
    Fluid<2> fluid;
    fluid.density = test::k_density;
    fluid.inverse_c2 = 0.01;
    fluid.gravity = {0.0, -9.81};
    const FlowFunction<2> rest = [fluid](const std::array<double, 2>& x, double) {
      return PointState<2>{fluid.hydrostatic(x), {0.0, 0.0}};
    };
    const coupler::Flow flow = [fluid](const coupler::Vec3& x, double) {
      coupler::FlowState s;
      s.p = fluid.hydrostatic({x[0], x[2]});
      return s;
    };
    auto stepper = test::stepper_for<2>({water_box<2>(16, true)}, scene, rest);
    Coupled<2> coupled(scene, 10.0, coupler::analytic_sph_partner(flow, test::plan_of(scene)));
    coupled.begin(stepper);
    march(coupled, stepper, 10);
    EXPECT_LT(largest_difference<2>(stepper, rest, 9810.0), 1e-11) << coupler::name(schedule);
  }
}

/// Standing wave in the water below z = .5 of a column of depth 1, driven from above by the exact wave.
struct Wave {
  support::Scene scene = top_scene(1.0);
  coupler::Flow flow;
  Wave(Schedule schedule, double dt) {
    scene.coupling.schedule.schedule = schedule;
    scene.coupling.window.dt = dt;
    scene.fluid.sound_speed = std::numeric_limits<double>::infinity();
    scene.reference_velocity = 1.0;
    const double k = 2.0 * std::acos(-1.0), omega = std::sqrt(k * std::tanh(k)), a = 1e-3;
    flow = [=](const coupler::Vec3& x, double t) {
      coupler::FlowState s;
      const double c = std::cosh(k * x[2]) / std::cosh(k), h = std::sinh(k * x[2]) / std::cosh(k);
      s.p = test::k_density * (a * c * std::cos(k * x[0]) * std::sin(omega * t) - x[2]);
      s.u = {-a * k / omega * c * std::sin(k * x[0]) * std::cos(omega * t), 0.0,
             a * k / omega * h * std::cos(k * x[0]) * std::cos(omega * t)};
      return s;
    };
  }
  FlowFunction<2> exact() const {
    return [f = flow](const std::array<double, 2>& x, double t) {
      const coupler::FlowState s = f({x[0], 0.0, x[1]}, t);
      return PointState<2>{s.p, {s.u[0], s.u[2]}};
    };
  }
};

/// Passes everything on, and looks at the donors on their way: carried to the window's end by their rates
/// they must agree with the flow.
class Inspector : public coupler::SphPartner {
 public:
  Inspector(std::unique_ptr<coupler::SphPartner> real, coupler::Flow flow)
      : real_(std::move(real)), flow_(std::move(flow)) {}
  void offer(const coupler::DonorGeometry& donors, const coupler::Targets& targets) override {
    geometry_ = donors;
    real_->offer(donors, targets);
  }
  coupler::Agreement agree(const coupler::Proposal& mine) override { return real_->agree(mine); }
  void send(const coupler::Window& window, const coupler::DonorValues& donors) override {
    EXPECT_EQ(donors.time, window.t_begin);
    EXPECT_EQ(donors.horizon_end, window.t_end);
    const auto& patch = geometry_.patches[0];
    for (std::size_t i = 0; i < patch.size(); ++i) {
      if (!patch.usable[i]) continue;
      const auto exact = flow_({patch.x[i], 0.0, patch.z[i]}, window.t_end);
      worst_ = std::max(worst_, std::abs(donors.u[i] + window.dt() * donors.du_dt[i] - exact.u[0]));
      worst_ = std::max(worst_, std::abs(donors.w[i] + window.dt() * donors.dw_dt[i] - exact.u[2]));
      p_worst_ = std::max(p_worst_, std::abs(donors.p[i] + window.dt() * donors.dp_dt[i] - exact.p));
    }
    ++sent_;
    real_->send(window, donors);
  }
  void receive(const coupler::Window& window, coupler::Samples& samples) override {
    real_->receive(window, samples);
  }
  void receive_particles(const coupler::Window&, coupler::ParticleStates&) override {}
  coupler::Ledger exchange(const coupler::Window& window, const coupler::Ledger& mine) override {
    return real_->exchange(window, mine);
  }
  void goodbye(const std::string&) override {}
  std::string description() const override { return "inspector"; }
  double worst() const { return worst_; }
  double p_worst() const { return p_worst_; }
  int sent() const { return sent_; }

 private:
  std::unique_ptr<coupler::SphPartner> real_;
  coupler::Flow flow_;
  coupler::DonorGeometry geometry_;
  double worst_ = 0.0, p_worst_ = 0.0;
  int sent_ = 0;
};

TEST(CoupledTest, GridAndDonorsFollowTheWaveUnderEverySchedule) {
  for (const Schedule schedule : k_all) {
    const Wave wave(schedule, 0.02);
    auto stepper = test::stepper_for<2>({water_box<2>(24, true)}, wave.scene, wave.exact());
    auto inspector = std::make_unique<Inspector>(
        coupler::analytic_sph_partner(wave.flow, test::plan_of(wave.scene)), wave.flow);
    const Inspector& seen = *inspector;
    Coupled<2> coupled(wave.scene, 10.0, std::move(inspector));
    coupled.begin(stepper);
    march(coupled, stepper, 25);
    // velocity amplitude at z = .5: a k/omega cosh(pi)/cosh(2 pi) = 1.1e-4
    EXPECT_LT(largest_difference<2>(stepper, wave.exact(), 1e30), 0.05 * 1.1e-4) << coupler::name(schedule);
    EXPECT_EQ(seen.sent(), schedule == Schedule::iterated ? 50 : 25);
    // as close as the grid itself follows the wave; the fringe's top row moves with 2.1e-4 m/s, p with .2 Pa
    EXPECT_LT(seen.worst(), 0.05 * 2.1e-4) << coupler::name(schedule);
    EXPECT_LT(seen.p_worst(), 0.05) << coupler::name(schedule);
  }
}

/// 2N windows are N windows, a checkpoint, and N windows, to the bit.
TEST(CoupledTest, RestartContinuesBitForBit) {
  const std::string path = (std::filesystem::temp_directory_path() / "littoral_fv_restart_test.h5").string();
  for (const Schedule schedule : k_all) {
    const Wave wave(schedule, 0.02);
    const auto make = [&](Stepper<2>& stepper, std::int64_t window) {
      return std::make_unique<Coupled<2>>(
          wave.scene, 10.0,
          coupler::analytic_sph_partner(wave.flow, test::plan_of(wave.scene, stepper.time(), window)));
    };
    auto whole = test::stepper_for<2>({water_box<2>(16, true)}, wave.scene, wave.exact());
    auto companion = make(whole, 0);
    companion->begin(whole);
    march(*companion, whole, 4);
    write_checkpoint<2>(path, whole, 4, wave.scene, [&](StateWriter<2>& file) { companion->save(file); });
    march(*companion, whole, 4);

    auto second = test::stepper_for<2>({water_box<2>(16, true)}, wave.scene, wave.exact());
    const std::int64_t window = read_checkpoint<2>(path, second, wave.scene);
    EXPECT_EQ(window, 4);
    auto continued = make(second, window);
    continued->begin(second);
    continued->load(support::CheckpointReader(path));
    march(*continued, second, 4);

    EXPECT_EQ(whole.time(), second.time());
    EXPECT_EQ(whole.state()[0].p, second.state()[0].p) << coupler::name(schedule);
    EXPECT_EQ(whole.state()[0].u, second.state()[0].u) << coupler::name(schedule);
    EXPECT_EQ(companion->ledger().fv_mass_flux, continued->ledger().fv_mass_flux);

    support::Scene other = wave.scene;
    other.restart_digest = "another";
    EXPECT_THROW(read_checkpoint<2>(path, second, other), ConfigError);
  }
  std::filesystem::remove(path);
}

TEST(CoupledTest, FringeWithoutWaterIsAnErrorThatNamesTheCell) {
  auto scene = top_scene(0.0);
  const FlowFunction<2> rest = [](const std::array<double, 2>&, double) { return PointState<2>{}; };
  const coupler::Flow dry_above = [](const coupler::Vec3& x, double) {
    coupler::FlowState s;
    s.phi = x[2] - 0.55;
    return s;
  };
  auto stepper = test::stepper_for<2>({water_box<2>(10, true)}, scene, rest);
  Coupled<2> coupled(scene, 10.0, coupler::analytic_sph_partner(dry_above, test::plan_of(scene)));
  coupled.begin(stepper);
  try {
    march(coupled, stepper, 1);
    FAIL() << "a dry fringe went unnoticed";
  } catch (const CouplingError& error) {
    const std::string what = error.what();
    EXPECT_NE(what.find("block 'box' cell (0,6) at (0.05, 0, 0.65)"), std::string::npos) << what;
    EXPECT_NE(what.find("no water"), std::string::npos) << what;
  }
}

/// Warnings of three windows of still water, 4H/c = .8 s deep.
int warnings(Schedule schedule, double dt) {
  auto scene = top_scene(1e-9);  // which way is down, without a pressure worth mentioning
  const FlowFunction<2> rest = [](const std::array<double, 2>&, double) { return PointState<2>{}; };
  scene.coupling.schedule.schedule = schedule;
  scene.coupling.window.dt = dt;
  auto stepper = test::stepper_for<2>({water_box<2>(10, true)}, scene, rest);
  Coupled<2> coupled(
      scene, 10.0,
      coupler::analytic_sph_partner(coupler::uniform_stream({0, 0, 0}, 0.0), test::plan_of(scene)));
  int count = 0;
  coupled.warn = [&](const std::string&) { ++count; };
  coupled.begin(stepper);
  march(coupled, stepper, 3);
  return count;
}

TEST(CoupledTest, WarnsOncePerRunAndOnlyWhereExtrapolationIsNotSafe) {
  EXPECT_EQ(warnings(Schedule::serial, 0.04), 1);
  EXPECT_EQ(warnings(Schedule::serial, 0.02), 0);
  EXPECT_EQ(warnings(Schedule::concurrent, 0.04), 1);
  EXPECT_EQ(warnings(Schedule::concurrent, 0.02), 0);
  for (const double dt : {0.02, 0.04}) {
    EXPECT_EQ(warnings(Schedule::predicted, dt), 0);
    EXPECT_EQ(warnings(Schedule::iterated, dt), 0);
  }
}

/// Coupling II: the stream is forced where it flows anyway, so nothing changes.
TEST(CoupledTest, ForcedStreamStays) {
  auto scene = scene_with(2, {{0.25, 0, 0.25}, {0.75, 0, 0.75}});
  scene.coupling.kind = support::Scene::CouplingKind::forced;
  auto block = water_box<2>(16, true);
  const FlowFunction<2> stream = [](const std::array<double, 2>&, double) {
    return PointState<2>{5.0, {1.0, 0.0}};
  };
  auto stepper = test::stepper_for<2>({block}, scene, stream);
  Coupled<2> coupled(
      scene, 10.0,
      coupler::analytic_sph_partner(coupler::uniform_stream({1.0, 0, 0}, 5.0), test::plan_of(scene)));
  coupled.begin(stepper);
  march(coupled, stepper, 5);
  EXPECT_LT(largest_difference<2>(stepper, stream, 1000.0), 1e-10);
}

/// Gives no sample at every second target.
class HalfDry : public Inspector {
 public:
  using Inspector::Inspector;
  void receive(const coupler::Window& window, coupler::Samples& samples) override {
    Inspector::receive(window, samples);
    for (std::size_t i = 0; i < samples.status.size(); i += 2) samples.status[i] = coupler::SampleStatus::dry;
  }
};

TEST(CoupledTest, CellsWithoutASampleAreNotForced) {
  auto scene = scene_with(2, {{0.25, 0, 0.25}, {0.75, 0, 0.75}});
  scene.coupling.kind = support::Scene::CouplingKind::forced;
  const FlowFunction<2> rest = [](const std::array<double, 2>&, double) { return PointState<2>{}; };
  auto stepper = test::stepper_for<2>({water_box<2>(16, false)}, scene, rest);
  const auto flow = coupler::uniform_stream({0, 0, 0}, 0.0);
  Coupled<2> coupled(
      scene, 10.0,
      std::make_unique<HalfDry>(coupler::analytic_sph_partner(flow, test::plan_of(scene)), flow));
  coupled.begin(stepper);
  march(coupled, stepper, 2);
  const Block<2>& block = stepper.blocks()[0];
  int forced = 0, free = 0;
  for (std::size_t c = 0; c < block.extent.size; ++c)
    if (block.status[c] == CellStatus::forced) ++(stepper.forcing()[0].rate[c] > 0.0 ? forced : free);
  EXPECT_EQ(forced, 32);
  EXPECT_EQ(free, 32);
}

}  // namespace
}  // namespace littoral::fv
