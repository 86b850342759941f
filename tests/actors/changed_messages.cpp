// Messages whose octets were changed on their way: what the frame check admits
// reaches the actors of both ends, and harms neither.
#include "actors/remote/public_messages.hpp"
#include "tests/actors/session_world.hpp"
#include "tests/actors/uplink_world.hpp"

#include <caf/binary_deserializer.hpp>
#include <caf/binary_serializer.hpp>

#include <algorithm>
#include <cstdlib>
#include <random>

namespace sofof::test::changes {

namespace {

using octets = std::vector<std::byte>;

constexpr std::uint64_t told_id = 0x1000'0000'0000'0000;
constexpr std::uint8_t direct_message = 2;

/// How many are tried; more by the environment.
std::size_t wanted() {
  const auto* said = std::getenv("SOFOF_CHANGED_MESSAGES");
  return said ? std::strtoul(said, nullptr, 10) : 20'000;
}

template <class... Ts>
octets payload_of(const Ts&... xs) {
  caf::byte_buffer buffer;
  caf::binary_serializer sink{nullptr, buffer};
  REQUIRE(sink.apply(std::vector<std::uint16_t>{}));
  REQUIRE(sink.apply(caf::make_message(xs...)));
  const auto* begin = reinterpret_cast<const std::byte*>(buffer.data());
  return {begin, begin + buffer.size()};
}

class changer {
public:
  octets operator()(octets x) {
    constexpr std::byte odd[] = {std::byte{0}, std::byte{1}, std::byte{0x7f},
                                 std::byte{0x80}, std::byte{0xff}};
    for (auto n = draw(5); n > 0; --n) {
      const auto at =
          x.begin() + static_cast<std::ptrdiff_t>(draw(x.size() - 1));
      switch (draw(3)) {
        case 0:
          *at = odd[draw(4)];
          break;
        case 1:
          *at = static_cast<std::byte>(draw(255));
          break;
        case 2:
          x.insert(at, draw(8), odd[draw(4)]);
          break;
        default:
          if (x.size() > 8)
            x.erase(at, at + std::min<std::ptrdiff_t>(4, x.end() - at));
      }
    }
    return x;
  }

  /// @returns a number from 0 on.
  std::size_t draw(std::size_t most) {
    return std::uniform_int_distribution<std::size_t>{0, most}(numbers_);
  }

private:
  std::mt19937 numbers_{20};
};

/// Sends changes of these payloads, as if they had come by a connection.
/// @param look  Called now and then, to see what came of them.
/// @returns how many were admitted and could be read.
template <class World, class To, class Look>
std::size_t send_changed(World& world, const std::vector<octets>& honest,
                         const message_forms& forms, bool is_accepted,
                         const caf::strong_actor_ptr& from, const To& to,
                         Look look) {
  changer change;
  frame_check check{is_accepted, forms};
  octets node(is_accepted ? 25 : 60, std::byte{1});
  const frame_header handshake{static_cast<std::uint8_t>(is_accepted),
                               0,
                               static_cast<std::uint32_t>(node.size()),
                               0,
                               0,
                               0};
  REQUIRE(check.objection(handshake).empty());
  REQUIRE(check.objection(handshake, node).empty());
  std::size_t read = 0;
  for (std::size_t n = wanted(); n > 0; --n) {
    const auto payload = change(honest[change.draw(honest.size() - 1)]);
    const frame_header header{
        direct_message, 0, static_cast<std::uint32_t>(payload.size()),
        told_id,        5, 9};
    if (!check.objection(header).empty()
        || !check.objection(header, payload).empty())
      continue;
    caf::binary_deserializer source{
        world.system(),
        caf::make_span(reinterpret_cast<const caf::byte*>(payload.data()),
                       payload.size())};
    std::vector<caf::strong_actor_ptr> stages;
    caf::message message;
    if (!source.apply(stages) || !source.apply(message))
      continue;
    REQUIRE(stages.empty());
    ++read;
    caf::actor_cast<caf::abstract_actor*>(to)->enqueue(
        from, caf::make_message_id(), std::move(message), nullptr);
    if (n % 16 == 0) // below what a session hears
      world.live(50ms);
    if (n % 1024 == 0) {
      look();
      world.forget();
    }
  }
  world.live(1s);
  look();
  return read;
}

} // namespace

TEST_CASE_FIXTURE(session_world, "whatever admitted messages hold, a session "
                                 "lives on, and speaks for its stations "
                                 "alone") {
  accept(one);
  service_request request = request_of(station, 20);
  request.candidates.resize(3);
  const std::vector<octets> honest{
      payload_of(station, cam_of(station)),
      payload_of(request),
      payload_of(service_input{one, now(), payload::of(echo{1})}),
      payload_of(service_end{one}),
      payload_of(life_sign{1, now()}),
      payload_of(life_echo{{1, now()}, now(), now()}),
      payload_of(stream_id{station})};
  const auto read = send_changed(
      *this, honest, messages_to_provider(), true,
      caf::actor_cast<caf::strong_actor_ptr>(peer.handle), session, [this] {
        REQUIRE(!is_gone(session));
        for (const auto& asked : provider->all<service_request>())
          CHECK((asked.station == station || asked.station == neighbour));
        for (const auto& ended : provider->all<service_end>())
          CHECK((ended.running.station == station
                 || ended.running.station == neighbour));
      });
  CHECK(read > wanted() / 10);
}

TEST_CASE_FIXTURE(uplink_world, "whatever admitted messages hold, vehicles "
                                "keep their uplink") {
  connect();
  accept(one);
  const std::vector<octets> honest{
      payload_of(station, service_offer{boot, {1, 2}, {"one"}}),
      payload_of(service_response{boot, station, 1, {{one, true, ""}}}),
      payload_of(service_result{one, 1, now(), payload::of(echo{1})}),
      payload_of(service_end{one, end_reason::left_area, side::provider}),
      payload_of(life_sign{1, now()}),
      payload_of(life_echo{{1, now()}, now(), now()}),
      payload_of(stream_id{station})};
  const auto read = send_changed(
      *this, honest, messages_to_vehicles(), false,
      caf::actor_cast<caf::strong_actor_ptr>(session.handle), host->peer,
      [this] { REQUIRE(notes("provider_lost") == 0); });
  CHECK(read > wanted() / 10);
  CHECK(!is_gone(uplink));
  CHECK(!is_gone(far));
}

} // namespace sofof::test::changes
