#include "littoral/support/partner_choice.hpp"
#include "littoral/support/run_plan.hpp"
#include "support_test.hpp"

// One rule of who plays the partner, for both programs: every case is asked of both.
namespace littoral::support {
namespace {

using coupler::Role;

Scene coupled_scene() {
  Scene scene;
  scene.coupling.kind = Scene::CouplingKind::imposed;
  scene.regions = {{{0, 0, 0}, {1, 1, 1}}};
  return scene;
}

class PartnerRule : public ::testing::TestWithParam<Role> {
 protected:
  PartnerPlayer decide(bool in_job) const {
    return decide_partner(GetParam(), in_job, scene, config, options);
  }
  std::string refusal(bool in_job) const {
    return message_of<ConfigError>([&] { decide(in_job); });
  }
  Scene scene = coupled_scene();
  PartnerConfig config;
  ProgramOptions options;
};

TEST_P(PartnerRule, ACoupledSceneTakesTheJobsOtherProgramAndNothingElse) {
  EXPECT_EQ(decide(true), PartnerPlayer::program);
  EXPECT_CONTAINS(refusal(false), "runs in this job: start both in one mpirun line");
}

TEST_P(PartnerRule, ASceneWithoutCouplingRunsAloneOnly) {
  scene.coupling.kind = Scene::CouplingKind::none;
  EXPECT_EQ(decide(false), PartnerPlayer::nobody);
  EXPECT_CONTAINS(refusal(true), "the scene's coupling.kind is none");
  config.kind = PartnerKind::analytic;
  EXPECT_CONTAINS(refusal(false), "needs a scene with regions");
  config.kind = PartnerKind::none;
  scene = coupled_scene();
  EXPECT_CONTAINS(refusal(false), "partner: none");
}

TEST_P(PartnerRule, ARecordNeedsAPartner) {
  options.record = "tape.h5";
  EXPECT_EQ(decide(true), PartnerPlayer::program);
  config.kind = PartnerKind::analytic;
  EXPECT_EQ(decide(false), PartnerPlayer::formula);
  config.kind = PartnerKind::automatic;
  scene.coupling.kind = Scene::CouplingKind::none;
  EXPECT_CONTAINS(refusal(false), "there is no partner to record");
}

TEST_P(PartnerRule, AReplayIsRefusedBesideALivePartner) {
  options.replay = "tape.h5";
  EXPECT_EQ(decide(false), PartnerPlayer::record);
  EXPECT_CONTAINS(refusal(true), "--replay plays it");
  options.record = "other.h5";
  EXPECT_CONTAINS(refusal(false), "--record and --replay together");
}

TEST_P(PartnerRule, WhatTheJobDoesNotDecideIsSaidByACheck) {
  EXPECT_EQ(planned_partner(GetParam(), scene, config, options), PartnerPlayer::program);
  config.kind = PartnerKind::none;
  EXPECT_CONTAINS(message_of<ConfigError>([&] { planned_partner(GetParam(), scene, config, options); }),
                  "partner: none");
}

INSTANTIATE_TEST_SUITE_P(BothPrograms, PartnerRule, ::testing::Values(Role::sph, Role::fv),
                         [](const auto& role) { return role.param == Role::sph ? "sph" : "fv"; });

TEST(PartnerConfig, BothFilesHaveTheSameKeysButTheParticlesLattice) {
  const auto help = [](Role role) {
    Binder binder(Binder::Mode::help);
    PartnerConfig().bind(binder, role);
    return binder.text();
  };
  EXPECT_CONTAINS(help(Role::sph), "Donor cells");
  EXPECT_FALSE(contains(help(Role::fv), "Donor cells"));
  EXPECT_CONTAINS(help(Role::fv), "standing_wave");
}

TEST(RunPlan, IsTheSamePlanWithItsLevelSetAndDeadlineForBothPrograms) {
  Scene scene = coupled_scene();
  scene.coupling.deadline = 7.0;
  scene.coupling.kind = Scene::CouplingKind::forced;
  scene.initial.surface = Formula("z-1", {});
  const coupler::RunPlan plan = run_plan(scene, 2.0, 5);
  EXPECT_TRUE(plan.with_phi);  // the overlapped cells know the surface from the particles
  EXPECT_EQ(plan.deadline, 7.0);
  EXPECT_EQ(plan.start_window, 5);
}

}  // namespace
}  // namespace littoral::support
