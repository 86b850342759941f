// The command-line arguments of processes that may use an AMQP broker.
#pragma once

#include "base/input_error.hpp"
#include "scenario/broker_connection.hpp"
#include "scenario/scenario.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <optional>
#include <string>

namespace sofof::apps {

struct broker_arguments {
  std::string url;
  std::string publisher;
  bool trusts = false;

  void add_to(CLI::App& command) {
    auto* broker =
        command
            .add_option("--broker", url,
                        "Cross an AMQP 1.0 broker, as `sofof broker` is one, "
                        "instead of connecting directly; amqps:// by TLS")
            ->type_name("URL");
    command
        .add_flag("--trust-broker", trusts,
                  "The broker need not prove who sends a message; see "
                  "docs/security.md for what that gives up")
        ->needs(broker);
    command
        .add_option("--c-roads", publisher,
                    "Add the properties of C-ROADS to ITS messages, as this "
                    "publisher's, e.g. DE12345")
        ->type_name("PUBLISHER")
        ->needs(broker);
  }

  /// @returns the broker to use; nothing: none.
  /// @throws input_error when the scenario wants one, and when the URL is none.
  std::optional<scenario::broker_options>
  given(const scenario::scenario_definition& s) const {
    if (url.empty() && s.network.transport == "amqp")
      throw input_error("network.transport is \"amqp\": name the broker with "
                        "--broker, like amqp://127.0.0.1");
    if (url.empty())
      return std::nullopt;
    const auto where = scenario::parse_broker(url);
    if (!where)
      throw input_error(fmt::format("--broker '{}' is no URL of a broker, like "
                                    "amqp://127.0.0.1 or "
                                    "amqps://edge.example:5671/etsi",
                                    url));
    return scenario::broker_options{*where, trusts, publisher};
  }
};

} // namespace sofof::apps
