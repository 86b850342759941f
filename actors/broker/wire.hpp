// What crosses a broker between providers and vehicles, as AMQP messages.
#pragma once

#include "messages/protocol/remote.hpp"
#include "messages/protocol/service.hpp"
#include "network/amqp/message.hpp"

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace sofof::actors::wire {

/// A process of vehicles asks a provider for a number to sign: the question
/// that acceptors take.
struct connect_request {
  std::string provider; ///< The name of the one it means.
  std::uint32_t protocol = 0;
  std::uint64_t types = 0;
};

void visit_fields(auto& v, connect_request& x) {
  v("provider", x.provider);
  v("protocol", x.protocol);
  v("types", x.types);
}

/// The answer of an acceptor; without a number it lets nobody in.
struct challenge {
  std::uint32_t protocol = 0;
  std::uint64_t types = 0;
  std::string nonce;
};

void visit_fields(auto& v, challenge& x) {
  v("protocol", x.protocol);
  v("types", x.types);
  v("nonce", x.nonce);
}

/// A provider does not let a process in.
struct refusal {
  std::string why;
  bool for_ever = false; ///< Whether it never will.
};

void visit_fields(auto& v, refusal& x) {
  v("why", x.why);
  v("for_ever", x.for_ever);
}

/// One side has ended.
struct closing {};

void visit_fields(auto&, closing&) {}

/// A CAM, CPM or MCM that a station tells everybody.
struct broadcast {
  messages::its_pdu message;
};

/// An offer, with the station that it is for.
struct offer {
  messages::service_offer what;
};

void visit_fields(auto& v, offer& x) {
  v("what", x.what);
}

using content =
    std::variant<broadcast, connect_request, challenge, messages::peer_hello,
                 messages::peer_welcome, refusal, closing, messages::ping,
                 messages::pong, messages::service_request,
                 messages::service_input, messages::service_end, offer,
                 messages::service_response, messages::session_digest,
                 messages::service_result>;

/// A message and who speaks to whom.
struct envelope {
  std::string user;    ///< Who it says has sent it.
  station_id from = 0; ///< Whose message it is; of a provider or a vehicle.
  std::optional<station_id> to{}; ///< Nothing: for everybody.
  /// Of a process of vehicles and a provider; 0: of none.
  std::int64_t link = 0;
  content what{};
};

/// Writes an envelope for a broker. An ITS message, also one that an input or a
/// result holds, is the body of a message as uulm-mrm/v2x_etsi_asn1 has them
/// (subject, mid, station_id, destination_station_id, ttl, creation time).
/// What SOFOF needs beside it is in properties of its own, and messages without
/// an ITS message have the subject "sofof" and no mid, so that others ignore
/// them.
/// @param now  Time of day, since 1970.
network::amqp::message to_amqp(const envelope& x,
                               std::chrono::milliseconds now);

/// Reads one, from anybody: also an ITS message with the properties of C-ROADS
/// (c_roads.hpp) alone.
/// @returns nothing for what is no message of these, or not whole.
std::optional<envelope> from_amqp(const network::amqp::message& m);

/// @returns the selector of what a process of these stations should get: what
/// is for them, and MCMs for everybody.
std::string selector_of_vehicles(const std::vector<station_id>& stations);

/// @returns the selector of what a provider should get: what is for it or for
/// everybody, but for its own.
std::string selector_of_provider(station_id own);

} // namespace sofof::actors::wire
