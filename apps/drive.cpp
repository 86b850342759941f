// sofof drive: runs vehicles, which providers of other processes plan for.
#include "apps/address_argument.hpp"
#include "apps/broker_arguments.hpp"
#include "apps/command.hpp"
#include "apps/host_arguments.hpp"
#include "apps/log_argument.hpp"
#include "apps/run_arguments.hpp"
#include "apps/signals.hpp"
#include "base/input_error.hpp"
#include "network/keys/station_list.hpp"
#include "network/mec/registry.hpp"
#include "scenario/broker_hosts.hpp"
#include "scenario/hosts.hpp"

#include <fmt/format.h>

#include <memory>
#include <ostream>

namespace sofof::apps {

namespace {

/// [NAME=]HOST:PORT
scenario::drive_options::provider to_provider(std::string_view text) {
  const auto equals = text.find('=');
  if (equals == std::string_view::npos)
    return {"", address_of(text)};
  return {std::string{text.substr(0, equals)},
          address_of(text.substr(equals + 1))};
}

std::set<station_id> to_stations(const std::string& text) {
  if (text.empty())
    return {};
  const auto all = network::parse_stations(text);
  if (!all)
    throw input_error(fmt::format(
        "'{}' is no list of stations, like 101-106 or 101,104", text));
  return {all->begin(), all->end()};
}

} // namespace

void add_drive(CLI::App& app, int& exit_code) {
  struct arguments {
    run_arguments run;
    host_arguments host;
    broker_arguments broker;
    log_argument log;
    scenario::drive_options what;
    std::vector<std::string> providers;
    std::string registry;
    std::string stations;
  };
  auto* command = app.add_subcommand("drive", "Run vehicles, in a car");
  auto args = std::make_shared<arguments>();
  args->run.add_to(*command);
  command
      ->add_option("--provider", args->providers,
                   "Where a provider listens; NAME is the scenario's, needed "
                   "if it has several; may be given several times")
      ->type_name("[NAME=]HOST:PORT")
      ->take_all()
      ->expected(1);
  command
      ->add_option("--discover", args->registry,
                   "Registry of services (ETSI GS MEC 011) that knows where "
                   "the scenario's providers are, instead of --provider")
      ->type_name("URL");
  command
      ->add_option("--station", args->stations,
                   "Which vehicles, e.g. 101-106 (default all)")
      ->type_name("LIST");
  args->broker.add_to(*command);
  args->host.add_to(*command);
  args->log.add_to(*command);
  command->footer(
      "Example:\n  sofof drive config/ulm_lehr.toml --provider 10.0.0.5:4711 "
      "--station 101-103 --keys keys/station-101-103");
  command->callback([args, &exit_code] {
    const auto s = args->run.what.load();
    for (const auto& text : args->providers)
      args->what.providers.push_back(to_provider(text));
    const auto broker = args->broker.given(s);
    if (!args->registry.empty())
      args->what.registry = network::mec011::parse_root(args->registry);
    if (broker && (args->what.registry || !args->providers.empty()))
      throw input_error("--broker leads to all providers; leave --provider and "
                        "--discover away");
    if (args->providers.empty() && !args->what.registry && !broker)
      throw input_error("nobody is named who plans for the vehicles; say where "
                        "the provider listens with --provider, which registry "
                        "knows it with --discover, or over which broker it is "
                        "reached with --broker");
    args->what.stations = to_stations(args->stations);
    args->host.give(args->what);
    catch_signals();
    exit_code = static_cast<int>(args->log.with_console(
        args->run.given(), "drive",
        [&](const auto& how, std::ostream& console) {
          return broker ? scenario::drive_by_broker(s, args->what, *broker, how,
                                                    interrupted, console)
                        : scenario::drive(s, args->what, how, interrupted,
                                          console);
        }));
  });
}

} // namespace sofof::apps
