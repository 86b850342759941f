// A scenario on several hosts: providers here, vehicles there.
#pragma once

#include "actors/runtime/clock_error.hpp"
#include "messages/protocol/remote.hpp"
#include "network/http/client.hpp"
#include "network/network_address.hpp"
#include "scenario/run.hpp"

#include <atomic>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace sofof::scenario {

/// What both sides have in common.
struct host_options {
  /// Whether the other side may have another map: then only the frames of both
  /// have to be the same, and both sides have to say so.
  bool own_map = false;
  std::string keys; ///< Folder with certificate and key; empty on loopback.
  /// Once true, the folder is read again, and this is false again; null: never.
  std::atomic<bool>* keys_have_changed = nullptr;
  actors::clock_error clock; ///< For tests: how far the own clock is off, ...
  std::uint32_t protocol =
      messages::remote_protocol; ///< ... and what it speaks.
};

/// A registry of services that lists a provider.
struct register_options {
  network::http::url root;
  std::string application; ///< What its platform calls us; empty: sofof-NAME.
  /// Where vehicles reach us; without a port: where we listen. Not a name:
  /// where we listen, unless that is anywhere.
  network::network_address advertised;
};

struct provide_options : host_options {
  std::string name; ///< Of the provider; empty: the only one.
  network::network_address listen;
  std::optional<register_options> registry;
};

struct drive_options : host_options {
  struct provider {
    std::string name; ///< Empty: the only one.
    /// Without it: a registry knows.
    std::optional<network::network_address> at;
  };
  std::vector<provider> providers; ///< Those whose address is known.
  /// A registry of services that knows where others of the scenario are.
  std::optional<network::http::url> registry;
  std::set<station_id> stations; ///< Empty: all.
};

/// Runs one provider, for vehicles of other processes.
/// @throws input_error.
run_outcome provide(const scenario_definition& s, const provide_options& what,
                    run_options options, const std::atomic<bool>& interrupted,
                    std::ostream& console);

/// Runs vehicles, which providers of other processes plan for.
/// @throws input_error, also when a provider refuses us at the beginning.
run_outcome drive(const scenario_definition& s, const drive_options& what,
                  run_options options, const std::atomic<bool>& interrupted,
                  std::ostream& console);

} // namespace sofof::scenario
