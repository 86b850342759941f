// What lets zsh complete the program's words.
#include "apps/completion.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string_view>

namespace sofof::apps {

namespace {

/// Functions that know nothing of any command.
constexpr std::string_view zsh_functions = R"zsh(
# Files, and names of those that `sofof run` finds.
_sofof_scenarios() {
  local share=${commands[sofof]:A:h:h}/share/sofof
  local -a names
  names=({config,config/bench,$share/config,$share/config/bench}/*.toml(N:t:r))
  compadd -- $names
  _files -g '*.toml'
}

_sofof_policies() { compadd -- $_sofof_policy_names }
_sofof_policy_list() { _values -s , policy $_sofof_policy_names }

# KEY=VALUE; of a list of tables any element has the keys of the first.
_sofof_changes() {
  local key=${PREFIX%%=*}
  if [[ $PREFIX == *=* ]]; then
    compset -P '*='
    local -a values
    values=(${=_sofof_values[${key/.<->./.0.}]})
    compadd -- $values
    return
  fi
  local head=${key%%.*} rest=${key#*.}
  local -a keys
  keys=($_sofof_keys)
  if [[ $rest == <->.* ]]; then
    keys=(${keys/#$head.0./$head.${rest%%.*}.})
  fi
  compadd -S = -- $keys
}
)zsh";

/// @returns text between the single quotes of `_arguments`.
std::string quoted_for_zsh(std::string_view text, std::string_view special) {
  std::string made;
  for (const auto c : text) {
    if (c == '\'')
      made += "'\\'";
    else if (special.find(c) != special.npos)
      made += '\\';
    made += c;
  }
  return made;
}

std::string action_of(const listed_argument& one) {
  switch (one.kind) {
    case argument_kind::file:
      return "_files";
    case argument_kind::folder:
      return "_files -/";
    case argument_kind::scenario:
      return "_sofof_scenarios";
    case argument_kind::policy:
      return "_sofof_policies";
    case argument_kind::policies:
      return "_sofof_policy_list";
    case argument_kind::change:
      return "_sofof_changes";
    case argument_kind::words:
    case argument_kind::command:
      return fmt::format("({})", fmt::join(one.words, " "));
    default:
      return " ";
  }
}

/// @returns what `_arguments` shall know of it, a line each.
std::string lines_of(const listed_command& command) {
  std::string text;
  for (const auto& option : command.options)
    for (const auto& name : option.names) {
      text += fmt::format("        '{}{}[{}]", option.several ? "*" : "", name,
                          quoted_for_zsh(option.about, "[]:"));
      if (option.kind != argument_kind::nothing)
        text += fmt::format(":{}:{}", quoted_for_zsh(option.value, "[]:"),
                            action_of(option));
      text += "' \\\n";
    }
  for (const auto& argument : command.arguments)
    text += fmt::format("        '{}:{}:{}' \\\n", argument.several ? "*" : "",
                        argument.names.front(), action_of(argument));
  return text;
}

std::string commands_function(const std::vector<listed_command>& all) {
  std::string text = "_sofof_command() {\n  case $1 in\n";
  for (const auto& command : all)
    text += fmt::format("    '{}')\n      _arguments \\\n{}        && return\n"
                        "      ;;\n",
                        command.name, lines_of(command));
  return text + "  esac\n}\n";
}

std::string begin_of_all(const std::vector<listed_command>& all) {
  std::string text = "_sofof() {\n  local -a known\n  known=(\n";
  std::string nested;
  for (const auto& command : all)
    if (command.name.find(' ') == std::string::npos)
      text += fmt::format("    '{}:{}'\n", command.name,
                          quoted_for_zsh(command.about, ""));
    else
      nested += fmt::format("'{}' ", command.name);
  return text
         + fmt::format("    'help:Tell more of a command'\n  )\n"
                       "  local -a nested\n  nested=({})\n",
                       nested);
}

constexpr std::string_view zsh_end = R"zsh(  if ((CURRENT == 2)); then
    _describe command known
    return
  fi
  local command=$words[2]
  if [[ $command == help ]]; then
    _describe command known
    return
  fi
  shift words
  ((CURRENT--))
  if ((CURRENT > 2 && ${nested[(Ie)$command $words[2]]})); then
    command+=" $words[2]"
    shift words
    ((CURRENT--))
  fi
  _sofof_command $command
}
compdef _sofof sofof
[[ $funcstack[1] != _sofof ]] || _sofof "$@"
)zsh";

} // namespace

std::string zsh_completion(const completed_words& all) {
  std::vector<std::string> keys;
  std::string values = "typeset -gA _sofof_values\n_sofof_values=(\n";
  for (const auto& key : all.keys) {
    keys.push_back(key.key);
    if (!key.values.empty())
      values += fmt::format("  {} '{}'\n", key.key, fmt::join(key.values, " "));
  }
  return fmt::format(
      "#compdef sofof\n# Completion of sofof's words in zsh, as `sofof "
      "completion zsh` prints it.\n\ntypeset -ga _sofof_policy_names "
      "_sofof_keys\n_sofof_policy_names=(\n{}\n)\n_sofof_keys=(\n{}\n)\n{})\n"
      "{}{}\n{}{}",
      wrapped_words(all.policies), wrapped_words(keys), values, zsh_functions,
      commands_function(all.commands), begin_of_all(all.commands), zsh_end);
}

} // namespace sofof::apps
