// sofof provide: runs a provider for vehicles of other processes.
#include "apps/address_argument.hpp"
#include "apps/broker_arguments.hpp"
#include "apps/command.hpp"
#include "apps/host_arguments.hpp"
#include "apps/log_argument.hpp"
#include "apps/run_arguments.hpp"
#include "apps/signals.hpp"
#include "network/mec/registry.hpp"
#include "scenario/broker_hosts.hpp"
#include "scenario/hosts.hpp"

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <ostream>
#include <string>
#include <sys/resource.h>

namespace sofof::apps {

namespace {

/// Every connection takes two files, and vehicles are many.
void allow_many_files() {
  rlimit files{};
  if (getrlimit(RLIMIT_NOFILE, &files) != 0)
    return;
  files.rlim_cur = files.rlim_max;
  setrlimit(RLIMIT_NOFILE, &files);
}

/// HOST[:PORT]
network::network_address advertised_address(const std::string& text) {
  if (text.empty())
    return {};
  if (const auto whole = network::parse_address(text))
    return *whole;
  if (const auto host = network::parse_address(text + ":0"))
    return *host;
  throw input_error(fmt::format("'{}' is no HOST or HOST:PORT to advertise, "
                                "like 10.0.0.5 or [fd00::5]:4711",
                                text));
}

/// How a registry of services learns of the provider.
struct registration_arguments {
  std::string url, application, advertised;

  void add_to(CLI::App& command) {
    auto* registry =
        command
            .add_option(
                "--register", url,
                "Registry of services (ETSI GS MEC 011) that shall list "
                "the provider")
            ->type_name("URL");
    command
        .add_option("--app-instance", application,
                    "What the registry's platform calls this application "
                    "(default sofof-NAME)")
        ->type_name("ID")
        ->needs(registry);
    command
        .add_option("--advertise", advertised,
                    "Where vehicles reach the provider, for the registry "
                    "(default as --listen)")
        ->type_name("HOST[:PORT]")
        ->needs(registry);
  }

  /// @returns what was asked for; nothing: no registry.
  /// @throws input_error.
  std::optional<scenario::register_options> given() const {
    if (url.empty())
      return std::nullopt;
    return scenario::register_options{network::mec011::parse_root(url),
                                      application,
                                      advertised_address(advertised)};
  }
};

} // namespace

void add_provide(CLI::App& app, int& exit_code) {
  struct arguments {
    run_arguments run;
    host_arguments host;
    broker_arguments broker;
    log_argument log;
    scenario::provide_options what;
    std::string listen = "127.0.0.1:4711";
    registration_arguments registration;
  };
  auto* command =
      app.add_subcommand("provide", "Run a provider, on an edge server");
  auto args = std::make_shared<arguments>();
  args->run.add_to(*command);
  command
      ->add_option("--listen", args->listen,
                   "Where vehicles connect to (default 127.0.0.1:4711)")
      ->type_name("HOST:PORT");
  command
      ->add_option("--name", args->what.name,
                   "Which provider of the scenario, if it has several")
      ->type_name("NAME");
  args->broker.add_to(*command);
  command->get_option("--broker")->excludes(command->get_option("--listen"));
  args->registration.add_to(*command);
  args->host.add_to(*command);
  args->log.add_to(*command);
  command->footer(
      "It runs until it is stopped, or for --duration.\nExample:\n  sofof "
      "provide config/ulm_lehr.toml --listen 0.0.0.0:4711 --keys "
      "keys/provider-mec");
  command->callback([args, &exit_code] {
    const auto s = args->run.what.load();
    args->what.listen = address_of(args->listen);
    const auto broker = args->broker.given(s);
    args->what.registry = args->registration.given();
    if (broker && args->what.registry)
      throw input_error("--register lists an address, and a provider that is "
                        "reached over a --broker has none");
    auto options = args->run.given();
    options.endless = args->run.what.length.empty();
    args->host.give(args->what);
    catch_signals();
    allow_many_files();
    exit_code = static_cast<int>(args->log.with_console(
        options, "provide", [&](const auto& how, std::ostream& console) {
          return broker ? scenario::provide_by_broker(s, args->what, *broker,
                                                      how, interrupted, console)
                        : scenario::provide(s, args->what, how, interrupted,
                                            console);
        }));
  });
}

} // namespace sofof::apps
