// The end of a connection to vehicles that they can reach, in the process of
// their provider.
#pragma once

#include "actors/remote/heartbeat.hpp"
#include "messages/etsi/its_time.hpp"
#include "messages/type_ids.hpp"

#include <caf/actor_system.hpp>

#include <set>
#include <string>

namespace sofof::actors {

/// What a connection is made of.
struct vehicle_connection_setup {
  messages::provider_actor provider;
  messages::vehicle_endpoint_actor peer;
  std::set<station_id> stations;        ///< For which the peer may speak.
  messages::etsi::its_clock clock;      ///< Ours.
  messages::etsi::its_clock peer_clock; ///< As the peer has told it.
  messages::recorder_actor recorder;
  std::optional<sender_id> sender{}; ///< Of its certificate, if any.
  heartbeat_pace pace{};
};

/// Stands for all vehicles of one peer: gives each a requester of its own that
/// the provider can send to, translates the peer's times to ours, and sends
/// results one at a time, always the latest. What another peer sends, and what
/// peer_rules object to, is dropped and logged.
/// Ends when the peer does, when it is sent an exit, or when the peer has
/// answered no ping for the limit of silence; the provider then sees
/// all its stations lost.
messages::provider_endpoint_actor
spawn_provider_endpoint(caf::actor_system& sys, vehicle_connection_setup setup);

} // namespace sofof::actors
