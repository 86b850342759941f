// A connection to a provider on another host, made again whenever it is lost.
#pragma once

#include "actors/remote/heartbeat.hpp"
#include "actors/remote/provider_proxy.hpp"
#include "base/random.hpp"
#include "messages/etsi/its_time.hpp"
#include "messages/type_ids.hpp"

#include <caf/actor_system.hpp>

#include <functional>
#include <string>
#include <variant>
#include <vector>

namespace sofof::actors {

/// What a connection is made of. Its functions are called from any thread.
struct provider_connection_setup {
  std::string provider; ///< The name that it must have.
  /// Where it is now, for people.
  std::function<std::string()> address = [] { return std::string{}; };
  std::vector<station_id> stations;
  std::uint64_t world = 0; ///< Fingerprint that the provider must have as well.
  messages::etsi::its_clock clock;
  messages::recorder_actor recorder;
  random_stream noise{0, ""}; ///< For the pauses between attempts.
  duration rest{};            ///< Before the first vehicle sends anything.
  /// Connects, which may take a while.
  /// @returns the acceptor, or why there is none.
  std::function<std::variant<messages::acceptor_actor, std::string>()> connect;
  /// Closes what may be left of a connection that is given up.
  std::function<void()> hang_up = [] {};
  /// Carries an attempt out, which calls `connect`; empty: on a thread of its
  /// own.
  std::function<void(std::function<void()> attempt)> aside;
  std::uint32_t protocol = messages::remote_protocol;
  heartbeat_pace pace{};
  /// Adds the proof that we may speak for our stations, where one is needed.
  std::function<void(messages::peer_hello&, const std::string& nonce)> prove;
  /// Called whenever the provider has let us in.
  std::function<void()> on_connected = [] {};
  /// Called with a sentence when we will never be let in: before the first
  /// connection, within 5 s of the start, by a provider that refuses us.
  std::function<void(const std::string&)> on_refusal;
  /// The same for what may pass: once for every change.
  std::function<void(const std::string&)> on_news;
};

/// Connects, introduces itself, and connects again whenever the connection is
/// lost: with pauses that grow to a second from the beginning of one attempt to
/// that of the next, which waits for the end of the one before, but not for one
/// that hangs. Meanwhile it loses what it is given, and ends what ran for its
/// vehicles (peer_lost), so that they plan for themselves at once. What
/// vehicles send all the time goes out as outgoing_traffic says; what the
/// provider sends has its times on our clock (clock_translation.hpp).
provider_outbox spawn_provider_connection(caf::actor_system& sys,
                                          provider_connection_setup setup);

/// Tells a connection which proxy stands for the provider at a station.
void introduce(const provider_outbox& outbox, station_id station,
               const messages::link_actor& provider_proxy);

} // namespace sofof::actors
