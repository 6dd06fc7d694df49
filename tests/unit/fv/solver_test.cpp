#include "solver.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <limits>

#include "setup.hpp"

// The loop of a run: what it proposes, and that it does what was agreed on.
namespace littoral::fv {
namespace {

/// Grants or refuses what the solver proposes, in windows of .1 s.
class Notary : public Companion<2> {
 public:
  explicit Notary(bool grants) : grants_(grants) {}
  void begin(Stepper<2>&) override {}
  std::optional<coupler::Agreement> agree(const coupler::Proposal& mine) override {
    if (windows_ == 10) return {};
    coupler::Agreement agreement;
    agreement.window.index = windows_;
    agreement.window.t_begin = 0.1 * static_cast<double>(windows_);
    agreement.window.t_end = 0.1 * static_cast<double>(++windows_);
    agreement.write = grants_ && mine.write;
    proposed_ += mine.write ? 1 : 0;
    return agreement;
  }
  StepReport advance(const coupler::Window& window, Stepper<2>& stepper) override {
    return stepper.advance(window.dt());
  }
  void goodbye(const std::string&) override {}
  std::string description() const override { return "a notary"; }
  int proposed() const { return proposed_; }

 private:
  bool grants_;
  std::int64_t windows_ = 0;
  int proposed_ = 0;
};

/// Files of fields that a run of 1 s leaves, and how often it proposed to write.
std::pair<int, int> run(bool grants) {
  const auto folder = std::filesystem::path("scratch") / (grants ? "fv_granted" : "fv_refused");
  std::filesystem::remove_all(folder);
  FvConfig config;
  config.blocks.resize(1);
  config.blocks[0].upper = {1, 0, 1};
  config.blocks[0].cells = {8, 1, 8};
  for (auto& face : config.blocks[0].faces) face.condition = static_cast<int>(Condition::slip);
  config.time.dt = 0.1;
  support::Scene scene;
  scene.fluid.sound_speed = 10.0;
  scene.domain.upper = {1, 0, 1};
  scene.time.end = 1.0;
  scene.time.field_interval = 0.3;
  Notary notary(grants);
  Solver<2>(config, scene, folder.string(), "").run(notary);
  int files = 0;
  for (const auto& file : std::filesystem::directory_iterator(folder / "fv"))
    files += file.path().extension() == ".h5" ? 1 : 0;
  std::filesystem::remove_all(folder);
  return {files, notary.proposed()};
}

TEST(SolverTest, FieldsAreProposedWhenDueAndWrittenWhenAgreed) {
  const auto granted = run(true);
  EXPECT_EQ(granted.second, 3);  // .3, .6, .9
  EXPECT_EQ(granted.first, 5);   // these, the first and the last
  const auto refused = run(false);
  EXPECT_EQ(refused.second, 8);  // it goes on asking from .3 on
  EXPECT_EQ(refused.first, 2);   // the first and the last
}

/// The scene's acceleration is that of all water, the grid's source a force per volume.
TEST(SolverTest, BodyForceOfTheSceneAndSourceOfTheGridBothAct) {
  FvConfig config;
  config.blocks.resize(1);
  config.blocks[0].upper = {1, 0, 1};
  config.blocks[0].cells = {8, 1, 8};
  for (std::size_t face = 0; face < config.blocks[0].faces.size(); ++face)
    config.blocks[0].faces[face].condition =
        static_cast<int>(face < 2 ? Condition::periodic : Condition::slip);
  config.source.u = support::Formula("20*t");
  support::Scene scene;
  scene.fluid.density = 40.0;
  scene.fluid.sound_speed = std::numeric_limits<double>::infinity();
  scene.reference_velocity = 1.0;
  scene.domain.upper = {1, 0, 1};
  scene.body_force.x = support::Formula("0.3");
  Stepper<2> stepper = make_stepper<2>(config, scene);
  stepper.advance(0.1);  // implicit Euler
  EXPECT_NEAR(stepper.state()[0].u[0][static_cast<std::size_t>(stepper.blocks()[0].extent.at({3, 3}))],
              0.1 * (0.3 + 20.0 * 0.1 / 40.0), 1e-5);  // a drop of 1e-3
}

}  // namespace
}  // namespace littoral::fv
