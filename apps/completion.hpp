// Scripts that let shells complete the program's words.
#pragma once

#include "apps/command_list.hpp"
#include "experiments/schema/set_keys.hpp"

#include <span>
#include <string>
#include <vector>

namespace sofof::apps {

/// All that shells can complete.
struct completed_words {
  std::vector<listed_command> commands;
  std::vector<std::string> policies;
  std::vector<experiments::schema::set_key> keys; ///< For --set.
};

/// @returns names and keys by blanks, a few to a line.
/// @param suffix  Of each.
std::string wrapped_words(std::span<const std::string> words,
                          const std::string& suffix = "");

/// @returns the script for bash.
std::string bash_completion(const completed_words& all);

/// @returns the script for zsh.
std::string zsh_completion(const completed_words& all);

} // namespace sofof::apps
