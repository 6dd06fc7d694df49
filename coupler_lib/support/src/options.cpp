#include "littoral/support/options.hpp"

#include <CLI/CLI.hpp>
#include <sstream>

namespace littoral::support {

ParsedOptions parse_options(int argc, const char* const* argv, const std::string& program,
                            const std::string& version, const std::string& description,
                            const std::vector<OwnOption>& own) {
  ParsedOptions parsed;
  ProgramOptions& o = parsed.options;
  std::vector<std::string> settings;

  CLI::App app(description, program);
  app.set_version_flag("--version", program + " " + version);
  app.add_option("--config", o.config, "the program's configuration (YAML); required");
  app.add_option("--out", o.out, "folder of the results")->capture_default_str();
  app.add_option("--set", settings,
                 "KEY=VALUE over the configuration, as time.end=2 or blocks[0].cells=[8,1,8]; "
                 "scene.KEY=VALUE over the scene; may be repeated")
      ->allow_extra_args(false)
      ->take_all()
      ->type_name("KEY=VALUE");
  app.add_flag("--check", o.check,
               "judge the files, predict the size, run nothing; fv_solver builds its grid to judge it");
  app.add_flag("--print-config", o.print_config, "print scene and configuration with all defaults resolved");
  app.add_flag("--help-config", o.help_config, "print every key with type, unit, range and default");
  app.add_option("--restart", o.restart, "checkpoint to continue from");
  auto* record =
      app.add_option("--record", o.record,
                     "record all that the partner says in this file; on several ranks each in FILE.rankKofN");
  app.add_option("--replay", o.replay, "let this record speak in the partner's place, on as many ranks")
      ->excludes(record);
  for (const OwnOption& option : own) app.add_option(option.name, *option.value, option.doc);
  app.get_formatter()->column_width(28);

  const auto refuse = [&](const std::string& problem) {
    parsed.exit_status = 2;
    parsed.text = program + ": " + problem + "\nRun '" + program + " --help' for the options.\n";
    return parsed;
  };
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& ends) {
    std::ostringstream out;
    parsed.exit_status = app.exit(ends, out, out);
    parsed.text = out.str();
    return parsed;
  } catch (const CLI::ParseError& problem) {
    return refuse(problem.what());
  }
  for (const std::string& setting : settings) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos || equals == 0)
      return refuse("--set " + setting + ": expected KEY=VALUE, as in --set time.end=2.5");
    const bool scene = setting.rfind("scene.", 0) == 0;
    if (scene)
      o.scene_settings.push_back(setting.substr(6));
    else
      o.settings.push_back(setting);
  }
  if (o.config.empty() && !o.help_config) return refuse("--config FILE is required.");
  return parsed;
}

}  // namespace littoral::support
