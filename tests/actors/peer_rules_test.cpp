// Tests of what a provider hears of a peer that has been let in.
#include "actors/remote/peer_rules.hpp"

#include "base/protocol.hpp"
#include "tests/support/at.hpp"

#include <doctest/doctest.h>

using namespace sofof;
using namespace sofof::actors;
using namespace sofof::messages;
using namespace std::chrono_literals;
using test::at;

namespace {

struct peer_of_two {
  static constexpr station_id::rep own = 101, neighbour = 102, foreign = 999;

  /// Of nothing but its header.
  static its_pdu message_of(station_id::rep station) {
    return {{{},
             {},
             std::byte(station >> 24),
             std::byte(station >> 16),
             std::byte(station >> 8),
             std::byte(station)},
            {},
            0};
  }
};

} // namespace

TEST_CASE_FIXTURE(peer_of_two, "a peer speaks for its own stations only") {
  const peer_rules rules{{own, neighbour}};
  CHECK(rules.objection_to_sender(own).empty());
  CHECK(rules.objection_to_sender(neighbour).empty());
  CHECK(rules.objection_to_sender(foreign) == "speaks for another station");
}

TEST_CASE_FIXTURE(peer_of_two, "a station sends its own ITS messages only") {
  peer_rules rules{{own, neighbour}};
  CHECK(rules.objection_to(own, message_of(own), at(1s)).empty());
  for (const auto& other : {message_of(neighbour), its_pdu{}})
    CHECK(rules.objection_to(own, other, at(1s))
          == "carries another station's message");
}

TEST_CASE_FIXTURE(
    peer_of_two,
    "a station sends a hundred messages and inputs a second, two seconds "
    "of it at once; others do not notice") {
  peer_rules rules{{own, neighbour}};
  const service_input input{{11, own, "one", 7}, at(1s), {}};
  for (int k = 0; k < 100; ++k) {
    CHECK(rules.objection_to(own, message_of(own), at(1s)).empty());
    CHECK(rules.objection_to(input, at(1s)).empty());
  }
  CHECK(rules.objection_to(input, at(1s)) == "says too much");
  CHECK(rules.objection_to(own, message_of(own), at(1s)) == "says too much");
  CHECK(rules.objection_to(neighbour, message_of(neighbour), at(1s)).empty());
  CHECK(rules.objection_to(own, message_of(own), at(1s + 10ms)).empty());
  CHECK(rules.objection_to(input, at(1s + 10ms)) == "says too much");
}

TEST_CASE_FIXTURE(
    peer_of_two,
    "a peer of one station sends 400 messages a second of any kind, two "
    "seconds of it at once") {
  peer_rules rules{{own}};
  for (int k = 0; k < 800; ++k)
    CHECK(rules.objection_to_message(at(1s)).empty());
  CHECK(rules.objection_to_message(at(1s)) == "the peer says too much");
  CHECK(rules.objection_to_message(at(1s + 2500us)).empty());
}

TEST_CASE_FIXTURE(
    peer_of_two,
    "a request has 1000 waypoints, 64 services and 64 candidates at "
    "most") {
  service_request request;
  request.route.resize(1000);
  request.services.resize(64);
  request.candidates.resize(protocol::most_candidates);
  CHECK(peer_rules::objection_to(request).empty());
  const auto is_too_much = [](const service_request& x) {
    return peer_rules::objection_to(x) == "asks for too much";
  };
  auto larger = request;
  larger.route.resize(1001);
  CHECK(is_too_much(larger));
  larger = request;
  larger.services.resize(65);
  CHECK(is_too_much(larger));
  larger = request;
  larger.candidates.resize(protocol::most_candidates + 1);
  CHECK(is_too_much(larger));
}
