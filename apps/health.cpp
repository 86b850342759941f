// sofof health: asks a process whether it is ready.
#include "apps/command.hpp"
#include "base/input_error.hpp"
#include "base/options/units.hpp"
#include "base/text/printable.hpp"
#include "network/http/client.hpp"
#include "network/network_error.hpp"

#include <fmt/format.h>

#include <chrono>
#include <iostream>
#include <memory>
#include <string>

namespace sofof::apps {

namespace {

struct health_arguments {
  std::string url;
  std::string patience = "2s";
};

int ask(const health_arguments& args) {
  auto what = network::http::parse_url(args.url);
  if (!what)
    throw input_error{fmt::format("'{}' is no URL that begins with http://, "
                                  "like http://127.0.0.1:9464",
                                  printable(args.url))};
  const auto patience = parse_duration(args.patience);
  if (!patience || *patience <= duration{0})
    throw input_error{fmt::format("'{}' is no time to wait, like 2s or 500ms",
                                  printable(args.patience))};
  if (what->target == "/")
    what->target = "/healthz";
  try {
    const auto answer = network::http::get(
        *what, std::chrono::ceil<std::chrono::milliseconds>(*patience));
    constexpr unsigned good = 200;
    auto word = answer.body.substr(0, answer.body.find('\n'));
    if (answer.status != good)
      word += fmt::format(" (HTTP status {})", answer.status);
    else if (word != "ready")
      word += " (no answer of sofof)";
    std::cout << printable(std::move(word)) << '\n';
    return answer.status == good && answer.body == "ready\n" ? 0 : 1;
  } catch (const network::network_error& problem) {
    std::cout << problem.what() << '\n';
    return 1;
  }
}

} // namespace

void add_health(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand(
      "health", "Ask a process with --metrics whether it is ready");
  auto args = std::make_shared<health_arguments>();
  command
      ->add_option("URL", args->url,
                   "What --metrics printed, e.g. http://127.0.0.1:9464")
      ->required();
  command
      ->add_option("--timeout", args->patience,
                   "How long to wait for the answer (default 2s)")
      ->type_name("TIME");
  command->footer(
      "Prints what it answers, and exits with 0 if that is \"ready\", else 1.");
  command->callback([args, &exit_code] { exit_code = ask(*args); });
}

} // namespace sofof::apps
