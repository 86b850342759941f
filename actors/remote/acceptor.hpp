// Where processes of vehicles come in.
#pragma once

#include "actors/remote/heartbeat.hpp"
#include "messages/etsi/its_time.hpp"
#include "messages/type_ids.hpp"

#include <caf/actor_system.hpp>
#include <caf/node_id.hpp>

#include <functional>
#include <optional>
#include <set>
#include <string>

namespace sofof::actors {

/// Who a peer is, or why it must not speak for its stations.
struct peer_finding {
  std::string name; ///< Of whoever holds its certificate, say.
  std::optional<std::string> refusal;
};

/// What an acceptor is made of. The functions are called from its threads.
struct acceptor_setup {
  messages::provider_actor provider;
  provider_id id = 0;
  std::string name;        ///< Of the provider.
  std::uint64_t world = 0; ///< Fingerprint that peers must have as well.
  messages::etsi::its_clock clock;
  messages::recorder_actor recorder;
  heartbeat_pace pace{};
  /// @returns a number that nobody can guess, new every time. What it throws
  /// refuses the one who needs it.
  std::function<std::string()> draw_nonce;
  /// Asks whether a hello, signed over this number, may come from this process.
  std::function<peer_finding(const messages::peer_hello&,
                             const std::string& nonce,
                             const caf::node_id& process)>
      examine;
  /// Told who has come in, and who has gone; of many a second, not of all.
  std::function<void(const std::set<station_id>&, bool is_here)> on_peer =
      [](const auto&, bool) {};
};

/// Gives each process that speaks the same version a number to sign and a
/// handshake, at which it introduces itself. A process has a limit of
/// handshakes, so that it does not keep others out. All that a process
/// publishes.
messages::acceptor_actor spawn_acceptor(caf::actor_system& sys,
                                        acceptor_setup setup);

} // namespace sofof::actors
