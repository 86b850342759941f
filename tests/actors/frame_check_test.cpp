// Tests of what is judged of a frame before anything of it is deserialised.
#include "actors/remote/frame_check.hpp"

#include "actors/remote/public_messages.hpp"
#include "messages/type_ids.hpp"
#include "tests/support/virtual_world.hpp"

#include <caf/binary_serializer.hpp>
#include <caf/error.hpp>
#include <caf/message.hpp>
#include <caf/sec.hpp>
#include <doctest/doctest.h>

#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace sofof::test::frames {

using namespace actors;
using namespace messages;

namespace {

using octets = std::vector<std::byte>;

constexpr std::uint64_t told = 0x1000'0000'0000'0000;
constexpr std::uint64_t asked = told | 7;
constexpr std::uint64_t answered = asked | 0x8000'0000'0000'0000;

enum : std::uint8_t {
  server_hello,
  client_hello,
  direct,
  routed,
  monitor,
  down,
  heartbeat
};

template <class... Ts>
octets serialised(const Ts&... xs) {
  virtual_world world; // actor handles need one
  caf::byte_buffer buffer;
  caf::binary_serializer sink{world.system(), buffer};
  REQUIRE((sink.apply(xs) && ...));
  octets out(buffer.size());
  std::memcpy(out.data(), buffer.data(), out.size());
  return out;
}

/// A message as BASP sends it: no stages, then its elements.
template <class... Ts>
octets message_of(const Ts&... xs) {
  return serialised(std::vector<std::uint16_t>{}, caf::make_message(xs...));
}

octets operator+(octets a, const octets& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

octets node(std::uint8_t filled_with = 7) {
  octets n(25, std::byte{filled_with});
  n.front() = std::byte{1};
  return n;
}

struct connection {
  frame_check check;

  connection(bool is_accepted, const message_forms& forms)
      : check{is_accepted, forms} {}

  std::string judge(std::uint8_t operation, const octets& payload,
                    std::uint64_t data = 0, std::uint8_t flags = 0) {
    const frame_header header{
        operation,
        flags,
        static_cast<std::uint32_t>(payload.size()),
        data,
        5,
        operation == direct || operation == monitor ? 9u : 0u};
    const auto why = check.objection(header);
    return std::string{why.empty() ? check.objection(header, payload) : why};
  }
};

/// What a provider hears of a peer that has introduced its node.
struct at_provider : connection {
  at_provider() : connection{true, messages_to_provider()} {
    REQUIRE(judge(client_hello, node()).empty());
  }
};

/// What vehicles hear of a provider that they have called.
struct at_vehicles : connection {
  at_vehicles() : connection{false, messages_to_vehicles()} {
    REQUIRE(judge(server_hello, node() + octets(100)).empty());
  }
};

const std::string unknown = "its message is none that it may send";
const session_id running{11, 101, "trajectory_planning", 3};

} // namespace

TEST_CASE("what vehicles say to a provider is admitted") {
  at_provider at;
  CHECK(at.judge(heartbeat, {}) == "");
  CHECK(at.judge(monitor, node() + node(9)) == "");
  CHECK(at.judge(down, node() + node(9) + octets(6)) == "");
  CHECK(at.judge(direct, message_of(std::uint32_t{6}, std::uint64_t{1}), asked)
        == "");
  CHECK(at.judge(direct,
                 message_of(station_id::rep{101}, its_pdu{octets(300), {}}),
                 told)
        == "");
  service_request request{11, 101, 1, {"a", "b"}, {}, 5};
  request.route.resize(1000);
  request.candidates.resize(64);
  request.services.resize(64, service_name{"a_name_that_is_rather_long"});
  CHECK(at.judge(direct, message_of(request), told) == "");
  CHECK(at.judge(direct, message_of(service_input{running, {}, {}}), told)
        == "");
  CHECK(at.judge(direct, message_of(service_end{running}), told) == "");
  CHECK(at.judge(direct, message_of(ping{}), told) == "");
  CHECK(at.judge(direct, message_of(pong{}), told) == "");
  CHECK(at.judge(direct, message_of(stream_id{101}), told) == "");
}

TEST_CASE("what a provider says to vehicles is admitted") {
  at_vehicles at;
  CHECK(
      at.judge(direct, message_of(station_id::rep{101}, service_offer{}), told)
      == "");
  CHECK(at.judge(direct, message_of(service_response{}), told) == "");
  CHECK(at.judge(direct, message_of(service_result{running, 1, {}, {}}), told)
        == "");
  CHECK(at.judge(direct, message_of(service_end{running}), told) == "");
  CHECK(at.judge(direct, message_of(ping{}), told) == "");
  CHECK(at.judge(direct, message_of(pong{}), told) == "");
  CHECK(at.judge(direct, message_of(stream_id{101}), told) == "");
  CHECK(at.judge(direct,
                 message_of(std::uint32_t{6}, std::uint64_t{1},
                            std::string{"n"}, caf::strong_actor_ptr{}),
                 answered)
        == "");
  CHECK(at.judge(direct, message_of(peer_welcome{}, provider_endpoint_actor{}),
                 answered)
        == "");
  CHECK(at.judge(direct,
                 message_of(caf::make_error(caf::sec::invalid_argument,
                                            std::string(300, 'x'))),
                 answered)
        == "");
  CHECK(at.judge(direct,
                 message_of(caf::error{caf::sec::request_receiver_down}),
                 answered)
        == "");
  CHECK(at.judge(direct, message_of(caf::error{}), answered) == "");
}

TEST_CASE("the largest hello that is possible is admitted") {
  at_provider at;
  peer_hello hello{"mec", std::vector<station_id>(10'000), 1,
                   2,     std::string(64 * 1024, 'c'),     octets(1024)};
  CHECK(at.judge(direct, message_of(hello, vehicle_endpoint_actor{}), asked)
        == "");
}

TEST_CASE("each message goes its own way alone") {
  at_provider provider;
  at_vehicles vehicles;
  const auto sign = message_of(ping{});
  const auto result = message_of(service_result{running, 1, {}, {}});
  const auto question = message_of(std::uint32_t{6}, std::uint64_t{1});
  const auto welcome = message_of(peer_welcome{}, provider_endpoint_actor{});
  for (const auto id : {asked, answered, std::uint64_t{0}, 3 * told, 2 * told,
                        told | std::uint64_t{1} << 63}) {
    CAPTURE(id);
    CHECK(provider.judge(direct, sign, id) == unknown);
  }
  CHECK(provider.judge(direct, result, told) == unknown);
  CHECK(provider.judge(direct, question, told) == unknown);
  CHECK(provider.judge(direct, welcome, answered) == unknown);
  CHECK(provider.judge(direct, message_of(caf::error{}), answered) == unknown);
  CHECK(vehicles.judge(direct, question, asked) == unknown);
  CHECK(vehicles.judge(direct, welcome, told) == unknown);
  CHECK(vehicles.judge(direct, message_of(caf::error{}), told) == unknown);
}

TEST_CASE("words of the process itself are none of a peer's") {
  at_provider provider;
  at_vehicles vehicles;
  const auto refused = [&](const octets& message) {
    for (const auto id : {told, asked, answered}) {
      CHECK(provider.judge(direct, message, id) == unknown);
      CHECK(vehicles.judge(direct, message, id) == unknown);
    }
  };
  refused(message_of(tick_atom_v));
  refused(message_of(std::string{"a line for the journal"}));
  refused(
      message_of(peer_hello{}, vehicle_endpoint_actor{}, std::string{"name"}));
  refused(message_of(motion_report{}));
  refused(message_of(caf::make_message(caf::make_message())));
  refused(message_of(caf::exit_msg{{}, caf::exit_reason::kill}));
  refused(message_of(ping{}, ping{}));
  refused(message_of());
}

TEST_CASE("an error is a code of a known kind and a sentence at most") {
  at_vehicles at;
  const auto judge = [&](const caf::error& error) {
    return at.judge(direct, message_of(error), answered);
  };
  CHECK(judge(caf::make_error(caf::sec::runtime_error, std::string{"a"},
                              std::string{"b"}))
        == unknown);
  CHECK(judge(caf::make_error(caf::sec::runtime_error,
                              caf::make_message(std::string{"a"})))
        == unknown);
  CHECK(judge(caf::make_error(caf::sec::runtime_error, 7)) == unknown);
  CHECK(judge(caf::make_error(caf::pec::trailing_character)) == unknown);
  // Shorter or longer than it says.
  auto error = message_of(
      caf::make_error(caf::sec::runtime_error, std::string{"sentence"}));
  CHECK(at.judge(direct, error, answered) == "");
  error.push_back(std::byte{0});
  CHECK(at.judge(direct, error, answered) == unknown);
  error.resize(error.size() - 2);
  CHECK(at.judge(direct, error, answered) == unknown);
}

TEST_CASE("a message has no actor to be forwarded to") {
  at_provider at;
  auto message = message_of(ping{});
  message.front() = std::byte{1};
  CHECK(at.judge(direct, message, told) == unknown);
}

TEST_CASE("a message of more octets than its kind needs is refused") {
  at_provider at;
  service_request request{11, 101, 1, {"a"}, {}, 5};
  request.candidates.resize(2000);
  CHECK(at.judge(direct, message_of(request), told)
        == "its message is too long");
  const auto big = octets(1024 * 1024);
  CHECK(at.judge(direct, big, told) == "its frame is none that it may send");
}

TEST_CASE("the first frame is the handshake, and there is no second one") {
  const auto first = "its first frame is not its handshake";
  const auto twice = "it introduces its node twice";
  const auto sign = message_of(ping{});
  connection accepted{true, messages_to_provider()};
  CHECK(accepted.judge(direct, sign, told) == first);
  CHECK(accepted.judge(heartbeat, {}) == first);
  CHECK(accepted.judge(server_hello, node() + octets(9)) == first);
  CHECK(accepted.judge(client_hello, node()) == "");
  CHECK(accepted.judge(client_hello, node()) == twice);
  CHECK(accepted.judge(server_hello, node())
        == "its frame is none that it may send");
  connection opened{false, messages_to_vehicles()};
  CHECK(opened.judge(client_hello, node()) == first);
  CHECK(opened.judge(server_hello, node()) == "");
  CHECK(opened.judge(server_hello, node()) == twice);
}

TEST_CASE("a peer has a node id of its own kind") {
  connection none{true, messages_to_provider()};
  CHECK(none.judge(client_hello, {std::byte{0xff}})
        == "its frame is none that it may send");
  auto by_name = node();
  by_name.front() = std::byte{0};
  CHECK(none.judge(client_hello, by_name) == "it has no node id");
  CHECK(none.check.node().empty());
  at_provider at;
  CHECK(at.check.node().size() == 25);
  CHECK(at.judge(monitor, node() + by_name) == "it speaks for no node");
  CHECK(at.judge(down, by_name + node()) == "it speaks for no node");
}

TEST_CASE("frames of no known operation, with flags or of odd sizes are "
          "refused") {
  const auto none = "its frame is none that it may send";
  at_provider at;
  CHECK(at.judge(routed, octets(60)) == none);
  CHECK(at.judge(7, {}) == none);
  CHECK(at.judge(255, {}) == none);
  CHECK(at.judge(heartbeat, octets(1)) == none);
  CHECK(at.judge(monitor, octets(49)) == none);
  CHECK(at.judge(monitor, octets(51)) == none);
  CHECK(at.judge(down, octets(49)) == none);
  CHECK(at.judge(down, octets(9000)) == none);
  CHECK(at.judge(direct, {}, told) == none);
  CHECK(at.judge(direct, message_of(ping{}), told, 1) == none);
}

TEST_CASE("whatever part of a frame comes, nothing past its end is read") {
  for (const auto& whole :
       {message_of(
            caf::make_error(caf::sec::runtime_error, std::string{"sentence"})),
        message_of(peer_welcome{}, provider_endpoint_actor{})})
    for (std::size_t n = 1; n < whole.size(); ++n) {
      at_vehicles at;
      const octets part{whole.begin(),
                        whole.begin() + static_cast<std::ptrdiff_t>(n)};
      at.judge(direct, part, answered); // under the address sanitizer
    }
}

} // namespace sofof::test::frames
