#include <gtest/gtest.h>

#include <cstdio>

#include "coupling_open_box.hpp"
#include "io/checkpoint.hpp"
#include "littoral/error.hpp"

namespace littoral::sph {
namespace {

using test::OpenBox;

class RestartTest : public ::testing::Test {
 protected:
  void TearDown() override { std::remove(path_.c_str()); }
  const std::string path_ =
      std::string("restart_") + ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".h5";
  const coupler::Flow flow_ = coupler::taylor_vortex(1.0, 0.5, 0.8, 0.0, {1.0, 0.0, 0.3});

  static RunState state_of(const OpenBox<2>& box) {
    RunState run;
    run.scene_title = box.scene.title;
    run.scene_digest = box.scene.restart_digest;
    run.most_acceleration = box.dynamics->most_acceleration();
    return run;
  }
  /// What a running program does at a checkpoint.
  void checkpoint(OpenBox<2>& box) {
    box.dynamics->forget_lists();
    box.particles.drop_ghosts();
    box.driver->forget_hints(box.particles);
    write_checkpoint(path_, state_of(box), box.particles, &box.driver->hooks().exchange());
  }
};

TEST_F(RestartTest, GoesOnToTheBitWhileParticlesComeAndGo) {  // C20
  OpenBox<2> whole(flow_, coupler::Schedule::serial, 1);
  const double time = whole.run(20);
  checkpoint(whole);
  const double injected = whole.driver->ledger().n_injected;
  whole.run(20);
  ASSERT_GT(whole.driver->ledger().n_injected, injected) << "nothing to test";
  ASSERT_GT(injected, 0.0);

  OpenBox<2> half(flow_, coupler::Schedule::serial, 1, time);
  const RunState run = read_checkpoint(path_, half.scene, half.particles, &half.driver->hooks().exchange());
  half.dynamics->set_most_acceleration(run.most_acceleration);
  half.run(20);
  EXPECT_EQ(whole.particles.id, half.particles.id);
  EXPECT_EQ(whole.particles.x, half.particles.x);
  EXPECT_EQ(whole.particles.u, half.particles.u);
  EXPECT_EQ(whole.particles.V, half.particles.V);
  EXPECT_EQ(whole.driver->hooks().exchange().pack(), half.driver->hooks().exchange().pack());
  EXPECT_EQ(whole.driver->ledger().n_injected, half.driver->ledger().n_injected);
  EXPECT_EQ(whole.driver->hooks().exchange().pack_counts(), half.driver->hooks().exchange().pack_counts());
}

TEST_F(RestartTest, RefusesAnotherSceneAndNamesBoth) {
  OpenBox<2> box(flow_, coupler::Schedule::serial, 1);
  box.scene.title = "flume";
  box.scene.restart_digest = "aaaa";
  checkpoint(box);
  box.scene.title = "harbour";
  box.scene.restart_digest = "bbbb";
  try {
    read_checkpoint(path_, box.scene, box.particles, &box.driver->hooks().exchange());
    FAIL() << "expected ConfigError";
  } catch (const ConfigError& error) {
    EXPECT_NE(std::string(error.what()).find("flume"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("harbour"), std::string::npos) << error.what();
  }
}

TEST_F(RestartTest, RefusesACheckpointWithoutPartner) {
  OpenBox<2> box(flow_, coupler::Schedule::serial, 1);
  write_checkpoint(path_, state_of(box), box.particles, static_cast<ParticleExchange<2>*>(nullptr));
  EXPECT_THROW(read_checkpoint(path_, box.scene, box.particles, &box.driver->hooks().exchange()),
               ConfigError);
}

}  // namespace
}  // namespace littoral::sph
