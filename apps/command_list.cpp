// What the commands of the program say of themselves.
#include "apps/command_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string_view>
#include <utility>

namespace sofof::apps {

namespace {

/// @returns what a type is called, without what CLI11 adds of its checks.
std::string plain_type(const CLI::Option& option) {
  auto text = option.get_type_name();
  if (const auto checks = text.find(':');
      checks != text.npos && text.find("PORT") == text.npos)
    text.erase(checks);
  while (!text.empty() && text.front() == ' ')
    text.erase(0, 1);
  return text == "TEXT" ? "" : text;
}

std::vector<std::string> words_in(std::string_view type) {
  std::vector<std::string> words;
  while (!type.empty()) {
    const auto end = std::min(type.find('|'), type.size());
    words.emplace_back(type.substr(0, end));
    type.remove_prefix(std::min(end + 1, type.size()));
  }
  return words;
}

/// @param name  Of an option without its dashes, or of an argument.
argument_kind kind_of(std::string_view name, std::string_view type,
                      std::string_view about) {
  if (type.find('|') != type.npos)
    return argument_kind::words;
  if (type == "KEY=VALUE")
    return argument_kind::change;
  if (about.starts_with("Scenario file"))
    return argument_kind::scenario;
  if (name == "policies" || about == "Of a policy")
    return name == "policies" ? argument_kind::policies : argument_kind::policy;
  const auto is = [name, type](std::string_view word) {
    return type == word || name == word;
  };
  if (is("FILE") || is("FILES"))
    return argument_kind::file;
  if (is("DIR") || is("FOLDER") || is("RESULTS") || is("KEYS")
      || name == "keys")
    return argument_kind::folder;
  return argument_kind::anything;
}

listed_argument listed(const CLI::Option& option) {
  listed_argument made;
  for (const auto& name : option.get_lnames())
    made.names.push_back("--" + name);
  for (const auto& name : option.get_snames())
    made.names.push_back("-" + name);
  const auto is_argument = made.names.empty();
  if (is_argument)
    made.names.push_back(option.get_name());
  made.about = option.get_description();
  made.required = option.get_required();
  made.several =
      option.get_items_expected_max() > 1
      || option.get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll;
  if (option.get_items_expected_max() == 0)
    return made; // a flag
  made.value = plain_type(option);
  auto name = made.names.front();
  name.erase(0, is_argument ? 0 : 2);
  made.kind = kind_of(name, made.value, made.about);
  if (made.kind == argument_kind::words)
    made.words = words_in(made.value);
  if (is_argument && made.kind != argument_kind::words)
    made.value.clear();
  return made;
}

constexpr auto any = [](const CLI::App*) { return true; };

void add_options(const CLI::App& command, listed_command& made) {
  for (const auto* option : command.get_options()) {
    if (option->get_group().empty())
      continue; // for tests
    auto one = listed(*option);
    const auto is_argument = !one.names.front().starts_with('-');
    (is_argument ? made.arguments : made.options).push_back(std::move(one));
  }
}

void list_command(const CLI::App& command, const std::string& name,
                  std::vector<listed_command>& all) {
  listed_command made{
      name, command.get_description(), command.get_footer(), {}, {}};
  add_options(command, made);
  listed_argument which{{"COMMAND"}, {},   {}, argument_kind::command,
                        {},          true, {}};
  std::vector<const CLI::App*> inner;
  for (const auto* one : command.get_subcommands(any)) {
    if (one->get_name().empty()) { // a group of options
      add_options(*one, made);
      continue;
    }
    inner.push_back(one);
    which.words.push_back(one->get_name());
  }
  if (!inner.empty())
    made.arguments.push_back(which);
  all.push_back(std::move(made));
  for (const auto* one : inner)
    list_command(*one, fmt::format("{} {}", name, one->get_name()), all);
}

} // namespace

std::vector<listed_command> list_commands(const CLI::App& app) {
  std::vector<listed_command> all;
  for (const auto* command : app.get_subcommands(any))
    list_command(*command, command->get_name(), all);
  return all;
}

} // namespace sofof::apps
