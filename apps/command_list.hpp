// What the commands of the program say of themselves, for completion and for
// the manual.
#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace sofof::apps {

/// What stands behind an option, or in place of an argument.
enum class argument_kind {
  nothing,  ///< A flag.
  anything, ///< What nobody can know.
  file,
  folder,
  scenario, ///< A file, or its name in config/.
  policy,
  policies, ///< By commas.
  change,   ///< KEY=VALUE, as for --set.
  words,    ///< One of a few.
  command,
};

struct listed_argument {
  std::vector<std::string> names; ///< "--jobs" and "-j", or "FILE".
  std::string value;              ///< "N"; empty for a flag or an argument.
  std::string about;
  argument_kind kind = argument_kind::nothing;
  std::vector<std::string> words; ///< Of `words` and `command`.
  bool required = false;
  bool several = false;
};

struct listed_command {
  std::string name; ///< "run", "keys init".
  std::string about;
  std::string footer;
  std::vector<listed_argument> arguments; ///< By place.
  std::vector<listed_argument> options;
};

/// @returns the commands in their order, those with commands of their own
/// before these.
std::vector<listed_command> list_commands(const CLI::App& app);

} // namespace sofof::apps
