// What processes on different hosts agree on before services cross between
// them, and what keeps their connection alive.
#pragma once

#include "messages/protocol/its_pdu.hpp"
#include "messages/protocol/service.hpp"

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::messages {

/// Whose messages these are. Raised whenever their meaning changes; the types
/// themselves are compared by a fingerprint of all their names.
inline constexpr std::uint32_t remote_protocol = 11;

/// @returns whether a stranger's Unix time can be reckoned with.
constexpr bool is_time_of_day(std::int64_t unix_ms) {
  constexpr auto most =
      std::chrono::floor<std::chrono::milliseconds>(longest_time).count();
  return unix_ms >= 0 && unix_ms / 2 <= most;
}

/// Whom a process of vehicles speaks for and to, and how it can prove that.
struct peer_hello {
  std::string provider; ///< The name of the one it means.
  std::vector<station_id> stations;
  std::uint64_t world = 0; ///< A fingerprint of its map and its services.
  std::int64_t epoch_unix_ms = 0; ///< Time of day when its clock stood at 0.
  std::string certificate; ///< PEM; empty where connections are not secured.
  std::vector<std::byte> signature; ///< Of what `proof_of` says.
};

void visit_fields(auto& v, peer_hello& x) {
  v("provider", x.provider);
  v("stations", x.stations);
  v("world", x.world);
  v("epoch_unix_ms", x.epoch_unix_ms);
  v("certificate", x.certificate);
  v("signature", x.signature);
}

/// A provider answers a hello: its id, which is new at each start of its
/// process.
struct peer_welcome {
  provider_id provider = 0;
  std::int64_t epoch_unix_ms = 0;
};

void visit_fields(auto& v, peer_welcome& x) {
  v("provider", x.provider);
  v("epoch_unix_ms", x.epoch_unix_ms);
}

/// "Are you there?" Sent at a fixed rate by both sides.
struct ping {
  std::uint64_t number = 0;
  time_point sent; ///< On the sender's clock.
};

void visit_fields(auto& v, ping& x) {
  v("number", x.number);
  v("sent", x.sent);
}

/// The answer, at once.
struct pong {
  ping of;
  time_point received; ///< On the answerer's clock, as is
  time_point answered;
};

void visit_fields(auto& v, pong& x) {
  v("of", x.of);
  v("received", x.received);
  v("answered", x.answered);
}

/// Messages of which only the latest counts, and of which one at a time is
/// under way.
struct stream_id {
  enum class what : std::uint8_t { cam, cpm, input, result };

  station_id station = 0;
  what of = what::cam;
  std::uint32_t counter = 0; ///< Of the session; 0 if it is none.

  friend auto operator<=>(const stream_id&, const stream_id&) = default;
};

void visit_fields(auto& v, stream_id& x) {
  v("station", x.station);
  v("of", x.of);
  v("counter", x.counter);
}

constexpr stream_id::what last_of(stream_id::what) {
  return stream_id::what::result;
}

/// @returns the stream of what a station tells everybody: CAMs, or CPMs.
inline stream_id stream_of(station_id station, const its_pdu& message) {
  constexpr std::size_t id = 1; // the octet of the message's id
  constexpr std::byte cam_id{2};
  const auto is_cam =
      message.octets.size() > id && message.octets[id] == cam_id;
  return {station, is_cam ? stream_id::what::cam : stream_id::what::cpm, 0};
}

/// @returns the stream of a session's inputs, or of its results.
inline stream_id stream_of(const session_id& running, stream_id::what which) {
  return {running.station, which, running.counter};
}

/// @returns what a peer signs: that somebody who was given this number just
/// now speaks for these stations, to this provider and nobody else.
inline std::vector<std::byte>
proof_of(const std::string& nonce, const std::string& provider,
         const std::vector<station_id>& stations) {
  constexpr std::string_view purpose = "SOFOF speaks for stations";
  byte_writer text;
  text(std::string{purpose}, nonce, provider, stations);
  return text.take();
}

} // namespace sofof::messages
