// Tests of the service requester: how an offloading ends.
#include "tests/actors/requester_world.hpp"

#include <algorithm>

using namespace sofof;
using namespace sofof::actors;
using namespace sofof::messages;
using namespace sofof::test;

TEST_CASE_FIXTURE(requester_world,
                  "at a violation the provider is told, and the local service "
                  "plans, in the same instant") {
  start_remote({one});
  run_for(100ms);
  CHECK(is_remote(one));
  vehicle->clear();
  run_for(1ns);
  const auto t = now();
  REQUIRE(ends().size() == 1);
  CHECK(ends().front().session == at_here(one, 7));
  CHECK(ends().front().reason == end_reason::qos_gap);
  CHECK(ends().front().from == side::requester);
  CHECK(provider->times<service_end>().front() == t);
  REQUIRE(vehicle->count<source_change>() == 1);
  CHECK(vehicle->times<source_change>().front() == t);
  run_for(10ms);
  const auto results = local_results();
  CHECK(std::ranges::any_of(results, [&](const service_result& r) {
    return r.session.service == one && r.created == t;
  }));
}

TEST_CASE_FIXTURE(requester_world, "a violation closes the episode, once") {
  start_remote({one});
  const auto began = now();
  run_for(10s);
  REQUIRE(episodes().size() == 1);
  const auto e = episodes().front();
  CHECK(e.session == at_here(one, 7));
  CHECK(e.of == side::requester);
  CHECK(e.got_data);
  CHECK(e.first_data == began);
  CHECK(e.ended == began + 100ms + 1ns);
  CHECK(e.reason == end_reason::qos_gap);
  CHECK(e.because == "qos_gap value_ms=100.000001 limit_ms=100.000000");
  CHECK(e.fallback);
}

TEST_CASE_FIXTURE(requester_world, "a late result is a violation of latency") {
  start_remote({one});
  run_for(50ms);
  result(at_here(one, 7), 2, 50ms + 1ns);
  CHECK(!is_remote(one));
  REQUIRE(ends().size() == 1);
  CHECK(ends().front().reason == end_reason::qos_latency);
  REQUIRE(episodes().size() == 1);
  CHECK(episodes().front().reason == end_reason::qos_latency);
}

TEST_CASE_FIXTURE(requester_world,
                  "after a fallback the service cools down for a second, "
                  "exactly") {
  start_remote({one});
  run_for(100ms + 1ns); // the fallback
  offer({one});
  run_for(1s - 1ns);
  offer({one});
  CHECK(requests() == 1);
  run_for(1ns);
  offer({one});
  CHECK(requests() == 2);
}

TEST_CASE_FIXTURE(requester_world,
                  "one service cools down, at one provider; others do not") {
  start_remote({one});
  run_for(100ms + 1ns);
  offer({one, two});
  CHECK(last_request().services == std::vector{two});
  offer_from(other, elsewhere, {one});
  REQUIRE(other->count<service_request>() == 1);
  CHECK(other->all<service_request>().front().services == std::vector{one});
}

TEST_CASE_FIXTURE(requester_world,
                  "a violation of what no longer runs changes nothing") {
  start_remote({one});
  tell(requester, qos_violation{at_here(one, 6), qos_breach::gap, now()});
  tell(requester, qos_violation{at_here(two, 7), qos_breach::gap, now()});
  CHECK(is_remote(one));
  CHECK(episodes().empty());
  CHECK(ends().empty());
}

TEST_CASE_FIXTURE(requester_world, "services fall back one by one") {
  start_remote({one, two});
  CHECK(is_remote(one));
  CHECK(is_remote(two));
  run_for(80ms);
  result(at_here(two, 8), 2);
  run_for(30ms); // the first has missed its gap
  CHECK(!is_remote(one));
  CHECK(is_remote(two));
  REQUIRE(episodes().size() == 1);
  CHECK(episodes().front().session == at_here(one, 7));
  run_for(100ms);
  CHECK(!is_remote(two));
  CHECK(episodes().size() == 2);
}

// -- the provider ends it ----------------------------------------------------

TEST_CASE_FIXTURE(requester_world, "when the provider ends a service the local "
                                   "one plans in the same instant") {
  start_remote({one});
  run_for(63ms);
  const auto t = now();
  tell(requester,
       service_end{at_here(one, 7), end_reason::left_area, side::provider});
  CHECK(!is_remote(one));
  CHECK(vehicle->times<source_change>().back() == t);
  run_for(10ms);
  const auto results = local_results();
  CHECK(std::ranges::any_of(results, [&](const service_result& r) {
    return r.session.service == one && r.created == t;
  }));
}

TEST_CASE_FIXTURE(requester_world,
                  "however often the provider says so, an episode ends once") {
  start_remote({one});
  const service_end end{at_here(one, 7), end_reason::left_area, side::provider};
  for (int k = 0; k < 3; ++k) {
    tell(requester, end);
    run_for(20ms);
  }
  REQUIRE(episodes().size() == 1);
  CHECK(episodes().front().reason == end_reason::left_area);
  CHECK(vehicle->count<source_change>() == 2); // to remote, and back
  CHECK(ends().empty());                       // the provider knows
}

TEST_CASE_FIXTURE(requester_world, "a service that ends before its first data "
                                   "is closed with the provider's reason") {
  start({one});
  tell(requester,
       service_end{at_here(one, 7), end_reason::cam_timeout, side::provider});
  run_for(3s);
  REQUIRE(episodes().size() == 1);
  CHECK(episodes().front().reason == end_reason::cam_timeout);
  CHECK(!episodes().front().got_data);
  CHECK(!episodes().front().fallback);
}

TEST_CASE_FIXTURE(requester_world,
                  "the end of an older or a strange running service does not "
                  "concern the present one") {
  start_remote({one});
  for (const auto& r :
       {at_here(one, 6), at_here(one, 8), at_here(two, 7),
        session_id{elsewhere, station, one, 7}, session_id{here, 102, one, 7}})
    tell(requester, service_end{r, end_reason::left_area, side::provider});
  CHECK(is_remote(one));
  CHECK(episodes().empty());
}

TEST_CASE_FIXTURE(requester_world,
                  "having left the area is no fallback and needs no "
                  "cool-down") {
  start_remote({one});
  tell(requester,
       service_end{at_here(one, 7), end_reason::left_area, side::provider});
  REQUIRE(episodes().size() == 1);
  CHECK(!episodes().front().fallback);
  offer({one});
  CHECK(requests() == 2);
}

TEST_CASE_FIXTURE(requester_world, "the start time-out of an ended service "
                                   "does not end the next one") {
  start({one});
  run_for(500ms);
  tell(requester,
       service_end{at_here(one, 7), end_reason::left_area, side::provider});
  offer({one});
  answer(last_request(), {{one, 8}});
  run_for(600ms);
  CHECK(episodes().size() == 1);
  result(at_here(one, 8), 1);
  CHECK(is_remote(one));
}

// -- what nobody wants -------------------------------------------------------

TEST_CASE_FIXTURE(requester_world,
                  "results of an unknown running service are answered by "
                  "service_end, five times a second at most") {
  start_remote({one});
  for (std::uint64_t k = 1; k <= 100; ++k) {
    result(at_here(two, 99), k);
    if (k % 5 == 0)
      result(at_here(one, 7), k);
    run_for(10ms);
  }
  CHECK(ends().size() == 5);
  for (const auto& e : ends()) {
    CHECK(e.session == at_here(two, 99));
    CHECK(e.from == side::requester);
  }
  CHECK(is_remote(one));
}

TEST_CASE_FIXTURE(requester_world, "results of an older counter are answered "
                                   "by service_end and not used") {
  start_remote({one});
  vehicle->clear();
  result(at_here(one, 6), 2);
  REQUIRE(ends().size() == 1);
  CHECK(ends().front().session == at_here(one, 6));
  CHECK(vehicle->count<service_result>() == 0);
  const auto last = recorder->all<event_record>().back();
  CHECK(last.what == event_type::result_refused);
  CHECK(last.detail == "session_over");
}

TEST_CASE_FIXTURE(requester_world,
                  "what goes on after its end is told to stop, again") {
  start_remote({one});
  tell(requester,
       service_end{at_here(one, 7), end_reason::left_area, side::provider});
  run_for(300ms);
  result(at_here(one, 7), 8);
  REQUIRE(ends().size() == 1);
  CHECK(ends().front().session == at_here(one, 7));
  CHECK(episodes().size() == 1);
}

TEST_CASE_FIXTURE(requester_world, "each provider is complained to by itself") {
  offer({one});
  offer_from(other, elsewhere, {two});
  for (int k = 0; k < 10; ++k) {
    result(at_here(one, 99), 1);
    result({elsewhere, station, one, 99}, 1);
  }
  CHECK(ends().size() == 1);
  CHECK(other->count<service_end>() == 1);
}

TEST_CASE_FIXTURE(requester_world,
                  "a provider that has booted anew is not known "
                  "by its earlier boots any more") {
  offer({});
  for (provider_id::rep next = 40; next < 50; ++next)
    offer_from(provider, next, {});
  for (provider_id::rep next = 40; next < 49; ++next)
    result({next, station, one, 99}, 1);
  result(at_here(one, 99), 1);
  CHECK(ends().empty());
  result({49, station, one, 99}, 1);
  CHECK(ends().size() == 1);
}

TEST_CASE_FIXTURE(requester_world,
                  "what runs is not forgotten for another boot "
                  "of its provider") {
  start_remote({one});
  offer_from(provider, 40, {});
  offer_from(provider, 41, {});
  CHECK(is_remote(one));
  kill(provider.handle);
  CHECK(!is_remote(one));
  REQUIRE(episodes().size() == 1);
  CHECK(episodes().front().reason == end_reason::peer_lost);
}

TEST_CASE_FIXTURE(requester_world, "results of a provider that nobody has met "
                                   "are ignored") {
  result({33, station, one, 1}, 1);
  CHECK(!is_gone(requester));
  CHECK(vehicle->count<source_change>() == 0);
}

// -- peers that vanish -------------------------------------------------------

TEST_CASE_FIXTURE(requester_world,
                  "when the provider is lost, the local services plan in the "
                  "same instant") {
  start_remote({one, two});
  run_for(63ms);
  const auto t = now();
  kill(provider.handle);
  CHECK(!is_remote(one));
  CHECK(!is_remote(two));
  run_for(10ms);
  const auto results = local_results();
  CHECK(std::ranges::count(results, t, &service_result::created) == 2);
  REQUIRE(episodes().size() == 2);
  for (const auto& e : episodes()) {
    CHECK(e.reason == end_reason::peer_lost);
    CHECK(e.ended == t);
    CHECK(e.fallback);
  }
}

TEST_CASE_FIXTURE(requester_world,
                  "a service that was starting at a lost provider is closed") {
  start({one});
  kill(provider.handle);
  run_for(3s);
  REQUIRE(episodes().size() == 1);
  CHECK(episodes().front().reason == end_reason::peer_lost);
  CHECK(!episodes().front().got_data);
}

TEST_CASE_FIXTURE(requester_world,
                  "a request to a lost provider is over, once") {
  offer({one});
  kill(provider.handle);
  REQUIRE(decisions().size() == 1);
  CHECK(!decisions().front().accepted);
  run_for(3s);
  CHECK(decisions().size() == 1);
  offer_from(other, elsewhere, {one});
  CHECK(other->count<service_request>() == 1);
}

TEST_CASE_FIXTURE(requester_world,
                  "losing one provider does not concern the other") {
  start_remote({one});
  offer_from(other, elsewhere, {two});
  kill(other.handle);
  CHECK(is_remote(one));
  CHECK(episodes().empty());
}

TEST_CASE_FIXTURE(requester_world, "two providers can run one service each") {
  start_remote({one});
  offer_from(other, elsewhere, {one, two});
  const auto request = other->all<service_request>().front();
  CHECK(request.services == std::vector{two});
  answer(request, {{two, 7}}); // counters are per provider
  result({elsewhere, station, two, 7}, 1);
  CHECK(is_remote(one));
  CHECK(is_remote(two));
  kill(provider.handle);
  CHECK(!is_remote(one));
  CHECK(is_remote(two));
}

TEST_CASE_FIXTURE(requester_world, "a restarted provider is a new one") {
  start_remote({one});
  kill(provider.handle);
  const auto restarted = listen<provider_actor>();
  offer_from(restarted, 12, {one}); // a new boot id has no cool-down
  REQUIRE(restarted->count<service_request>() == 1);
  CHECK(restarted->all<service_request>().front().provider == 12);
}

TEST_CASE_FIXTURE(requester_world,
                  "a requester that is shut down closes what runs") {
  start_remote({one});
  offer({two});
  answer(last_request(), {{two, 8}});
  caf::anon_send_exit(requester, caf::exit_reason::user_shutdown);
  settle();
  CHECK(is_gone(requester));
  REQUIRE(episodes().size() == 2);
  for (const auto& e : episodes()) {
    CHECK(e.reason == end_reason::shutdown);
    CHECK(!e.fallback);
  }
  REQUIRE(ends().size() == 2);
  for (const auto& e : ends())
    CHECK(e.reason == end_reason::shutdown);
}

TEST_CASE_FIXTURE(requester_world,
                  "a requester that never offloaded has nothing to close") {
  caf::anon_send_exit(requester, caf::exit_reason::user_shutdown);
  settle();
  CHECK(is_gone(requester));
  CHECK(episodes().empty());
}

TEST_CASE_FIXTURE(requester_world,
                  "a requester does not outlive its vehicle, and closes what "
                  "runs") {
  start_remote({one});
  kill(vehicle.handle);
  CHECK(is_gone(requester));
  REQUIRE(episodes().size() == 1);
  CHECK(episodes().front().reason == end_reason::shutdown);
  CHECK(ends().size() == 1);
}

TEST_CASE_FIXTURE(requester_world,
                  "the managers do not outlive their requester") {
  const auto twin = spawn();
  settle();
  const auto managers = vehicle->all<requester_manager_actor>();
  REQUIRE(managers.size() == 2);
  for (const auto& m : managers)
    CHECK(!is_gone(m));
  kill(twin);
  for (const auto& m : managers)
    CHECK(is_gone(m));
}

// -- what a service itself says ----------------------------------------------

namespace {

struct polite_requester_world : requester_world {
  polite_requester_world() {
    auto s = setup();
    s.services = {{its_echo("one")}};
    requester = own(spawn_service_requester(system(), std::move(s)));
    settle();
    drive_to(100);
    tell(vehicle->all<requester_manager_actor>().back(),
         service_input{{}, now(), payload::of(echo{1})});
    start_remote({one});
    run_for(10ms);
    recorder->clear();
  }

  const std::vector<std::byte> goodbye =
      its_octets(false, true).as<its_pdu>()->octets;
};

} // namespace

TEST_CASE_FIXTURE(polite_requester_world,
                  "a requester that ends a service says so in its own terms, "
                  "on the air") {
  run_for(200ms); // nothing comes
  REQUIRE(ends().size() == 1);
  const auto said = ends().front().what.as<its_pdu>();
  REQUIRE(said);
  CHECK(said->octets == goodbye);
  REQUIRE(recorder->count<air_record>() == 1);
  CHECK(recorder->all<air_record>().front().message.octets == goodbye);
  CHECK(recorder->all<air_record>().front().at
        == provider->times<service_end>().front());
}

TEST_CASE_FIXTURE(polite_requester_world,
                  "a requester says nothing when the provider has ended the "
                  "service") {
  tell(requester,
       service_end{at_here(one, 7), end_reason::left_area, side::provider});
  CHECK(episodes().size() == 1);
  CHECK(recorder->count<air_record>() == 0);
}

TEST_CASE_FIXTURE(requester_world, "what a provider revokes goes on in the "
                                   "vehicle, and ends for that reason") {
  start_remote({one});
  REQUIRE(is_remote(one));
  tell(requester,
       service_end{at_here(one, 7), end_reason::revoked, side::provider});
  CHECK(!is_remote(one));
  REQUIRE(episodes().size() == 1);
  CHECK(episodes().front().reason == end_reason::revoked);
  CHECK(episodes().front().of == side::requester);
  CHECK(ends().empty()); // it knows
  vehicle->clear();
  run_for(100ms);
  CHECK(std::ranges::count_if(
            local_results(),
            [&](const auto& r) { return r.session.service == one; })
        >= 1);
  offer({one}); // within a second of the fallback
  CHECK(requests() == 1);
}
