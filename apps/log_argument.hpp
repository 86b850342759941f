// How a process that runs for long tells what happens.
#pragma once

#include "apps/json_log.hpp"
#include "scenario/run.hpp"

#include <CLI/CLI.hpp>

#include <iostream>
#include <string>
#include <string_view>
#include <utility>

namespace sofof::apps {

struct log_argument {
  bool is_json = false;

  void add_to(CLI::App& command) {
    command
        .add_option_function<std::string>(
            "--log",
            [this](const std::string& how) { is_json = how == "json"; },
            "Lines for people, the default, or JSON objects for a collector")
        ->type_name("text|json")
        ->check(CLI::IsMember({"text", "json"}));
  }

  /// Calls `run(options, console)`, and that console writes as was asked for.
  template <class Run>
  auto with_console(scenario::run_options options, std::string_view role,
                    const Run& run) const {
    if (!is_json)
      return run(std::move(options), std::cout);
    json_log lines{std::cout, role};
    std::ostream console{&lines};
    options.show = recording::progress::output::quiet;
    return run(std::move(options), console);
  }
};

} // namespace sofof::apps
