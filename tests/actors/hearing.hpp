// Both ends of a connection, each of which hears octets: what the frame check
// admits of them reaches its actor, as if it had come by the connection.
#pragma once

#include "actors/remote/public_messages.hpp"
#include "tests/actors/provider_connection_world.hpp"
#include "tests/actors/vehicle_connection_world.hpp"

#include <caf/binary_deserializer.hpp>
#include <caf/binary_serializer.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace sofof::test {

using octets = std::vector<std::byte>;

/// A message's payload in BASP: no stages, then its elements.
template <class... Ts>
octets payload_of(const Ts&... xs) {
  caf::byte_buffer buffer;
  caf::binary_serializer sink{nullptr, buffer};
  REQUIRE(sink.apply(std::vector<std::uint16_t>{}));
  REQUIRE(sink.apply(caf::make_message(xs...)));
  const auto* begin = reinterpret_cast<const std::byte*>(buffer.data());
  return {begin, begin + buffer.size()};
}

/// What comes by a connection after its handshake.
class opened_connection {
public:
  opened_connection(bool is_accepted, const actors::message_forms& forms)
      : check_{is_accepted, forms} {
    const octets node(is_accepted ? 25 : 60, std::byte{1});
    const auto handshake = header_of(is_accepted, node, 0);
    REQUIRE(check_.objection(handshake).empty());
    REQUIRE(check_.objection(handshake, node).empty());
  }

  /// @returns the message that a payload is, if it is admitted and can be read.
  std::optional<caf::message> read(caf::actor_system& sys,
                                   std::span<const std::byte> payload) {
    constexpr std::uint64_t told_id = 0x1000'0000'0000'0000;
    constexpr std::uint8_t direct_message = 2;
    const auto header = header_of(direct_message, payload, told_id);
    if (!check_.objection(header).empty()
        || !check_.objection(header, payload).empty())
      return std::nullopt;
    caf::binary_deserializer source{
        sys, caf::make_span(reinterpret_cast<const caf::byte*>(payload.data()),
                            payload.size())};
    std::vector<caf::strong_actor_ptr> stages;
    caf::message message;
    if (!source.apply(stages) || !source.apply(message))
      return std::nullopt;
    REQUIRE(stages.empty());
    return message;
  }

  /// Puts a payload into an actor's mailbox as its peer's message.
  /// @returns whether it was admitted and could be read.
  template <class Peer, class Actor>
  bool deliver(caf::actor_system& sys, std::span<const std::byte> payload,
               const Peer& from, const Actor& to) {
    auto message = read(sys, payload);
    if (message)
      caf::actor_cast<caf::abstract_actor*>(to)->enqueue(
          caf::actor_cast<caf::strong_actor_ptr>(from), caf::make_message_id(),
          std::move(*message), nullptr);
    return message.has_value();
  }

private:
  static actors::frame_header header_of(std::uint8_t operation,
                                        std::span<const std::byte> payload,
                                        std::uint64_t id) {
    const auto size = static_cast<std::uint32_t>(payload.size());
    return {operation, 0, size, id, 5, 9};
  }

  actors::frame_check check_;
};

/// A provider's endpoint, by which one service runs.
struct hearing_provider : vehicle_connection_world {
  opened_connection connection{true, actors::messages_to_provider()};

  hearing_provider() { accept(one); }

  std::vector<octets> honest() {
    auto request = request_of(station, 20);
    request.candidates.resize(3);
    return {payload_of(station, cam_of(station)),
            payload_of(request),
            payload_of(messages::service_input{one, now(),
                                               messages::payload::of(echo{1})}),
            payload_of(messages::service_end{one}),
            payload_of(messages::ping{1, now()}),
            payload_of(messages::pong{{1, now()}, now(), now()}),
            payload_of(messages::stream_id{station})};
  }

  /// @returns whether it was admitted and could be read.
  bool hear(std::span<const std::byte> payload) {
    return connection.deliver(system(), payload, peer.handle, endpoint);
  }

  /// @returns whether it lives, and has spoken for its stations alone since
  /// the last `forget`.
  bool is_unharmed() const {
    const auto is_own = [](station_id who) {
      return who == station || who == neighbour;
    };
    const auto asked = provider->all<messages::service_request>();
    const auto ended = provider->all<messages::service_end>();
    return !is_gone(endpoint)
           && std::ranges::all_of(asked, is_own,
                                  &messages::service_request::station)
           && std::ranges::all_of(ended, is_own,
                                  [](const messages::service_end& end) {
                                    return end.session.station;
                                  });
  }
};

/// The endpoint of a process of vehicles, by which one service runs.
struct hearing_vehicles : provider_connection_world {
  opened_connection connection{false, actors::messages_to_vehicles()};

  hearing_vehicles() {
    connect();
    accept(one);
  }

  std::vector<octets> honest() {
    return {
        payload_of(station, messages::service_offer{boot, {1, 2}, {"one"}}),
        payload_of(
            messages::service_response{boot, station, 1, {{one, true, ""}}}),
        payload_of(messages::service_result{one, 1, now(),
                                            messages::payload::of(echo{1})}),
        payload_of(messages::service_end{one, messages::end_reason::left_area,
                                         messages::side::provider}),
        payload_of(messages::ping{1, now()}),
        payload_of(messages::pong{{1, now()}, now(), now()}),
        payload_of(messages::stream_id{station})};
  }

  /// @returns whether it was admitted and could be read.
  bool hear(std::span<const std::byte> payload) {
    return connection.deliver(system(), payload, provider.handle, host->peer);
  }

  /// @returns whether it lives, and has kept its provider since the last
  /// `forget`.
  bool is_unharmed() const {
    return notes("provider_lost") == 0 && !is_gone(outbox) && !is_gone(far);
  }
};

} // namespace sofof::test
