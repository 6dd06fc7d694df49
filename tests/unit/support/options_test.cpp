#include "littoral/support/options.hpp"

#include "support_test.hpp"

namespace littoral::support {
namespace {

ParsedOptions parse(std::vector<const char*> words) {
  words.insert(words.begin(), "fv_solver");
  return parse_options(static_cast<int>(words.size()), words.data(), "fv_solver", "0.1.0", "Finite volumes.");
}

TEST(OptionsTest, Defaults) {
  const auto parsed = parse({"--config", "fv.yaml"});
  ASSERT_FALSE(parsed.exit_status) << parsed.text;
  EXPECT_EQ(parsed.options.config, "fv.yaml");
  EXPECT_EQ(parsed.options.out, "out");
  EXPECT_FALSE(parsed.options.check || parsed.options.print_config || parsed.options.help_config);
}

TEST(OptionsTest, SettingsGoToTheirFiles) {
  const auto parsed = parse({"--config", "fv.yaml", "--set", "time.cfl=2", "--set", "scene.fluid.density=1",
                             "--set", "blocks[0].cells=[8, 1, 8]", "--set", "shift=-1"});
  ASSERT_FALSE(parsed.exit_status) << parsed.text;
  EXPECT_EQ(parsed.options.settings,
            (std::vector<std::string>{"time.cfl=2", "blocks[0].cells=[8, 1, 8]", "shift=-1"}));
  EXPECT_EQ(parsed.options.scene_settings, std::vector<std::string>{"fluid.density=1"});
}

TEST(OptionsTest, EveryFlag) {
  const auto o = parse({"--config=fv.yaml", "--out", "results", "--check", "--print-config", "--help-config",
                        "--restart", "a.h5", "--record", "b.h5"})
                     .options;
  EXPECT_TRUE(o.check && o.print_config && o.help_config);
  EXPECT_EQ(o.out + o.restart + o.record, "resultsa.h5b.h5");
  EXPECT_EQ(parse({"--config", "c", "--replay", "r.h5"}).options.replay, "r.h5");
}

TEST(OptionsTest, HelpAndVersionEndWell) {
  EXPECT_EQ(parse({"--help"}).exit_status, 0);
  for (const char* name : {"--config", "--out", "--set", "--check", "--print-config", "--help-config",
                           "--restart", "--record", "--replay", "--version"})
    EXPECT_CONTAINS(parse({"--help"}).text, name);
  EXPECT_EQ(parse({"--version"}).exit_status, 0);
  EXPECT_CONTAINS(parse({"--version"}).text, "fv_solver 0.1.0");
  EXPECT_FALSE(parse({"--help-config"}).exit_status);
}

TEST(OptionsTest, BadUsageIsNamed) {
  const auto expect = [](const std::vector<const char*>& words, const std::string& text) {
    const auto parsed = parse(words);
    ASSERT_TRUE(parsed.exit_status);
    EXPECT_NE(*parsed.exit_status, 0);
    EXPECT_CONTAINS(parsed.text, text);
    EXPECT_CONTAINS(parsed.text, "fv_solver --help");
  };
  expect({}, "--config FILE is required");
  expect({"--config"}, "--config");
  expect({"--config", "a", "--confg", "b"}, "--confg");
  expect({"--config", "a", "stray"}, "stray");
  expect({"--config", "a", "--set"}, "--set");
  expect({"--config", "a", "--set", "time.end"}, "--set time.end: expected KEY=VALUE");
  expect({"--config", "a", "--set", "a=1", "b=2"}, "b=2");
  expect({"--config", "a", "--record", "x", "--replay", "y"}, "--replay");
}

}  // namespace
}  // namespace littoral::support
