// sofof load-test: finds how many vehicles a provider carries.
#include "experiments/load_test/load_test.hpp"

#include "apps/address_argument.hpp"
#include "apps/command.hpp"
#include "apps/host_arguments.hpp"
#include "apps/scenario_arguments.hpp"
#include "apps/signals.hpp"
#include "base/input_error.hpp"
#include "base/options/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <memory>

namespace sofof::apps {

namespace {

struct load_arguments {
  scenario_arguments what;
  experiments::load_test::load_options options;
  std::string provider, measured, within, out;
};

duration to_duration(const std::string& text, std::string_view option) {
  const auto d = parse_duration(text);
  if (!d || *d <= duration{0})
    throw input_error(fmt::format(
        "{} takes a time above 0 with its unit, like 20ms or 10s", option));
  return *d;
}

/// [NAME=]HOST:PORT
void set_provider(experiments::load_test::load_options& to,
                  const std::string& text) {
  const auto equals = text.find('=');
  const auto is_named = equals != std::string::npos;
  to.provider = is_named ? text.substr(0, equals) : "";
  to.at = address_of(is_named ? text.substr(equals + 1) : text);
}

} // namespace

void add_load_test(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand(
      "load-test", "Find how many vehicles a provider carries");
  auto args = std::make_shared<load_arguments>();
  args->what.add_to(*command, false);
  command
      ->add_option("--provider", args->provider,
                   "Where it listens; NAME is the scenario's, needed if it has "
                   "several")
      ->type_name("[NAME=]HOST:PORT")
      ->required();
  command
      ->add_option("--vehicles", args->options.vehicles,
                   "How many are tried, e.g. 50,100 (default: from 10 on, "
                   "until it is too many)")
      ->type_name("N,N,...")
      ->delimiter(',')
      ->check(CLI::PositiveNumber);
  args->options.most = 1000;
  command
      ->add_option("--most", args->options.most,
                   "More are not tried (default 1000)")
      ->type_name("N")
      ->check(CLI::PositiveNumber);
  command
      ->add_option("--measure", args->measured,
                   "How long each number is measured (default 10s)")
      ->type_name("TIME");
  command
      ->add_option("--within", args->within,
                   "Waiting and computing that 99 of 100 results may take "
                   "(default 20ms)")
      ->type_name("TIME");
  command
      ->add_option("--keys", args->options.keys,
                   "Folder of the own certificate, see `sofof keys`")
      ->type_name("DIR");
  command
      ->add_option("--out", args->out,
                   "Keep the results of each number in this folder")
      ->type_name("DIR");
  command->footer(
      "The vehicles are those of the scenario's first fleet; on board they "
      "follow their lane.\nExample:\n  sofof provide config/load.toml &\n"
      "  sofof load-test config/load.toml --provider 127.0.0.1:4711");
  command->callback([args, &exit_code] {
    auto& options = args->options;
    options.scenario = find_scenario(args->what.file);
    options.changes = args->what.changes();
    set_provider(options, args->provider);
    if (!args->measured.empty())
      options.measured = to_duration(args->measured, "--measure");
    if (!args->within.empty())
      options.within = to_duration(args->within, "--within");
    std::ranges::sort(options.vehicles);
    options.out = args->out;
    options.version = SOFOF_VERSION;
    catch_signals();
    constexpr int stopped = 130; // as a shell counts Ctrl-C
    if (!experiments::load_test::test_load(options, interrupted, std::cout))
      exit_code = stopped;
  });
}

} // namespace sofof::apps
