// The provider's end of a connection to vehicles on another host.
#pragma once

#include "messages/etsi/its_time.hpp"
#include "messages/type_ids.hpp"

#include <caf/actor_system.hpp>

#include <set>
#include <string>

namespace sofof {

/// What a session is made of.
struct session_setup {
  provider_actor provider;
  uplink_actor peer;
  std::set<station_id> stations; ///< For which the peer may speak.
  etsi::its_clock clock;         ///< Ours.
  etsi::its_clock peer_clock;    ///< As the peer has told it.
  recorder_actor recorder;
  sender_id sender = 0; ///< Of its certificate; 0: none.
};

/// Stands for all vehicles of one peer: gives each a requester of its own that
/// the provider can talk to, translates the peer's times to ours, and hands
/// results over one at a time, always the latest. Whatever does not come from
/// the peer, or speaks for somebody else, or too often, is dropped and noted.
/// Ends when the peer does, when it is sent an exit, or when the peer has
/// answered no life sign for protocol::silence_limit; the provider then sees
/// all its stations lost.
session_actor spawn_session(caf::actor_system& sys, session_setup setup);

} // namespace sofof
