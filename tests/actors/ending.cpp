// Tests of the service provider: how a running service ends.
#include "tests/actors/provider_world.hpp"

#include <algorithm>

using namespace sofof;
using namespace sofof::actors;
using namespace sofof::messages;
using namespace sofof::test;

TEST_CASE_FIXTURE(provider_world,
                  "a station that leaves the area loses its services") {
  hear(inside);
  start({one, two});
  const auto accepted = now();
  const auto running = verdicts();
  const auto ran_by = managers();
  stay(1s);
  hear(outside);
  REQUIRE(ends().size() == 2);
  for (std::size_t k = 0; k < 2; ++k) {
    CHECK(ends()[k].session == running[k].session);
    CHECK(ends()[k].reason == end_reason::left_area);
    CHECK(ends()[k].from == side::provider);
    CHECK(is_gone(ran_by[k]));
  }
  REQUIRE(episodes().size() == 2);
  for (const auto& e : episodes()) {
    CHECK(e.of == side::provider);
    CHECK(e.reason == end_reason::left_area);
    CHECK(e.accepted == accepted);
    CHECK(e.ended == now());
  }
  CHECK(!still_sends());
}

TEST_CASE_FIXTURE(provider_world,
                  "who was accepted outside keeps its service until it has "
                  "come into the area and left it") {
  place = outside;
  hear(outside);
  start({one});
  for (auto k = 0; k < 30; ++k) {
    run_for(100ms);
    hear(outside);
  }
  CHECK(episodes().empty());
  CHECK(still_sends());
  hear(inside);
  run_for(100ms);
  CHECK(episodes().empty());
  hear(outside);
  REQUIRE(episodes().size() == 1);
  CHECK(episodes().front().reason == end_reason::left_area);
}

TEST_CASE_FIXTURE(provider_world, "who asked from inside has left with its "
                                  "next CAM from outside, though none came "
                                  "from inside") {
  hear(outside);
  start({one});
  CHECK(episodes().empty());
  run_for(100ms);
  hear(outside);
  REQUIRE(episodes().size() == 1);
  CHECK(episodes().front().reason == end_reason::left_area);
}

TEST_CASE_FIXTURE(provider_world, "who was accepted outside, and says nothing "
                                  "more, is gone like everybody") {
  place = outside;
  hear(outside);
  start({one});
  run_for(2s + 1ns);
  REQUIRE(episodes().size() == 1);
  CHECK(episodes().front().reason == end_reason::cam_timeout);
}

TEST_CASE_FIXTURE(provider_world, "leaving on and on ends a service once") {
  hear(inside);
  start({one});
  for (int k = 0; k < 5; ++k) {
    run_for(100ms);
    hear(outside);
  }
  run_for(5s);
  CHECK(ends().size() == 1);
  CHECK(episodes().size() == 1);
}

TEST_CASE_FIXTURE(provider_world,
                  "a station is gone when its CAM is older than two seconds") {
  hear(inside);
  start({one});
  stay(1s);
  run_for(2s);
  CHECK(ends().empty());
  CHECK(episodes().empty());
  run_for(1ns);
  REQUIRE(ends().size() == 1);
  CHECK(ends().front().reason == end_reason::cam_timeout);
  REQUIRE(episodes().size() == 1);
  CHECK(episodes().front().reason == end_reason::cam_timeout);
  CHECK(episodes().front().ended == now());
  CHECK(!still_sends());
}

TEST_CASE_FIXTURE(provider_world,
                  "a CAM every two seconds keeps a service alive") {
  hear(inside);
  start({one});
  for (int k = 0; k < 10; ++k) {
    run_for(2s);
    hear(inside);
  }
  CHECK(episodes().empty());
  CHECK(still_sends());
}

TEST_CASE_FIXTURE(provider_world,
                  "a CPM does not stand for a CAM: who sends no CAM for two "
                  "seconds is silent, whatever else it sends") {
  hear(inside);
  start({one});
  for (auto k = 0; k < 4; ++k) {
    run_for(500ms);
    see(station);
  }
  CHECK(episodes().empty());
  run_for(1ns);
  REQUIRE(episodes().size() == 1);
  CHECK(episodes().front().reason == end_reason::cam_timeout);
}

TEST_CASE_FIXTURE(provider_world, "a silent station that comes back is offered "
                                  "to, and watched, like a new one") {
  hear(inside);
  run_for(3s);
  hear(inside);
  CHECK(offers().size() == 2);
  start({one});
  run_for(2s);
  CHECK(episodes().empty());
  run_for(1ns);
  CHECK(episodes().size() == 1);
}

TEST_CASE_FIXTURE(provider_world, "leaving and coming back does not leave an "
                                  "older alarm behind") {
  hear(inside);
  run_for(1s);
  hear(outside);
  run_for(500ms);
  hear(inside);
  start({one});
  run_for(2s);
  CHECK(episodes().empty());
  run_for(1ns);
  CHECK(episodes().size() == 1);
}

TEST_CASE_FIXTURE(provider_world, "a CAM that was overtaken changes nothing") {
  hear(inside);
  start({one});
  const cam older{station, now() - 1s, outside, 0, 10, 0};
  hear(older, requester);
  CHECK(episodes().empty());
  run_for(1s);
  auto old_inside = older;
  old_inside.position = inside;
  hear(old_inside, requester);
  run_for(1s + 1ns); // it does not count as a sign of life either
  CHECK(episodes().size() == 1);
}

TEST_CASE_FIXTURE(provider_world,
                  "a CAM from farther in the future than clocks are apart is "
                  "as if it had not come, and makes no true one too old") {
  hear(inside);
  start({one});
  for (const auto where : {inside, outside})
    hear(cam{station, now() + 10s, where, 0, 10, 0}, requester);
  stay(3s);
  CHECK(episodes().empty());
  CHECK(still_sends());
  hear(outside);
  CHECK(episodes().size() == 1);
}

TEST_CASE_FIXTURE(provider_world, "the requester ends its service: it is "
                                  "closed with that reason, once") {
  hear(inside);
  start({one, two});
  const auto running = verdicts().front().session;
  const auto manager = managers().front();
  const service_end end{running, end_reason::qos_latency, side::requester};
  for (int k = 0; k < 3; ++k)
    tell(provider, end);
  CHECK(is_gone(manager));
  REQUIRE(episodes().size() == 1);
  CHECK(episodes().front().session == running);
  CHECK(episodes().front().reason == end_reason::qos_latency);
  CHECK(ends().empty()); // the requester knows
  run_for(10ms);
  requester->clear();
  run_for(100ms);
  for (const auto& r : requester->all<service_result>())
    CHECK(r.session.service == two);
  CHECK(requester->count<service_result>() > 0);
}

TEST_CASE_FIXTURE(provider_world,
                  "the end of an older or a strange running service does not "
                  "concern the present one") {
  hear(inside);
  ask(make_request({one}));
  const auto older = verdicts().front().session;
  start({one}); // ends the older one
  const auto present = verdicts().front().session;
  REQUIRE(episodes().size() == 1);
  for (const auto& r : {older,
                        {boot + 1, station, one, present.counter},
                        {boot, station, two, present.counter},
                        {boot, station + 1, one, present.counter},
                        {boot, station, one, present.counter + 1}})
    tell(provider, service_end{r, end_reason::qos_gap, side::requester});
  CHECK(episodes().size() == 1);
  CHECK(still_sends());
}

TEST_CASE_FIXTURE(provider_world,
                  "when the requester is lost its services are closed") {
  hear(inside);
  hear(inside, neighbour, 102);
  start({one, two});
  const auto ran_by = managers();
  tell(provider, service_request{boot, 102, 1, {one}, {inside}, 10},
       neighbour.handle);
  kill(requester.handle);
  REQUIRE(episodes().size() == 2);
  for (const auto& e : episodes()) {
    CHECK(e.reason == end_reason::peer_lost);
    CHECK(e.session.station == station);
  }
  for (const auto& m : ran_by)
    CHECK(is_gone(m));
  run_for(5s);
  CHECK(episodes().size() == 3); // the neighbour has fallen silent
}

TEST_CASE_FIXTURE(provider_world, "a requester that ends in good order was "
                                  "not lost") {
  hear(inside);
  start({one});
  caf::anon_send_exit(requester.handle, caf::exit_reason::user_shutdown);
  settle();
  REQUIRE(episodes().size() == 1);
  CHECK(episodes().front().reason == end_reason::shutdown);
  CHECK(episodes().front().because == "its requester has ended");
}

TEST_CASE_FIXTURE(provider_world, "a service that no input ever reaches is "
                                  "closed for want of it") {
  hear(inside);
  ask(make_request({one}));
  for (int k = 0; k < 3; ++k) {
    run_for(1s);
    hear(inside);
  }
  REQUIRE(!episodes().empty());
  CHECK(episodes().front().reason == end_reason::no_data);
  CHECK(episodes().front().because == "no input of the vehicle came");
}

TEST_CASE_FIXTURE(provider_world, "when a manager is lost its service is "
                                  "closed, and the requester told") {
  hear(inside);
  start({one, two});
  kill(managers().front());
  REQUIRE(episodes().size() == 1);
  CHECK(episodes().front().session == verdicts().front().session);
  CHECK(episodes().front().reason == end_reason::peer_lost);
  REQUIRE(ends().size() == 1);
  CHECK(ends().front().session == verdicts().front().session);
  requester->clear();
  run_for(100ms);
  CHECK(requester->count<service_result>() > 0);
  for (const auto& r : requester->all<service_result>())
    CHECK(r.session.service == two);
  hear(outside);
  CHECK(episodes().size() == 2);
}

TEST_CASE_FIXTURE(provider_world, "a provider that shuts down closes what "
                                  "runs and says so") {
  hear(inside);
  start({one, two});
  const auto ran_by = managers();
  caf::anon_send_exit(provider, caf::exit_reason::user_shutdown);
  settle();
  CHECK(is_gone(provider));
  REQUIRE(episodes().size() == 2);
  for (const auto& e : episodes())
    CHECK(e.reason == end_reason::shutdown);
  REQUIRE(ends().size() == 2);
  for (const auto& e : ends())
    CHECK(e.reason == end_reason::shutdown);
  for (const auto& m : ran_by)
    CHECK(is_gone(m));
}

TEST_CASE_FIXTURE(provider_world,
                  "a killed provider takes its managers with it") {
  hear(inside);
  start({one});
  const auto ran_by = managers();
  kill(provider);
  CHECK(is_gone(ran_by.front()));
  requester->clear();
  run_for(1s);
  CHECK(requester->entries().empty());
}

TEST_CASE_FIXTURE(provider_world, "a station that comes back with a new "
                                  "requester starts afresh") {
  hear(inside);
  start({one});
  run_for(100ms);
  hear(inside, neighbour); // the same station, another requester
  const auto closed = recorder->all<episode_record>();
  REQUIRE(closed.size() == 1);
  CHECK(closed.front().reason == end_reason::peer_lost);
  REQUIRE(neighbour->count<service_offer>() == 1); // at once
  CHECK(neighbour->all<service_offer>().front().services
        == std::vector{one, two});
  // The old one's end is nobody's business any more.
  kill(requester.handle);
  run_for(1s);
  hear(inside, neighbour);
  CHECK(neighbour->count<service_offer>() == 2);
  CHECK(neighbour->count<service_end>() == 0);
}

TEST_CASE_FIXTURE(provider_world, "a station that leaves and returns is still "
                                  "forgotten 2 s after its last CAM") {
  hear(inside);
  run_for(500ms);
  hear({1000, 0});
  run_for(500ms);
  hear(inside);
  start({one});
  stay(1900ms); // over the moment of the first stay's timer
  CHECK(recorder->count<episode_record>() == 0);
  run_for(2s);
  CHECK(recorder->count<episode_record>() == 0);
  run_for(1ns);
  REQUIRE(recorder->count<episode_record>() == 1);
  CHECK(recorder->all<episode_record>().front().reason
        == end_reason::cam_timeout);
}

// -- what a service itself says ----------------------------------------------

namespace {

struct polite_world : provider_world {
  polite_world() {
    auto s = setup();
    s.services = {its_echo("one")};
    provider = own(spawn_service_provider(system(), std::move(s)));
    hear(inside);
    start({one});
    recorder->clear();
  }

  const std::vector<std::byte> goodbye =
      its_octets(true, false).as<its_pdu>()->octets;
};

} // namespace

TEST_CASE_FIXTURE(polite_world, "a provider that ends a service says so in its "
                                "own terms, on the air") {
  hear(outside);
  REQUIRE(ends().size() == 1);
  const auto said = ends().front().what.as<its_pdu>();
  REQUIRE(said);
  CHECK(said->octets == goodbye);
  REQUIRE(recorder->count<air_record>() == 1);
  CHECK(recorder->all<air_record>().front().at == now());
  CHECK(recorder->all<air_record>().front().message.octets == goodbye);
  hear(outside);
  run_for(5s);
  CHECK(recorder->count<air_record>() == 1);
}

TEST_CASE_FIXTURE(polite_world, "a provider says nothing when the requester "
                                "has ended the service") {
  tell(provider, service_end{verdicts().front().session, end_reason::qos_gap,
                             side::requester});
  CHECK(episodes().size() == 1);
  CHECK(recorder->count<air_record>() == 0);
}
