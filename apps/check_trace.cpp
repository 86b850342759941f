// sofof check-trace: holds the steps of runs against the protocol's rules.
#include "apps/command.hpp"
#include "experiments/conformance/trace_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <iostream>
#include <memory>
#include <ranges>
#include <string>
#include <vector>

namespace sofof::apps {

namespace {

using namespace experiments::conformance;

/// More of them say no more.
constexpr std::size_t most_shown = 20;

/// @returns the exit code.
int check(const std::vector<std::filesystem::path>& folders) {
  duration slack{};
  for (const auto& folder : folders)
    slack = std::max(slack, slack_of(folder));
  trace_checker checker{slack, chain_of_services()};
  for (std::size_t k = 0; k < folders.size(); ++k)
    read_trace(folders[k], k, checker);
  const auto& breaches = checker.finish();
  if (breaches.empty()) {
    std::cout << fmt::format("All {} steps keep the rules of the protocol.\n",
                             checker.steps());
    return 0;
  }
  for (const auto& x : breaches | std::views::take(most_shown))
    std::cout << fmt::format("{}:{}: {}.\n",
                             trace_file_of(folders[x.at.trace]).string(),
                             x.at.line, in_words(x));
  if (breaches.size() > most_shown)
    std::cout << fmt::format("... and {} more.\n",
                             breaches.size() - most_shown);
  std::cout << fmt::format(
      "Rules of docs/trace.md were broken {} times in {} steps.\n",
      breaches.size(), checker.steps());
  return 1;
}

} // namespace

void add_check_trace(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand(
      "check-trace", "Hold the steps of runs against the protocol's rules");
  auto folders = std::make_shared<std::vector<std::filesystem::path>>();
  command
      ->add_option(
          "DIR", *folders,
          "Results folder of a run with record.trace; those of several "
          "hosts together")
      ->required()
      ->type_name(" ");
  command->footer(
      "Exit codes: 0 all rules are kept, 1 one is broken, 2 wrong input.\n"
      "Example:\n  sofof run config/ulm_lehr.toml --set record.trace=true\n"
      "  sofof check-trace results/ulm_lehr-1");
  command->callback([folders, &exit_code] { exit_code = check(*folders); });
}

} // namespace sofof::apps
