// sofof broker: passes messages on between vehicles and providers.
#include "apps/address_argument.hpp"
#include "apps/command.hpp"
#include "apps/signals.hpp"
#include "scenario/broker_service.hpp"

#include <iostream>
#include <memory>
#include <string>

namespace sofof::apps {

void add_broker(CLI::App& app, int& exit_code) {
  struct arguments {
    std::string listen = "127.0.0.1:5672";
    std::string metrics;
    scenario::broker_service_options what;
  };
  auto* command = app.add_subcommand(
      "broker", "Run a small AMQP 1.0 broker, for tests or one intersection");
  auto args = std::make_shared<arguments>();
  command
      ->add_option("--listen", args->listen,
                   "Where vehicles and providers connect to (default "
                   "127.0.0.1:5672)")
      ->type_name("HOST:PORT");
  command
      ->add_option("--keys", args->what.keys,
                   "Folder of the own certificate, for the provider `broker`; "
                   "see `sofof keys`")
      ->type_name("DIR");
  command
      ->add_option("--metrics", args->metrics,
                   "Serve figures for Prometheus, and /healthz")
      ->type_name("ADDR:PORT")
      ->check(&trouble_with_address);
  command->footer("It runs until it is stopped.\nExample:\n  sofof broker "
                  "--listen 0.0.0.0:5671 --keys keys/provider-broker");
  command->callback([args, &exit_code] {
    args->what.listen = address_of(args->listen);
    if (!args->metrics.empty())
      args->what.metrics = address_of(args->metrics);
    catch_signals();
    if (!args->what.keys.empty()) {
      args->what.keys_have_changed = &keys_have_changed;
      catch_hang_up();
    }
    scenario::run_broker(args->what, interrupted, std::cout);
    exit_code = 0;
  });
}

} // namespace sofof::apps
