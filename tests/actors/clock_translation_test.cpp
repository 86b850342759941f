// Tests of the times in messages of another host, and of how long it lives.
#include "actors/remote/clock_translation.hpp"

#include "base/protocol.hpp"
#include "tests/support/at.hpp"
#include "tests/support/echo.hpp"

#include <doctest/doctest.h>

using namespace sofof;
using namespace sofof::actors;
using namespace sofof::messages;
using namespace std::chrono_literals;
using test::at;
using test::echo;

namespace {

struct peer_ahead {
  static constexpr duration ahead = 500ms; // of the peer's clock
  static constexpr duration gap =
      200ms; // of its time of day, when both stood at 0
  const session_id running{11, 101, "one", 7};

  /// A peer that has answered one ping, which took 2 ms each way.
  static heartbeat known_peer() {
    heartbeat peer{at(1s), gap};
    const auto question = peer.beat(at(1s));
    const auto there = at(1s) + 2ms + ahead;
    peer.on_pong({question, there, there}, at(1s + 4ms));
    return peer;
  }

  static heartbeat unknown_peer() { return {at(1s), gap}; }

  static its_pdu some_message() {
    return {{std::byte{2}, std::byte{2}}, {}, 0};
  }
};

} // namespace

TEST_CASE_FIXTURE(
    peer_ahead,
    "as long as a peer's clock is not known, only offers are translated, "
    "which lose their time") {
  const auto peer = unknown_peer();
  service_offer offer;
  offer.created = at(1s);
  CHECK_FALSE(on_our_clock(offer, peer, at(2s)).created.has_value());
  CHECK_FALSE(on_our_clock(some_message(), peer, at(2s)).has_value());
  CHECK_FALSE(on_our_clock(service_input{running, at(1s), {}}, peer, at(2s))
                  .has_value());
  CHECK_FALSE(on_our_clock(service_result{running, 1, at(1s), {}}, peer, at(2s))
                  .has_value());
}

TEST_CASE_FIXTURE(peer_ahead,
                  "offers, inputs and results carry times of our clock") {
  const auto peer = known_peer();
  service_offer offer;
  offer.created = at(2s) + ahead;
  CHECK(on_our_clock(offer, peer, at(2s)).created == at(2s));
  const service_input input{running, at(2s) + ahead, {}};
  CHECK(on_our_clock(input, peer, at(2s))->at == at(2s));
  const service_result result{running, 1, at(1s) + ahead, {}};
  const auto here = on_our_clock(result, peer, at(2s));
  REQUIRE(here.has_value());
  CHECK(here->created == at(1s));
  CHECK(here->doubt >= 2ms);
  CHECK(here->doubt < 3ms);
}

TEST_CASE_FIXTURE(
    peer_ahead,
    "a result from the future by less than the doubt was created now") {
  const auto peer = known_peer();
  const auto created = [&](duration late) {
    const service_result result{running, 1, at(2s) + late + ahead, {}};
    return on_our_clock(result, peer, at(2s))->created;
  };
  CHECK(created(1ms) == at(2s));
  CHECK(created(10ms) == at(2s + 10ms));
}

TEST_CASE_FIXTURE(
    peer_ahead,
    "an ITS message tells how far its sender's time of day is ahead, "
    "also within inputs and results") {
  const auto peer = known_peer();
  CHECK(on_our_clock(some_message(), peer, at(2s))->ahead == ahead + gap);
  const service_input input{running, at(2s), payload::of(some_message())};
  CHECK(on_our_clock(input, peer, at(2s))->what.as<its_pdu>()->ahead
        == ahead + gap);
  const service_result result{running, 1, at(2s), payload::of(some_message())};
  CHECK(on_our_clock(result, peer, at(2s))->what.as<its_pdu>()->ahead
        == ahead + gap);
}

TEST_CASE_FIXTURE(peer_ahead,
                  "other contents of inputs and results stay as they are") {
  const service_input input{running, at(2s), payload::of(echo{3})};
  const auto here = on_our_clock(input, known_peer(), at(2s));
  CHECK(here->what.as<echo>()->number == 3);
}

TEST_CASE_FIXTURE(peer_ahead,
                  "a peer that answers no ping of the last second is lost") {
  auto peer = known_peer();
  CHECK_FALSE(peer.is_lost(at(1s) + protocol::silence_limit));
  CHECK(peer.is_lost(at(1s) + protocol::silence_limit + 1ns));
  const auto question = peer.beat(at(2s));
  const auto there = at(2s) + ahead;
  peer.on_pong({question, there, there}, at(2s + 1ms));
  CHECK_FALSE(peer.is_lost(at(3s)));
}

TEST_CASE_FIXTURE(
    peer_ahead,
    "an answer to a ping of the future keeps no connection longer than "
    "one of now") {
  auto peer = known_peer();
  const ping of{2, at(100s)};
  peer.on_pong({of, at(100s), at(100s)}, at(2s));
  CHECK(peer.is_lost(at(3s + 1ns)));
}

TEST_CASE_FIXTURE(peer_ahead, "the ways of an input and of its result are told "
                              "by whoever gets them") {
  const auto peer = known_peer();
  const service_input input{running, at(2s) - 30ms + ahead, {}};
  CHECK(on_our_clock(input, peer, at(2s))->up == transit{0ms, 30ms});
  service_result result{running, 1, at(2s) - 20ms + ahead, {}};
  result.timing = {.input_at = at(2s) - 90ms + ahead,
                   .up = {0ms, 12ms},
                   .queue = 1ms,
                   .computing = 4ms};
  const auto here = on_our_clock(result, peer, at(2s));
  REQUIRE(here.has_value());
  CHECK(here->timing.input_at == at(2s) - 90ms);
  CHECK(here->timing.up == transit{0ms, 12ms});
  CHECK(here->timing.down == transit{0ms, 15ms});
}

TEST_CASE_FIXTURE(peer_ahead, "no claim of a peer makes a part of the time "
                              "negative or endless") {
  const auto peer = known_peer();
  for (const auto claimed : {duration::min(), duration{-1}, duration::max()}) {
    service_result result{running, 1, at(1s) + ahead, {}};
    result.timing = {at(1s) + ahead, {claimed, claimed}, claimed, claimed, {}};
    const auto here = on_our_clock(result, peer, at(2s));
    REQUIRE(here.has_value());
    const auto& t = here->timing;
    for (const auto part :
         {t.up.wait, t.up.travel, t.queue, t.computing, t.down.travel}) {
      CHECK(part >= 0ns);
      CHECK(part <= 1h);
    }
  }
}
