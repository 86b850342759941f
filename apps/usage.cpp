// Says in our words what CLI11 has found.
#include "apps/usage.hpp"

#include "base/options/spelling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace sofof::apps {

namespace {

const CLI::App& command_of(const CLI::App& app) {
  const auto chosen = app.get_subcommands();
  return chosen.empty() ? app : *chosen.front();
}

std::string name_of(const CLI::App& app, const CLI::App& command) {
  return &app == &command
             ? app.get_name()
             : fmt::format("{} {}", app.get_name(), command.get_name());
}

std::string unknown_option(const CLI::App& command, std::string_view word) {
  std::vector<std::string> names;
  for (const auto* option : command.get_options())
    for (const auto& name : option->get_lnames())
      names.push_back("--" + name);
  const std::vector<std::string_view> known(names.begin(), names.end());
  const auto asked = word.substr(0, word.find('='));
  const auto meant = nearest_word(asked, known);
  return meant.empty() ? std::string{"."}
                       : fmt::format(", did you mean \"{}\"?", meant);
}

/// Words are left over: the first option among them, or the first word.
std::string surplus(const CLI::App& app, std::span<const std::string> words) {
  const auto& command = command_of(app);
  const auto left = app.remaining(true);
  const auto is_left = [&left](const std::string& word) {
    return std::ranges::find(left, word) != left.end();
  };
  const auto is_option = [&](const std::string& word) {
    return word.starts_with('-') && is_left(word);
  };
  const auto name = name_of(app, command);
  if (const auto option = std::ranges::find_if(words, is_option);
      option != words.end())
    return fmt::format("\"{}\" is no option of {}{} {} --help lists them.",
                       *option, name, unknown_option(command, *option), name);
  const auto word = std::ranges::find_if(words, is_left);
  return fmt::format("\"{}\" is one word too many; {} --help tells how it is "
                     "called.",
                     word == words.end() ? "" : *word, name);
}

} // namespace

std::string usage_error(const CLI::App& app, const CLI::ParseError& error,
                        std::span<const std::string> words) {
  const auto is = [&error](CLI::ExitCodes code) {
    return error.get_exit_code() == static_cast<int>(code);
  };
  if (is(CLI::ExitCodes::ExtrasError))
    return surplus(app, words);
  const auto name = name_of(app, command_of(app));
  std::string_view what = error.what();
  if (is(CLI::ExitCodes::ArgumentMismatch) && what.find(':') != what.npos)
    return fmt::format("{} needs a value; {} --help tells more.",
                       what.substr(0, what.find(':')), name);
  what = what.substr(0, what.find('\n'));
  while (what.ends_with('.') || what.ends_with(' '))
    what.remove_suffix(1);
  return fmt::format("{}; {} --help tells more.", what, name);
}

} // namespace sofof::apps
