// Tests of the service requester: a provider whose results no vehicle believes.
#include "tests/actors/requester_world.hpp"

#include <algorithm>

using namespace sofof;
using namespace sofof::actors;
using namespace sofof::messages;
using namespace sofof::test;

namespace {

/// Says, as a result of cycle 2, what no vehicle believes.
void lie(requester_world& world, const session_id& running) {
  world.run_for(50ms);
  world.tell(world.requester, service_result{running, 2, world.now(),
                                             payload::of(echo{echo::lie})});
}

} // namespace

TEST_CASE_FIXTURE(requester_world,
                  "an implausible result ends its episode in the same instant, "
                  "on both sides, and is recorded with its check") {
  start_remote({one});
  lie(*this, at_here(one, 7));
  CHECK(!is_remote(one));
  REQUIRE(ends().size() == 1);
  CHECK(ends().front().reason == end_reason::implausible);
  CHECK(provider->times<service_end>().front() == now());
  REQUIRE(episodes().size() == 1);
  CHECK(episodes().front().reason == end_reason::implausible);
  CHECK(episodes().front().fallback);
  const auto events = recorder->all<event_record>();
  const auto found =
      std::ranges::find(events, event_type::implausible, &event_record::what);
  REQUIRE(found != events.end());
  CHECK(found->provider == here);
  CHECK(found->service == one);
  CHECK(found->detail == "number value=2.000 limit=1.000");
}

TEST_CASE_FIXTURE(requester_world,
                  "who ends the service in the instant of its lie has lied") {
  start_remote({one});
  run_for(50ms);
  caf::anon_send(requester, service_result{at_here(one, 7), 2, now(),
                                           payload::of(echo{echo::lie})});
  caf::anon_send(requester, service_end{at_here(one, 7), end_reason::left_area,
                                        side::provider});
  settle();
  const auto events = recorder->all<event_record>();
  CHECK(std::ranges::count(events, event_type::implausible, &event_record::what)
        == 1);
  const auto asked = requests();
  run_for(30s);
  offer({one});
  CHECK(requests() == asked);
}

TEST_CASE_FIXTURE(requester_world, "an implausible result is a bad outcome to "
                                   "the policy") {
  start_remote({one});
  lie(*this, at_here(one, 7));
  const auto& cycles = lodm->cycles;
  REQUIRE(!cycles.empty());
  CHECK(cycles.back().computed_at == here);
  CHECK(cycles.back().missed);
  REQUIRE(!lodm->episodes.empty());
  CHECK(lodm->episodes.back().end_reason == "implausible");
}

TEST_CASE_FIXTURE(requester_world,
                  "a provider that has lied is not asked for anything for 60 "
                  "s, and others are") {
  start_remote({one});
  lie(*this, at_here(one, 7));
  const auto asked = requests();
  run_for(60s - 1ns);
  offer({one, two});
  CHECK(requests() == asked);
  offer_from(other, elsewhere, {one});
  CHECK(other->count<service_request>() == 1);
  run_for(1ns);
  offer({two});
  CHECK(requests() == asked + 1);
}

TEST_CASE_FIXTURE(requester_world,
                  "a liar that boots again is not believed for that") {
  start_remote({one});
  lie(*this, at_here(one, 7));
  run_for(10s);
  offer_from(provider, here + 65536, {one});
  CHECK(requests() == 1);
}

TEST_CASE_FIXTURE(requester_world,
                  "a liar that had booted again before it lied is not "
                  "believed for that either") {
  start_remote({one, two});
  offer_from(provider, here + 65536, {one, two});
  const auto asked = requests();
  lie(*this, at_here(one, 7));
  run_for(10s);
  offer_from(provider, here + 65536, {one});
  CHECK(requests() == asked);
}

TEST_CASE_FIXTURE(requester_world,
                  "what else runs at a provider that has lied goes on") {
  start_remote({one, two});
  lie(*this, at_here(one, 7));
  result(at_here(two, 8), 2);
  CHECK(!is_remote(one));
  CHECK(is_remote(two));
}
