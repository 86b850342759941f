// Tests of what a provider tells of the sessions that it believes to run, and
// of what a requester makes of it.
#include "base/protocol.hpp"
#include "tests/actors/provider_world.hpp"
#include "tests/actors/requester_world.hpp"

using namespace sofof;
using namespace sofof::messages;
using namespace sofof::test;

namespace {

struct telling_world : provider_world {
  std::vector<session_digest> digests() const {
    return requester->all<session_digest>();
  }
};

/// Service "one" runs at the first provider, as its session 7.
struct told_world : requester_world {
  told_world() {
    start_remote({one});
    run_for(50ms);
    result(at_here(one, 7), 2);
  }

  void tell_of(std::uint32_t last_counter, std::vector<session_id> running) {
    digest_from(provider, {here, station, last_counter, std::move(running)});
  }
  /// Results go on until the next digest is due.
  void pass_digest_period() {
    for (int k = 0; k < 10; ++k) {
      run_for(protocol::digest_period / 10);
      result(at_here(one, 7), ++cycle);
    }
  }
  std::uint64_t cycle = 2; // of the latest result
  void digest_from(const probe<provider_actor>& from,
                   const session_digest& digest) {
    tell_as(from.handle, requester, digest);
  }
};

} // namespace

// -- the provider -------------------------------------------------------------

TEST_CASE_FIXTURE(telling_world, "while something runs for it a station is "
                                 "told twice a second what") {
  hear(inside);
  start({one, two});
  const auto begun = now();
  stay(2s);
  REQUIRE(digests().size() == 4);
  for (std::size_t k = 0; k < 4; ++k) {
    const auto digest = digests()[k];
    CHECK(digest.provider == boot);
    CHECK(digest.station == station);
    CHECK(digest.last_counter == verdicts()[1].session.counter);
    CHECK(digest.running
          == std::vector{verdicts()[0].session, verdicts()[1].session});
    CHECK(requester->times<session_digest>()[k]
          == begun + static_cast<int>(k + 1) * 500ms);
  }
}

TEST_CASE_FIXTURE(telling_world, "a station for which nothing has run is told "
                                 "nothing") {
  hear(inside);
  stay(5s);
  CHECK(digests().empty());
}

TEST_CASE_FIXTURE(telling_world, "when nothing runs any more a station is told "
                                 "so for two seconds") {
  hear(inside);
  start({one});
  stay(700ms); // one digest
  tell(provider, service_end{verdicts()[0].session, end_reason::released,
                             side::requester});
  requester->clear();
  stay(5s);
  CHECK(digests().size() == 5);
  for (const auto& digest : digests()) {
    CHECK(digest.running.empty());
    CHECK(digest.last_counter > 0);
  }
}

TEST_CASE_FIXTURE(telling_world, "a digest names what runs for its station "
                                 "alone, and knows of all that was accepted") {
  hear(inside);
  start({one});
  hear(inside, neighbour, 102);
  tell(provider, service_request{boot, 102, 1, {one}, {inside}, 10},
       neighbour.handle);
  stay(500ms);
  REQUIRE(digests().size() == 1);
  REQUIRE(neighbour->count<session_digest>() == 1);
  const auto ours = digests().front();
  const auto theirs = neighbour->all<session_digest>().front();
  REQUIRE(ours.running.size() == 1);
  REQUIRE(theirs.running.size() == 1);
  CHECK(ours.running.front().station == station);
  CHECK(theirs.running.front().station == 102);
  CHECK(ours.last_counter == theirs.last_counter);
}

// -- the requester ------------------------------------------------------------

TEST_CASE_FIXTURE(told_world, "what its provider says to run goes on") {
  tell_of(7, {at_here(one, 7)});
  CHECK(is_remote(one));
  CHECK(ends().empty());
}

TEST_CASE_FIXTURE(told_world,
                  "a session that its provider runs no longer ends, "
                  "and its provider is not told") {
  tell_of(7, {}); // it may have overtaken the word of the end
  CHECK(is_remote(one));
  pass_digest_period();
  CHECK(is_remote(one));
  tell_of(7, {});
  CHECK(!is_remote(one));
  CHECK(ends().empty());
  REQUIRE(episodes().size() == 1);
  CHECK(episodes().front().reason == end_reason::no_data);
  CHECK(episodes().front().because == "its provider runs it no longer");
}

TEST_CASE_FIXTURE(told_world, "a digest and its copy are one") {
  tell_of(7, {});
  run_for(20ms);
  tell_of(7, {});
  CHECK(is_remote(one));
}

TEST_CASE_FIXTURE(told_world, "the word of the end that comes after a digest "
                              "says why") {
  tell_of(7, {});
  tell(requester,
       service_end{at_here(one, 7), end_reason::left_area, side::provider});
  tell_of(7, {});
  REQUIRE(episodes().size() == 1);
  CHECK(episodes().front().reason == end_reason::left_area);
  CHECK(!episodes().front().fallback);
}

TEST_CASE_FIXTURE(told_world,
                  "a session that one digest does not name, and the "
                  "next one does, goes on") {
  for (int k = 0; k < 3; ++k) {
    tell_of(7, {});
    pass_digest_period();
    tell_of(7, {at_here(one, 7)});
    pass_digest_period();
  }
  CHECK(is_remote(one));
}

TEST_CASE_FIXTURE(told_world, "a digest that was made before a session was "
                              "accepted does not end it, however late it "
                              "comes") {
  tell_of(6, {});
  pass_digest_period();
  tell_of(6, {});
  pass_digest_period();
  tell_of(6, {at_here(one, 5)}); // an earlier one of the same service
  CHECK(is_remote(one));
}

TEST_CASE_FIXTURE(told_world, "what a provider runs for nothing is ended there "
                              "at each digest, until none names it") {
  for (int k = 1; k <= 3; ++k) {
    tell_of(8, {at_here(one, 7), at_here(two, 8)});
    REQUIRE(ends().size() == static_cast<std::size_t>(k));
    CHECK(ends().back().session == at_here(two, 8));
    CHECK(ends().back().from == side::requester);
    pass_digest_period();
  }
  tell_of(8, {at_here(one, 7)});
  CHECK(ends().size() == 3);
  CHECK(is_remote(one));
}

TEST_CASE_FIXTURE(told_world, "a hundred digests in one instant are answered "
                              "once") {
  for (int k = 0; k < 100; ++k)
    tell_of(8, {at_here(one, 7), at_here(two, 8)});
  CHECK(ends().size() == 1);
}

TEST_CASE_FIXTURE(told_world, "a provider that accepts with a counter that it "
                              "has used before is not believed") {
  offer({two});
  const auto number = provider->all<service_request>().back().number;
  tell(requester,
       service_response{here, station, number, {{at_here(two, 7), true, {}}}},
       std::vector{listen<provider_manager_actor>().handle});
  run_for(50ms);
  result(at_here(two, 7), 1);
  CHECK(!is_remote(two));
  CHECK(is_remote(one));
}

TEST_CASE_FIXTURE(told_world, "while a request is open its provider may run "
                              "what the answer will name") {
  offer({two});
  REQUIRE(requests() == 2);
  tell_of(8, {at_here(one, 7), at_here(two, 8)});
  CHECK(ends().empty());
  run_for(protocol::request_timeout); // the answer was lost
  tell_of(8, {at_here(one, 7), at_here(two, 8)});
  REQUIRE(ends().size() >= 1);
  CHECK(ends().back().session == at_here(two, 8));
}

TEST_CASE_FIXTURE(told_world, "only the provider that is meant speaks of its "
                              "sessions, and only of this station's") {
  for (int k = 0; k < 2; ++k) {
    digest_from(other, {here, station, 7, {}});
    digest_from(other, {elsewhere, station, 7, {}});
    digest_from(provider, {here, 999, 7, {}});
    digest_from(provider, {elsewhere, station, 7, {}});
    pass_digest_period();
  }
  auto strange = at_here(two, 8);
  strange.station = 999;
  tell_of(8, {at_here(one, 7),
              strange,
              at_here({"three"}, 9),
              {elsewhere, station, two, 3},
              at_here(two, 0)});
  CHECK(is_remote(one));
  CHECK(ends().empty());
}

TEST_CASE_FIXTURE(told_world, "a digest that names one service many times ends "
                              "it once") {
  std::vector<session_id> all;
  for (std::uint32_t counter = 8; counter < 1000; ++counter)
    all.push_back(at_here(two, counter));
  all.push_back(at_here(one, 7));
  tell_of(1000, all);
  CHECK(is_remote(one));
  CHECK(ends().size() == 1);
}

TEST_CASE_FIXTURE(requester_world, "a session of which nothing comes for two "
                                   "seconds and a quarter ends, though it "
                                   "stands by") {
  start_remote({one});
  lodm->preferred = here;
  lodm->second = elsewhere;
  lodm->hedge_after = 20ms;
  offer_from(other, elsewhere, {one});
  const auto second = listen<provider_manager_actor>();
  const session_id beside{elsewhere, station, one, 70};
  tell(requester,
       service_response{elsewhere,
                        station,
                        other->all<service_request>().back().number,
                        {{beside, true, "as told"}}},
       std::vector{second.handle});
  result(beside, 1);
  const auto last = now();
  std::uint64_t cycle = 1;
  const auto run_until = [&](duration since_last) {
    while (now() < last + since_last) {
      run_for(50ms);
      result(at_here(one, 7), ++cycle);
    }
  };
  run_until(2s);
  CHECK(other->count<service_end>() == 0);
  tell_as(other.handle, requester,
          session_digest{elsewhere, station, 70, {beside}});
  run_until(4200ms);
  CHECK(other->count<service_end>() == 0);
  run_until(4300ms);
  REQUIRE(other->count<service_end>() == 1);
  CHECK(other->all<service_end>().front().reason == end_reason::no_data);
  CHECK(is_remote(one));
}
