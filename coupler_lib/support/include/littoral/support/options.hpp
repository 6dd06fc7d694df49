#pragma once

#include <optional>
#include <string>
#include <vector>

namespace littoral::support {

/// The command line, the same for both programs.
struct ProgramOptions {
  std::string config;                       // --config: the program's own file
  std::string out = "out";                  // --out: folder of results; each program writes to OUT/<program>
  std::vector<std::string> settings;        // --set KEY=VALUE for the program's file
  std::vector<std::string> scene_settings;  // --set scene.KEY=VALUE, without the "scene."
  bool check = false;                       // --check: read everything, build nothing
  bool print_config = false;                // --print-config: resolved YAML of scene and program
  bool help_config = false;                 // --help-config: every key with type, unit, range, default
  std::string restart;                      // --restart: checkpoint to continue from
  std::string record;                       // --record: file to record the partner in
  std::string replay;                       // --replay: record to play in the partner's place
};

/// Options, or what ends the program at once: a text for the screen and the exit status.
struct ParsedOptions {
  ProgramOptions options;
  std::optional<int> exit_status;  // of --help, --version, or bad usage (non-zero)
  std::string text;
};

/// An option that one program has besides: --name TEXT.
struct OwnOption {
  std::string name;  // with its dashes
  std::string doc;
  std::string* value;
};

/// Reads the command line; prints nothing and does not exit, so that in a job of many ranks one can speak for
/// all.
ParsedOptions parse_options(int argc, const char* const* argv, const std::string& program,
                            const std::string& version, const std::string& description,
                            const std::vector<OwnOption>& own = {});

}  // namespace littoral::support
