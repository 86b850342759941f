// What lets bash complete the program's words.
#include "apps/completion.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>
#include <string_view>

namespace sofof::apps {

namespace {

/// Functions that know nothing of any command. Bash takes words apart at = and
/// :, so the line is split by blanks anew, and of an answer it gets what
/// follows the last such sign.
constexpr std::string_view bash_functions = R"bash(
# _sofof_offer LIST: what of it begins as the word does.
_sofof_offer() {
  local IFS=$' \t\n'
  COMPREPLY+=($(compgen -W "$1" -- "$word"))
}

_sofof_files() {
  local IFS=$'\n'
  compopt -o filenames
  COMPREPLY+=($(compgen -f -- "$word"))
}

_sofof_folders() {
  local IFS=$'\n'
  compopt -o filenames
  COMPREPLY+=($(compgen -d -- "$word"))
}

# Files, and names of those that `sofof run` finds.
_sofof_scenarios() {
  local IFS=$'\n' folder file
  COMPREPLY+=($(compgen -f -X '!*.toml' -- "$word"))
  for folder in $(compgen -d -- "$word"); do
    COMPREPLY+=("$folder/")
    compopt -o nospace
  done
  for folder in config config/bench "$(_sofof_share)"/config{,/bench}; do
    for file in "$folder"/*.toml; do
      file=${file##*/} file=${file%.toml}
      [[ $file == '*' || $file != "$word"* || $word == */* ]] \
        || COMPREPLY+=("$file")
    done
  done
}

_sofof_share() {
  local program
  program=$(type -P "${COMP_WORDS[0]}") && program=$(realpath "$program") \
    && printf '%s' "${program%/*/*}/share/sofof"
}

# Names by commas.
_sofof_policies() {
  local whole=$word front=
  [[ $word != *,* ]] || front=${word%,*},
  word=${word##*,}
  _sofof_offer "$_sofof_policy_names"
  word=$whole
  COMPREPLY=("${COMPREPLY[@]/#/$front}")
  compopt -o nospace
}

# KEY=VALUE; of a list of tables any element has the keys of the first.
_sofof_changes() {
  local whole=$word key=${word%%=*} asked= head rest
  head=${key%%.*} rest=${key#*.}
  if [[ $rest == *.* && $_sofof_keys == *[[:space:]]$head.0.* ]] \
    && [[ ! $_sofof_keys == *[[:space:]]$head.${rest%%.*}.* ]]; then
    asked=$head.${rest%%.*}. word=$head.0.${word#"$asked"}
  fi
  if [[ $word == *=* ]]; then
    key=${word%%=*} word=${word#*=}
    _sofof_values "$key"
    COMPREPLY=("${COMPREPLY[@]/#/$key=}")
  else
    _sofof_offer "$_sofof_keys"
    compopt -o nospace
  fi
  [[ ! $asked ]] || COMPREPLY=("${COMPREPLY[@]/#$head.0./$asked}")
  word=$whole
}

# _sofof_place: which argument of the command the word is, from 1 on, and
# "$before" what the option before it wants.
_sofof_place() {
  local i
  place=1
  for ((i = first; i < ${#words[@]} - 1; ++i)); do
    if [[ ${words[i]} != -* ]]; then
      ((place += 1))
    elif [[ ${words[i]} != *=* && $(_sofof_wants "${words[i]}") ]]; then
      ((i += 1))
    fi
  done
}

_sofof() {
  local line=${COMP_LINE:0:COMP_POINT} word before command place first=2
  local -a words
  local split=
  COMPREPLY=()
  read -ra words <<<"$line"
  [[ $line != *[[:space:]] ]] || words+=("")
  word=${words[-1]} command=${words[1]:-}
  if ((${#words[@]} <= 2)); then
    _sofof_offer "$_sofof_commands help --help --version"
  elif [[ $command == help ]]; then
    ((${#words[@]} > 3)) || _sofof_offer "$_sofof_commands"
  else
    if [[ " $_sofof_nested " == *" $command ${words[2]} "* ]] \
      && ((${#words[@]} > 3)); then
      command+=" ${words[2]}" first=3
    fi
    before=${words[-2]}
    if [[ $word == --*=* && $(_sofof_wants "${word%%=*}") ]]; then
      before=${word%%=*} split=$before= word=${word#*=}
    fi
    if [[ $before == -* && $(_sofof_wants "$before") ]]; then
      $(_sofof_wants "$before")
      [[ ! $split ]] || COMPREPLY=("${COMPREPLY[@]/#/$split}")
      word=$split$word
    elif [[ $word == -* ]]; then
      _sofof_offer "$(_sofof_options)"
    else
      _sofof_place
      $(_sofof_argument)
    fi
  fi
  local front=${word%"${word##*[=:]}"}
  [[ $COMP_WORDBREAKS == *=* && $COMP_WORDBREAKS == *:* ]] || front=
  COMPREPLY=("${COMPREPLY[@]#"$front"}")
}
complete -F _sofof sofof
)bash";

/// @returns the shell function that offers what can stand there.
std::string function_of(const listed_argument& one) {
  switch (one.kind) {
    case argument_kind::nothing:
      return "";
    case argument_kind::file:
      return "_sofof_files";
    case argument_kind::folder:
      return "_sofof_folders";
    case argument_kind::scenario:
      return "_sofof_scenarios";
    case argument_kind::policy:
    case argument_kind::policies:
      return "_sofof_policies";
    case argument_kind::change:
      return "_sofof_changes";
    case argument_kind::words:
    case argument_kind::command:
      return fmt::format("_sofof_words {}", fmt::join(one.words, " "));
    default:
      return ":";
  }
}

std::string options_function(const std::vector<listed_command>& all) {
  std::string text = "_sofof_options() {\n  case $command in\n";
  for (const auto& command : all) {
    std::vector<std::string> names;
    for (const auto& option : command.options)
      names.insert(names.end(), option.names.begin(), option.names.end());
    text += fmt::format("    '{}') echo '{}' ;;\n", command.name,
                        wrapped_words(names));
  }
  return text + "  esac\n}\n";
}

/// Tells what an option wants behind it; nothing for a flag.
std::string wants_function(const std::vector<listed_command>& all) {
  std::string text =
      "# _sofof_wants OPTION: what offers its value; nothing for a flag.\n"
      "_sofof_wants() {\n  case \"$command $1\" in\n";
  for (const auto& command : all)
    for (const auto& option : command.options)
      if (const auto wants = function_of(option); !wants.empty())
        for (const auto& name : option.names)
          text += fmt::format("    '{} {}') echo {} ;;\n", command.name, name,
                              wants);
  return text + "  esac\n}\n";
}

std::string argument_function(const std::vector<listed_command>& all) {
  std::string text = "_sofof_argument() {\n  case \"$command $place\" in\n";
  for (const auto& command : all) {
    int place = 0;
    for (const auto& argument : command.arguments)
      text += fmt::format("    '{} '{}) echo {} ;;\n", command.name,
                          argument.several ? "*" : std::to_string(++place),
                          function_of(argument));
  }
  return text + "  esac\n}\n";
}

std::string
values_function(const std::vector<experiments::schema::set_key>& keys) {
  std::map<std::string, std::vector<std::string>> of;
  for (const auto& key : keys)
    if (!key.values.empty())
      of[fmt::format("{}", fmt::join(key.values, " "))].push_back(key.key);
  std::string text = "_sofof_values() {\n  case $1 in\n";
  for (const auto& [values, which] : of)
    text += fmt::format("    {}) _sofof_offer '{}' ;;\n",
                        fmt::join(which, " | \\\n    "), values);
  return text + "  esac\n}\n";
}

} // namespace

std::string bash_completion(const completed_words& all) {
  std::vector<std::string> commands, nested, keys;
  for (const auto& command : all.commands)
    (command.name.find(' ') == std::string::npos ? commands : nested)
        .push_back(command.name);
  for (const auto& key : all.keys)
    keys.push_back(key.key);
  return "# Completion of sofof's words in bash, as `sofof completion bash` "
         "prints it.\n\n"
         + fmt::format("_sofof_commands='{}'\n_sofof_nested='{}'\n"
                       "_sofof_policy_names='{}'\n_sofof_keys='\n{}\n'\n\n",
                       wrapped_words(commands), fmt::join(nested, " "),
                       wrapped_words(all.policies), wrapped_words(keys, "="))
         + "_sofof_words() { _sofof_offer \"$*\"; }\n"
         + options_function(all.commands) + wants_function(all.commands)
         + argument_function(all.commands) + values_function(all.keys)
         + std::string{bash_functions};
}

} // namespace sofof::apps
