#include "littoral/support/scene.hpp"

#include <cmath>
#include <limits>

#include "littoral/support/both_files.hpp"
#include "littoral/support/scene_warnings.hpp"
#include "support_test.hpp"

namespace littoral::support {
namespace {

// clang-format off: its YAML is not ours
const char* const k_wave = R"yaml(title: Viscous standing wave
dimension: 2
constants: {H: 1.0, a: 0.05, k: pi}
fluid: {density: 1.0, sound_speed: 10.0, reference_pressure: 0.0, viscosity: 0.004}
gravity: [0, 0, -1]
domain: {lower: [0, 0, -1], upper: [2, 0, 0.5], x: [periodic, periodic], z: [symmetry, open]}
initial: {u: "a*cos(k*x)", w: 0, p: "-z", surface: "z"}
regions: [{lower: [0, 0, -0.5], upper: [2, 0, 0.5]}]
coupling: {kind: imposed, blending_width: 0.08, driven_width: 0.08, fringe_layers: 2, schedule: predicted, passes: 2, substeps: 1, deadline: 600}
time: {end: 17.8, max_windows: -1, field_interval: 0.5, checkpoint_interval: 0}
reference_velocity: 0.25
)yaml";
// clang-format on

class SceneTest : public ::testing::Test {
 protected:
  Scene read(const std::vector<std::string>& settings = {}, const std::string& text = k_wave) {
    write_text(folder_ / "scene.yaml", text);
    return Scene::from_file(folder_ / "scene.yaml", settings);
  }
  std::string refusal(const std::vector<std::string>& settings, const std::string& text = k_wave) {
    return message_of<ConfigError>([&] { read(settings, text); });
  }
  TemporaryFolder folder_;
};

TEST_F(SceneTest, ReadsTheWave) {
  const Scene s = read();
  EXPECT_EQ(s.title, "Viscous standing wave");
  EXPECT_EQ(s.fluid.sound_speed, 10.0);
  EXPECT_EQ(s.gravity[2], -1.0);
  EXPECT_EQ(s.domain.sides[0], (std::array<Scene::Side, 2>{Scene::Side::periodic, Scene::Side::periodic}));
  EXPECT_EQ(s.domain.sides[2], (std::array<Scene::Side, 2>{Scene::Side::symmetry, Scene::Side::open}));
  EXPECT_NEAR(s.initial.u(1, 0, 0, 0), -0.05, 1e-15);
  EXPECT_TRUE(s.has_free_surface());
  EXPECT_TRUE(s.has_region());
  EXPECT_EQ(s.coupling.schedule.schedule, coupler::Schedule::predicted);
  EXPECT_FALSE(s.coupling.window.dt);
  EXPECT_EQ(s.time.end, 17.8);
  EXPECT_EQ(s.velocity_scale(), 0.25);
  EXPECT_EQ(read({"reference_velocity=0"}).velocity_scale(), 1.0);
}

TEST_F(SceneTest, BodyForceIsAFormulaAndHasNoYInThePlane) {
  EXPECT_FALSE(read().has_body_force());
  const Scene s = read({"body_force.x=-k*x"});
  EXPECT_TRUE(s.has_body_force());
  EXPECT_NEAR(s.body_force.x(2, 0, 0, 0), -2 * std::acos(-1.0), 1e-14);
  EXPECT_NE(s.digest, read().digest);
  EXPECT_NE(refusal({"body_force.y=1"}).find("body_force.y"), std::string::npos);
}

TEST_F(SceneTest, ResolvedTextReadsBackTheSameDigest) {
  for (const std::vector<std::string>& settings :
       {std::vector<std::string>{},
        {"coupling.dt=0.01"},
        {"regions=[]", "coupling.kind=none", "fluid.sound_speed=.inf"}}) {
    const Scene s = read(settings);
    const Scene again = read({}, s.resolved());
    EXPECT_EQ(again.digest, s.digest) << s.resolved();
    EXPECT_EQ(again.initial.u(0.3, 0, 0, 0), s.initial.u(0.3, 0, 0, 0));
  }
}

TEST_F(SceneTest, DigestTellsScenesApart) {
  EXPECT_EQ(read().digest.size(), 16U);
  EXPECT_NE(read().digest, read({"fluid.density=1.0000000000000002"}).digest);
  EXPECT_EQ(read().digest, read({"fluid.density=1e0"}).digest);
  EXPECT_NE(read().digest, read({"time.end=20"}).digest);
  EXPECT_EQ(read().restart_digest,
            read({"time.end=20", "title=again", "coupling.deadline=1"}).restart_digest);
  EXPECT_NE(read().restart_digest, read({"initial.w=0.1*x"}).restart_digest);
}

TEST_F(SceneTest, OnlyFacesInsideTheDomainAreOpen) {
  const Scene s = read();
  EXPECT_FALSE(s.open_face(s.regions[0], 0, 0));
  EXPECT_FALSE(s.open_face(s.regions[0], 1, 0));
  EXPECT_TRUE(s.open_face(s.regions[0], 2, 0));
  EXPECT_FALSE(s.open_face(s.regions[0], 2, 1));
}

TEST_F(SceneTest, StandaloneNeedsNoRegion) {
  EXPECT_NO_THROW(
      read({}, "fluid: {sound_speed: .inf}\ndomain: {lower: [0, 0, 0], upper: [1, 1, 1]}\ntime: {end: 1}\n"));
  EXPECT_TRUE(std::isinf(read({"coupling.kind=none", "fluid.sound_speed=.inf"}).fluid.sound_speed));
}

TEST_F(SceneTest, EmptyMapListsWhatIsRequired) {
  EXPECT_EQ(refusal({}, "{}"),
            folder_ / "scene.yaml: key 'fluid.sound_speed' is missing; expected a number.\n" +
                (folder_ / "scene.yaml: key 'domain.lower' is missing; expected three numbers [x, y, z].\n") +
                (folder_ / "scene.yaml: key 'domain.upper' is missing; expected three numbers [x, y, z].\n") +
                (folder_ / "scene.yaml: key 'time.end' is missing; expected a number."));
}

TEST_F(SceneTest, NumbersOutOfRange) {
  EXPECT_CONTAINS(refusal({"dimension=4"}),
                  "--set dimension=4: 'dimension' is 4; expected a value >= 2 and <= 3.");
  EXPECT_CONTAINS(refusal({"fluid.density=-1"}), "'fluid.density' is -1 kg/m^3; expected a value > 0.");
  EXPECT_CONTAINS(refusal({"fluid.viscosity=-1"}), "'fluid.viscosity' is -1 m^2/s; expected a value >= 0.");
  EXPECT_CONTAINS(refusal({"fluid.density=.inf"}), "expected a finite number");
  EXPECT_CONTAINS(refusal({"time.end=0"}), "'time.end' is 0 s; expected a value > 0.");
  EXPECT_CONTAINS(refusal({"coupling.substeps=0"}), "expected a value >= 1.");
  EXPECT_CONTAINS(refusal({"coupling.deadline=0"}), "expected a value > 0.");
  EXPECT_CONTAINS(refusal({"coupling.fringe_layers=1"}), "expected a value >= 2.");
}

TEST_F(SceneTest, TextInANumericKeyHasItsLine) {
  std::string text = k_wave;
  text.replace(text.find("blending_width: 0.08"), 20, "blending_width: 2*dx");
  EXPECT_EQ(refusal({}, text),
            folder_ /
                "scene.yaml:9: 'coupling.blending_width' is '2*dx'; expected a number, or a formula of "
                "the constants H, a, k.");
}

TEST_F(SceneTest, Domain) {
  EXPECT_CONTAINS(refusal({"domain.x=[periodic, open]"}), "'domain.x': periodic on one side only");
  EXPECT_CONTAINS(refusal({"domain.x=[periodic, wall]"}),
                  "'domain.x' is 'wall'; expected one of open, periodic, symmetry");
  EXPECT_CONTAINS(refusal({"domain.upper=[2, 0, -1]"}),
                  "'domain.upper': along z -1 m is not above domain.lower, -1 m.");
}

TEST_F(SceneTest, PlaneHasNoY) {
  EXPECT_CONTAINS(refusal({"gravity=[0, -1, 0]"}), "'gravity': has a component along y");
  EXPECT_CONTAINS(refusal({"initial.v=x"}), "'initial.v': is a velocity along y");
  EXPECT_CONTAINS(refusal({"domain.y=symmetry"}), "'domain.y': a 2-D scene has no direction y");
  EXPECT_CONTAINS(refusal({"dimension=3"}), "'domain.upper': along y 0 m is not above domain.lower, 0 m.");
}

TEST_F(SceneTest, RegionsAndLayers) {
  EXPECT_CONTAINS(refusal({"regions[0].lower=[0, 0, -2]"}),
                  "'regions[0].lower': along z -2 m is outside the domain, which begins at -1 m.");
  EXPECT_CONTAINS(refusal({"regions[0].upper=[3, 0, 0.5]"}),
                  "'regions[0].upper': along x 3 m is outside the domain, which ends at 2 m.");
  EXPECT_CONTAINS(refusal({"regions[0].upper=[2, 0, -0.6]"}),
                  "'regions[0].upper': along z -0.6 m is not above");
  EXPECT_CONTAINS(
      refusal({"regions[0].lower=[0, 0, 0.4]"}),
      "thick along z, thinner than its layers, 0.16 m (coupling.blending_width + coupling.driven_width).");
  EXPECT_CONTAINS(refusal({"coupling.driven_width=0.5"}),
                  "'regions[0].lower': the layers outside this face, 0.58 m (coupling.blending_width + "
                  "coupling.driven_width), do not fit: the domain begins 0.5 m below it along z.");
  EXPECT_CONTAINS(refusal({"coupling.driven_width=0"}), "'coupling.driven_width': is 0");
  EXPECT_CONTAINS(refusal({"regions=[]"}), "'regions': a coupled scene needs the region of the particles.");
  EXPECT_CONTAINS(refusal({"regions[1].lower=[0, 0, 0]", "regions[1].upper=[1, 0, 0.5]"}),
                  "'regions[1]': overlaps regions[0].");
  EXPECT_CONTAINS(refusal({"fluid.sound_speed=.inf"}),
                  "'fluid.sound_speed': particles need a finite sound speed");
  EXPECT_CONTAINS(refusal({"coupling.dt=0.1", "coupling.substeps=2"}), "given together with coupling.dt");
}

TEST_F(SceneTest, WhatIsHardlyMeantIsWarnedOf) {
  EXPECT_EQ(scene_warnings(read()), std::vector<std::string>{});
  const auto warning = [&](const std::vector<std::string>& settings) {
    const auto warnings = scene_warnings(read(settings));
    return warnings.size() == 1 ? warnings[0] : std::to_string(warnings.size()) + " warnings";
  };
  EXPECT_CONTAINS(warning({"gravity=[0, 0, 1]"}), "gravity points up, 1 m/s^2 along z");
  EXPECT_CONTAINS(warning({"fluid.sound_speed=1", "reference_velocity=0.01"}),
                  "less than sqrt(g H) = 1.225 m/s");
  EXPECT_CONTAINS(warning({"reference_velocity=3"}), "less than five times the flow's 3 m/s");
  EXPECT_CONTAINS(warning({"initial.w=4"}), "less than five times the flow's 4 m/s");
}

TEST_F(SceneTest, AWindowLongerThanTheRunIsRefused) {
  EXPECT_NE(refusal({"coupling.dt=18"}).find("'coupling.dt': a window of 18 s is longer than the whole run"),
            std::string::npos);
  EXPECT_EQ(read({"coupling.dt=17.8"}).coupling.window.dt, 17.8);
}

TEST_F(SceneTest, ProblemsOfBothFilesAreShownTogether) {
  write_text(folder_ / "scene.yaml", k_wave);
  write_text(folder_ / "own.yaml", "scene: scene.yaml\nlength: 2*H\n");
  Fidelity preset{};
  const auto read_own = [&](const std::vector<std::string>& scene_settings, const std::string& own_setting) {
    Document own = Document::from_file(folder_ / "own.yaml");
    if (!own_setting.empty()) own.set(own_setting);
    double length = 0.0;
    std::string scene;
    read_both_files(own, scene_settings, [&](Binder& b, const Scene& read) {
      preset = read.fidelity;
      b.key("scene", scene).doc("");
      b.key("length", length).min(0).doc("");
    });
    return length;
  };
  EXPECT_EQ(read_own({}, ""), 2.0);
  EXPECT_EQ(preset, Fidelity::standard);
  read_own({"fidelity=draft"}, "");
  EXPECT_EQ(preset, Fidelity::draft);
  const std::string both = message_of<ConfigError>([&] { read_own({"fluid.density=-1"}, "lenght=3"); });
  EXPECT_NE(both.find("fluid.density"), std::string::npos) << both;
  EXPECT_NE(both.find("'lenght'"), std::string::npos) << both;
  // constants that are wrong say nothing about the formulas that use them
  const std::string one = message_of<ConfigError>([&] { read_own({"constants.H=oops"}, ""); });
  EXPECT_NE(one.find("constants.H"), std::string::npos) << one;
  EXPECT_EQ(one.find("length"), std::string::npos) << one;
}

TEST_F(SceneTest, RefusesWhatIsNoScene) {
  EXPECT_CONTAINS(refusal({}, ""), "the file is empty");
  EXPECT_CONTAINS(refusal({}, "- 1\n"), "holds a list of 1 at the top");
  EXPECT_CONTAINS(refusal({}, "fluid:\n\tdensity: 1\n"), "not valid YAML");
  EXPECT_CONTAINS(refusal({}, std::string("\x7f"
                                          "ELF\x02\x01\x01\0",
                                          8)),
                  "not a text file");
  EXPECT_CONTAINS(refusal({}, std::string(k_wave) + "dimension: 3\n"), "key 'dimension' is given twice");
  EXPECT_CONTAINS(message_of<ConfigError>([] { Scene::from_file("none.yaml"); }), "none.yaml: cannot open");
}

TEST_F(SceneTest, ContractsOfTheSameSceneAgree) {
  EXPECT_TRUE(read().contract().compare(read().contract()).empty());
  const Scene infinite = read({"coupling.kind=none", "fluid.sound_speed=.inf"});
  EXPECT_TRUE(infinite.contract().compare(infinite.contract()).empty());
}

// Another solver knows the physics and the windows, but has no scene file to take a digest of.
TEST_F(SceneTest, ContractAsksOnlyForWhatTheExchangeNeeds) {
  std::string required;
  for (const auto& mismatch : read().contract().compare({})) required += mismatch.key + " ";
  EXPECT_EQ(required,
            "dimension axes sign of phi fluid.density fluid.sound_speed fluid.reference_pressure "
            "fluid.viscosity gravity.x gravity.y gravity.z free surface phi crosses regions "
            "regions[0].lower.x regions[0].lower.y regions[0].lower.z regions[0].upper.x regions[0].upper.y "
            "regions[0].upper.z coupling.kind coupling.schedule coupling.passes coupling.substeps "
            "time.end ");
}

TEST_F(SceneTest, ContractNamesEveryDifference) {
  const auto keys = [&](const std::vector<std::string>& settings) {
    std::string out;
    for (const auto& mismatch : read().contract().compare(read(settings).contract()))
      out += mismatch.key + " ";
    return out;
  };
  EXPECT_EQ(keys({"gravity=[0, 0, -2]", "fluid.density=2"}), "fluid.density gravity.z scene digest ");
  EXPECT_EQ(keys({"coupling.dt=0.01"}), "coupling.substeps scene digest coupling.dt ");
  EXPECT_EQ(keys({"regions[0].lower=[0, 0, -0.6]"}), "regions[0].lower.z scene digest ");
  EXPECT_EQ(keys({"initial.p=0"}), "scene digest ");
}

TEST_F(SceneTest, HelpListsEveryKeyOfTheResolvedText) {
  Binder help(Binder::Mode::help);
  Scene s;
  s.bind(help);
  for (const char* key : {"title",
                          "dimension",
                          "constants",
                          "density",
                          "sound_speed",
                          "viscosity",
                          "gravity",
                          "lower",
                          "upper",
                          "surface",
                          "regions",
                          "kind",
                          "blending_width",
                          "driven_width",
                          "fringe_layers",
                          "schedule",
                          "passes",
                          "dt",
                          "substeps",
                          "deadline",
                          "end",
                          "max_windows",
                          "field_interval",
                          "checkpoint_interval",
                          "reference_velocity"})
    EXPECT_CONTAINS(help.text(), std::string(key) + ":");
  EXPECT_CONTAINS(help.text(), "none | imposed | forced");
}

}  // namespace
}  // namespace littoral::support
