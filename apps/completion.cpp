// sofof completion: lets a shell complete commands, options, scenarios,
// policies and the keys of --set.
#include "apps/completion.hpp"

#include "apps/command.hpp"
#include "base/input_error.hpp"
#include "base/options/spelling.hpp"
#include "experiments/schema/file_schemas.hpp"
#include "policies/registry.hpp"

#include <algorithm>
#include <array>
#include <iostream>
#include <memory>
#include <string_view>

namespace sofof::apps {

namespace {

constexpr std::array<std::string_view, 2> known_shells{"bash", "zsh"};

std::vector<std::string> policy_names() {
  std::vector<std::string> all;
  for (const auto& names :
       {policies::lodm_names(), policies::codm_names(),
        policies::local_filter_names(), policies::central_filter_names(),
        policies::governor_names()})
    all.insert(all.end(), names.begin(), names.end());
  std::ranges::sort(all);
  const auto twice = std::ranges::unique(all);
  all.erase(twice.begin(), twice.end());
  return all;
}

std::string completion_of(std::string_view shell, const CLI::App& app) {
  const auto words = [&app] {
    namespace schema = experiments::schema;
    return completed_words{list_commands(app), policy_names(),
                           schema::set_keys(schema::scenario_options())};
  };
  if (shell == "bash")
    return bash_completion(words());
  if (shell == "zsh")
    return zsh_completion(words());
  throw input_error{unknown_word("shell with completion", shell, known_shells)};
}

} // namespace

std::string wrapped_words(std::span<const std::string> words,
                          const std::string& suffix) {
  constexpr std::size_t width = 78;
  std::string text;
  std::size_t column = 0;
  for (const auto& word : words) {
    const auto size = word.size() + suffix.size() + 1;
    if (column + size > width)
      text += '\n';
    else if (column > 0)
      text += ' ';
    column = column + size > width ? size : column + size;
    text += word + suffix;
  }
  return text;
}

void add_completion(CLI::App& app, int&) {
  auto* command = app.add_subcommand(
      "completion", "Print what lets a shell complete words of sofof");
  auto shell = std::make_shared<std::string>();
  command->add_option("SHELL", *shell, "bash or zsh")
      ->required()
      ->type_name("bash|zsh");
  command->footer("Example:\n  source <(sofof completion bash)\n"
                  "  sofof completion zsh >~/.zfunc/_sofof");
  command->callback([shell, &app] { std::cout << completion_of(*shell, app); });
}

} // namespace sofof::apps
