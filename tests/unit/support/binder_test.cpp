#include <cmath>
#include <limits>

#include "littoral/support/config.hpp"
#include "support_test.hpp"

namespace littoral::support {
namespace {

enum class Flux { godunov, central };

struct BlockConfig {
  std::array<int, 3> cells = {1, 1, 1};
  double stretch = 1.0;
};

/// One key of every type.
struct Sample {
  double cfl = 0.9;
  std::optional<double> dt;
  int max_steps = 100;
  bool verbose = false;
  std::string label = "a \"b\"\n#c";
  std::array<double, 3> origin = {0.1, 1.0 / 3.0, -2};
  std::vector<double> levels = {1, 2.5};
  std::vector<std::string> names = {"one", "two: three"};
  Formula inflow{1.5};
  std::optional<Formula> surface;
  Flux flux = Flux::godunov;
  std::array<Flux, 2> sides = {Flux::central, Flux::godunov};
  std::map<std::string, double> constants;
  std::vector<BlockConfig> blocks;
  bool has_probe = false;
  double probe_depth = 0.5;

  void bind(Binder& b) {
    const std::vector<std::pair<std::string, Flux>> words = {{"godunov", Flux::godunov},
                                                             {"central", Flux::central}};
    b.numbers("constants", "For formulas.", constants);
    b.section("time", "The clock.", [&] {
      b.key("cfl", cfl).unit("-").exclusive_min(0).max(2).doc("Factor on the acoustic limit.");
      b.key("dt", dt).unit("s").exclusive_min(0).doc("Step.");
      b.key("max_steps", max_steps).min(1).doc("Stop.");
    });
    b.key("verbose", verbose).doc("Talk.");
    b.key("label", label).doc("A name.");
    b.key("origin", origin).unit("m").doc("A point.");
    b.key("levels", levels).unit("m").min(0).doc("Heights.");
    b.key("names", names).doc("Words.");
    b.key("inflow", inflow).unit("m/s").doc("Velocity.");
    b.key("surface", surface).unit("m").doc("Level.");
    b.choice("flux", flux, words).doc("Kind.");
    b.choices("sides", sides, words).doc("Both.");
    b.list<BlockConfig>("blocks", "The grid.", blocks, [](Binder& item, BlockConfig& block) {
      item.key("cells", block.cells).min(1).required().doc("Counts.");
      item.key("stretch", block.stretch).exclusive_min(0).doc("Ratio.");
    });
    b.section(
        "probe", "A gauge.", [&] { b.key("depth", probe_depth).unit("m").doc("Depth."); }, &has_probe);
  }
};

Sample read(const std::string& text, const std::vector<std::string>& settings = {}) {
  Document document = Document::from_text(text, "fv.yaml");
  for (const auto& setting : settings) document.set(setting);
  Binder binder(document);
  Sample sample;
  sample.bind(binder);
  binder.finish();
  return sample;
}

std::string refusal(const std::string& text, const std::vector<std::string>& settings = {}) {
  return message_of<ConfigError>([&] { read(text, settings); });
}

std::string resolved(Sample sample) {
  Binder binder(Binder::Mode::resolved);
  sample.bind(binder);
  return binder.text();
}

TEST(BinderTest, AbsentKeysKeepTheirDefaults) {
  const Sample s = read("{}");
  EXPECT_EQ(resolved(s), resolved(Sample{}));
}

TEST(BinderTest, NumbersMayBeFormulasOfConstants) {
  const Sample s = read(R"(
constants: {H: 2, n: 25, dx: H/n}
time: {cfl: H/4, dt: dx/10, max_steps: n + 1}
origin: [-H, 0, dx]
levels: [2*dx]
blocks: [{cells: [2/dx, 1, n]}]
)");
  EXPECT_EQ(s.cfl, 0.5);
  EXPECT_EQ(*s.dt, 2.0 / 25 / 10);
  EXPECT_EQ(s.max_steps, 26);
  EXPECT_EQ(s.origin, (std::array<double, 3>{-2, 0, 0.08}));
  EXPECT_EQ(s.levels[0], 0.16);
  EXPECT_EQ(s.blocks[0].cells, (std::array<int, 3>{25, 1, 25}));
}

TEST(BinderTest, RefusesFormulasThatGiveNoNumber) {
  const std::string constants = "constants: {H: 2}\ntime: ";
  EXPECT_CONTAINS(refusal(constants + "{cfl: 2*x}"), "expected a number, or a formula of the constants H");
  EXPECT_CONTAINS(refusal(constants + "{cfl: 2*q}"), "expected a number, or a formula of the constants H");
  EXPECT_CONTAINS(refusal(constants + "{cfl: 1/0}"), "expected a number");
  EXPECT_CONTAINS(refusal(constants + "{max_steps: H/3}"), "expected a whole number");
}

TEST(BinderTest, ReadsEveryType) {
  const Sample s = read(R"(
constants: {H: 2, k: 2*H + 1}
time: {cfl: 1.5, dt: 1e-3, max_steps: 1e3}
verbose: yes
label: hello
origin: [1, -2, .5]
levels: []
names: [a, b]
inflow: "k*x"
surface: z - H
flux: central
sides: godunov
blocks:
  - cells: [8, 1, 4]
  - {cells: [2, 2, 2], stretch: 1.1}
probe: {depth: 3}
)");
  EXPECT_EQ(s.constants.at("k"), 5.0);
  EXPECT_EQ(s.cfl, 1.5);
  EXPECT_EQ(s.dt, 1e-3);
  EXPECT_EQ(s.max_steps, 1000);
  EXPECT_TRUE(s.verbose);
  EXPECT_EQ(s.label, "hello");
  EXPECT_EQ(s.origin, (std::array<double, 3>{1, -2, 0.5}));
  EXPECT_TRUE(s.levels.empty());
  EXPECT_EQ(s.names, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(s.inflow(3, 0, 0, 0), 15.0);
  EXPECT_EQ((*s.surface)(0, 0, 5, 0), 3.0);
  EXPECT_EQ(s.flux, Flux::central);
  EXPECT_EQ(s.sides[0], Flux::godunov);
  ASSERT_EQ(s.blocks.size(), 2U);
  EXPECT_EQ(s.blocks[0].cells, (std::array<int, 3>{8, 1, 4}));
  EXPECT_EQ(s.blocks[1].stretch, 1.1);
  EXPECT_TRUE(s.has_probe);
  EXPECT_EQ(s.probe_depth, 3.0);
}

TEST(BinderTest, UnknownKeyNamesLineNearestAndKnown) {
  EXPECT_EQ(refusal("verbose: on\ntime:\n  clf: 1\n"),
            "fv.yaml:3: unknown key 'time.clf'. Did you mean 'time.cfl'? Known keys: cfl, dt, max_steps.");
  EXPECT_CONTAINS(refusal("cfl: 1\n"), "fv.yaml:1: unknown key 'cfl'. Did you mean 'time.cfl'?");
  EXPECT_CONTAINS(
      refusal("blocks:\n- cells: [1, 1, 1]\n  strech: 2\n"),
      "fv.yaml:3: unknown key 'blocks[0].strech'. Did you mean 'blocks[0].stretch'? Known keys: cells, "
      "stretch.");
  const std::string far = refusal("zzzzzzzz: 1\n");
  EXPECT_CONTAINS(far, "unknown key 'zzzzzzzz'. Known keys: constants, time, verbose");
}

TEST(BinderTest, AllProblemsTogetherInTheOrderOfTheFile) {
  EXPECT_EQ(refusal("tme: 3\nverbose: maybe\ntime:\n  max_steps: 0\n  cfl: fast\nblocks:\n- stretch: -1\n",
                    {"time.dt=0"}),
            "fv.yaml:1: unknown key 'tme'. Did you mean 'time'? Known keys: constants, time, verbose, label, "
            "origin, "
            "levels, names, inflow, surface, flux, sides, blocks, probe.\n"
            "fv.yaml:2: 'verbose' is 'maybe'; expected true or false.\n"
            "fv.yaml:4: 'time.max_steps' is 0; expected a value >= 1.\n"
            "fv.yaml:5: 'time.cfl' is 'fast'; expected a number.\n"
            "fv.yaml:7: key 'blocks[0].cells' is missing; expected three whole numbers [x, y, z].\n"
            "fv.yaml:7: 'blocks[0].stretch' is -1; expected a value > 0.\n"
            "--set time.dt=0: 'time.dt' is 0 s; expected a value > 0.");
}

TEST(BinderTest, WrongTypes) {
  EXPECT_CONTAINS(refusal("time: {cfl: [1]}"), "'time.cfl' is a list of 1; expected a number.");
  EXPECT_CONTAINS(refusal("time: {cfl: }"), "'time.cfl' is nothing; expected a number.");
  EXPECT_CONTAINS(refusal("time: {cfl: {a: 1}}"), "'time.cfl' is a section; expected a number.");
  EXPECT_CONTAINS(refusal("time: {cfl: 1 s}"), "'time.cfl' is '1 s'; expected a number.");
  EXPECT_CONTAINS(refusal("time: {cfl: 1e999}"), "'time.cfl' is '1e999'; expected a number.");
  EXPECT_CONTAINS(refusal("time: {cfl: .inf}"), "'time.cfl' is '.inf'; expected a finite number.");
  EXPECT_CONTAINS(refusal("time: {cfl: inf}"), "infinity is .inf");
  EXPECT_CONTAINS(refusal("time: {cfl: .nan}"), "'time.cfl' is not a number");
  EXPECT_CONTAINS(refusal("time: {max_steps: 1.5}"), "'1.5'; expected a whole number.");
  EXPECT_CONTAINS(refusal("time: {max_steps: 1e10}"), "expected a whole number.");
  EXPECT_CONTAINS(refusal("time: 3"), "'time' is a section of keys; found '3'.");
  EXPECT_CONTAINS(refusal("origin: [1, 2]"), "'origin' is a list of 2; expected three numbers [x, y, z].");
  EXPECT_CONTAINS(refusal("origin: [1, two, 3]"), "'origin' is 'two'; expected a number.");
  EXPECT_CONTAINS(refusal("levels: [1, -2]"), "'levels' is -2 m; expected a value >= 0.");
  EXPECT_CONTAINS(refusal("levels: 1"), "'levels' is '1'; expected a list of numbers.");
  EXPECT_CONTAINS(refusal("names: {a: 1}"), "expected a list of texts");
  EXPECT_CONTAINS(refusal("flux: centrl"),
                  "'flux' is 'centrl'; expected one of godunov, central. Did you mean 'central'?");
  EXPECT_CONTAINS(refusal("sides: [central]"), "expected [lower, upper], each godunov | central.");
  EXPECT_CONTAINS(refusal("blocks: {cells: 1}"), "'blocks' is a list, one '- ' an item; found a section.");
  EXPECT_CONTAINS(refusal("blocks: [7]"), "an item of 'blocks' is a section of keys; found '7'.");
  EXPECT_CONTAINS(refusal("constants: [1]"), "'constants' is a map of names and numbers; found a list of 1.");
}

TEST(BinderTest, BadFormulaHasLineAndPosition) {
  EXPECT_CONTAINS(
      refusal("constants: {H: 1}\ninflow: 2*cso(x)\n"),
      "fv.yaml:2: 'inflow': formula '2*cso(x)', character 3: unknown name 'cso'. Did you mean 'cos'? Known "
      "names: x, y, z, t, pi, e, H.");
}

TEST(BinderTest, Constants) {
  EXPECT_CONTAINS(refusal("constants: {a: b, b: 1}"),
                  "'constants.a': formula 'b', character 1: unknown name 'b'");
  EXPECT_CONTAINS(refusal("constants: {a: 2*x}"), "'constants.a' depends on x, y, z or t");
  EXPECT_CONTAINS(refusal("constants: {x: 2}"), "'constants.x': this name is already taken.");
  EXPECT_CONTAINS(refusal("constants: {pi: 3}"), "already taken");
  EXPECT_CONTAINS(refusal("constants: {2a: 3}"), "letters, digits and _ only");
  EXPECT_CONTAINS(refusal("constants: {a: 1/0}"), "'constants.a' is .inf; expected a finite number.");
  Document document = Document::from_text("inflow: depth*x", "fv.yaml");
  Binder binder(document);
  binder.use_constants({{"depth", 3.0}});
  Sample s;
  s.bind(binder);
  binder.finish();
  EXPECT_EQ(s.inflow(2, 0, 0, 0), 6.0);
}

TEST(BinderTest, KeyGivenTwice) {
  EXPECT_EQ(refusal("time:\n  cfl: 1\n  dt: 1\n  cfl: 2\n"),
            "fv.yaml:4: key 'time.cfl' is given twice; first at fv.yaml:2.");
}

TEST(BinderTest, SettingsReplaceAndAdd) {
  const Sample s = read("time: {cfl: 1}\nblocks: [{cells: [1, 2, 3]}]\n",
                        {"time.cfl=0.5", "label=from the line", "blocks[0].cells=[4, 5, 6]",
                         "blocks[1].cells=[7, 8, 9]", "probe.depth=9"});
  EXPECT_EQ(s.cfl, 0.5);
  EXPECT_EQ(s.label, "from the line");
  ASSERT_EQ(s.blocks.size(), 2U);
  EXPECT_EQ(s.blocks[0].cells[2], 6);
  EXPECT_EQ(s.blocks[1].cells[2], 9);
  EXPECT_EQ(s.probe_depth, 9.0);
}

TEST(BinderTest, ItemsOfTheDefaultDoNotShowThrough) {
  Sample s;
  s.blocks.resize(2);
  s.blocks[0].stretch = 7.0;
  Binder binder(Document::from_text("blocks: [{cells: [1, 2, 3]}]", "fv.yaml"));
  s.bind(binder);
  binder.finish();
  ASSERT_EQ(s.blocks.size(), 1U);
  EXPECT_EQ(s.blocks[0].stretch, 1.0);
}

TEST(BinderTest, SettingOfAnUnknownKeyIsNamed) {
  EXPECT_EQ(
      refusal("{}", {"time.clf=2"}),
      "--set time.clf=2: unknown key 'time.clf'. Did you mean 'time.cfl'? Known keys: cfl, dt, max_steps.");
}

TEST(BinderTest, ResolvedTextReadsBackTheSame) {
  const Sample s = read(R"(
constants: {third: 1/3, tiny: 4.9e-324}
time: {cfl: 0.1, dt: 1e-17}
label: "tab\t quote\" back\\slash"
inflow: "third * x"
surface: 0.1
flux: central
blocks: [{cells: [1, 2, 3], stretch: 1.0000000000000002}]
probe: {}
)");
  const std::string text = resolved(s);
  const Sample again = read(text);
  EXPECT_EQ(resolved(again), text);
  EXPECT_EQ(again.constants, s.constants);
  EXPECT_EQ(again.dt, s.dt);
  EXPECT_EQ(again.label, s.label);
  EXPECT_EQ(again.origin, s.origin);
  EXPECT_EQ(again.names, s.names);
  EXPECT_EQ(again.blocks[0].stretch, s.blocks[0].stretch);
  EXPECT_EQ(again.inflow(3, 0, 0, 0), s.inflow(3, 0, 0, 0));
  EXPECT_EQ(again.sides, s.sides);
  EXPECT_TRUE(again.has_probe);
}

TEST(BinderTest, HelpListsEveryKeyWithUnitRangeDefaultAndSentence) {
  Binder binder(Binder::Mode::help);
  Sample s;
  s.bind(binder);
  const std::string text = binder.text();
  for (const char* key : {"constants:", "time:", "  cfl:", "  dt:", "  max_steps:", "verbose:", "label:",
                          "origin:", "levels:", "names:", "inflow:", "surface:", "flux:", "sides:", "blocks:",
                          "  - cells:", "    stretch:", "probe:", "  depth:"})
    EXPECT_CONTAINS(text, key);
  EXPECT_CONTAINS(text, "# [-], a number, > 0 and <= 2. Factor on the acoustic limit.");
  EXPECT_CONTAINS(text, "  cfl: 0.9");
  EXPECT_CONTAINS(text, "required. Counts.");
  EXPECT_CONTAINS(text, "godunov | central");
  EXPECT_TRUE(s.blocks.empty());  // the item shown is not left behind
}

TEST(BinderTest, ChecksBetweenKeys) {
  Document document = Document::from_text("a: 1\nb:\n  c: x\n", "fv.yaml");
  Binder binder(document);
  double a = 0, c = 0, d = 0;
  binder.key("a", a).doc("");
  binder.section("b", "", [&] {
    binder.key("c", c).doc("");
    binder.key("d", d).doc("");
  });
  EXPECT_TRUE(binder.sound({"a"}));
  EXPECT_FALSE(binder.sound({"a", "b"}));
  EXPECT_FALSE(binder.sound({"b.c"}));
  EXPECT_TRUE(binder.given("b.c"));
  EXPECT_FALSE(binder.given("b.d"));
  binder.check(false, "a", "is too small.");
  binder.check(false, "b.c", "must not hide the first problem.");
  binder.check(false, "b.d", "is zero.");
  EXPECT_EQ(binder.problems(),
            (std::vector<std::string>{"fv.yaml:1: 'a': is too small.", "fv.yaml:2: 'b.d': is zero.",
                                      "fv.yaml:3: 'b.c' is 'x'; expected a number."}));
}

}  // namespace
}  // namespace littoral::support
