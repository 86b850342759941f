// A provider's entry in a registry, and vehicles that look for providers there.
#pragma once

#include "actors/remote/provider_connection.hpp"
#include "network/mec/directory.hpp"
#include "network/mec/registration.hpp"
#include "network/mec/repeating_thread.hpp"
#include "scenario/hosts.hpp"
#include "scenario/runtime.hpp"
#include "scenario/scenario.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace sofof::scenario {

/// Gets what becomes of a registry, on a thread of its own.
using registry_listener =
    std::function<void(const network::mec011::registry_news&)>;

/// @param log  For people.
/// @param time  Outlives the listener.
/// @returns what writes down and shows what becomes of a registry.
registry_listener recording_listener(std::function<void(std::string)> log,
                                     const runtime& time,
                                     messages::recorder_actor recorder);

// -- a provider --------------------------------------------------------------

/// @returns how a registry is told of a provider that listens there, but for
/// the port, which may not be known yet.
/// @throws input_error.
register_options complete_registration(register_options registry,
                                       const network::network_address& listen,
                                       const std::string& name);

/// Lists a provider in a registry while it is needed, on a thread of its own
/// for which nobody waits until the end.
class announcement {
public:
  /// @param registry    Complete.
  /// @param listens     The port counts where the registry has none.
  /// @param is_secured  Whether vehicles connect by TLS.
  announcement(const register_options& registry,
               const network::network_address& listens, std::uint32_t protocol,
               const std::string& name, bool is_secured,
               registry_listener publish);

  /// The provider will take nobody from now on; does not wait.
  void end() { thread_.end(); }

private:
  network::mec011::registration entry_;
  network::mec011::repeating_thread thread_; // ends before what it keeps
};

// -- vehicles ----------------------------------------------------------------

/// @returns the providers that vehicles connect to: those that are named, and
/// if a registry is asked, all of the scenario.
std::vector<drive_options::provider>
wanted_providers(const scenario_definition& s, const drive_options& what);

/// Asks a registry where providers are, on a thread of its own.
class discovery {
public:
  /// @param what  Names a registry.
  discovery(const scenario_definition& s, const drive_options& what);

  /// Begins, the first time that it is called: before anybody else asks.
  void begin(registry_listener publish);
  /// Ends; what is known stays.
  void end();

  /// For those who have no connection: the registry may be asked anew, soon.
  /// @returns what to try next. Any thread may call this.
  std::optional<network::network_address> next(const std::string& provider);

  /// @returns where a provider has been tried last, for people.
  std::string place_of(const std::string& provider) const {
    return directory_.place_of(provider);
  }

private:
  registry_listener publish_;
  network::mec011::directory directory_;
  std::optional<network::mec011::repeating_thread> thread_;
};

/// Lets a connection ask where its provider is before each attempt. It believes
/// the provider alone: an address that refuses us ends nothing.
/// @param where    Outlives the connection.
/// @param lead_to  Makes `setup.connect` lead to an address.
void look_up(actors::provider_connection_setup& setup, discovery& where,
             std::function<void(const network::network_address&)> lead_to);

} // namespace sofof::scenario
