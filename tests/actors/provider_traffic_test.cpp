// Tests of the connection to a provider: what crosses it.
#include "base/protocol.hpp"
#include "tests/actors/provider_connection_world.hpp"

using namespace sofof;
using namespace sofof::actors;
using namespace sofof::messages;
using namespace sofof::test;

// -- what the provider may say -----------------------------------------------

TEST_CASE_FIXTURE(provider_connection_world,
                  "only its provider speaks for the provider") {
  connect();
  accept(one);
  forget();
  const auto stranger = listen<provider_endpoint_actor>();
  const auto who = caf::actor_cast<caf::actor>(stranger.handle);
  answer_as(who, station, service_offer{boot, {}, {"one"}});
  answer_as(who, service_response{boot, station, 1, {{one, true, ""}}});
  answer_as(who, service_result{one, 1, now(), payload::of(echo{1})});
  answer_as(who, service_end{one, end_reason::left_area, side::provider});
  answer_as(who, ping{1, now()});
  answer_as(who, pong{{1, now()}, now(), now()});
  CHECK(requester->entries().empty());
  CHECK(stranger->entries().empty());
  for (int k = 0; k < 30; ++k) {
    run_for(50ms);
    answer_as(who, ping{1, now()});
  }
  CHECK(notes("provider_lost") == 1);
}

TEST_CASE_FIXTURE(provider_connection_world,
                  "nobody without a name speaks for a vehicle") {
  connect();
  accept(one);
  forget();
  const auto within_reach = caf::actor_cast<provider_outbox>(host->peer);
  tell(within_reach, station, cam_of(station));
  tell(within_reach, service_request{boot, station, 1, {"one"}, {}, 5});
  tell(within_reach, service_input{one, now(), payload::of(echo{1})});
  tell(within_reach, service_end{one});
  CHECK(provider->entries().empty());
  CHECK(!is_gone(within_reach));
}

TEST_CASE_FIXTURE(provider_connection_world,
                  "each vehicle gets what is meant for it, as if "
                  "from a provider nearby") {
  connect();
  say(neighbour, service_offer{boot, {1, 2}, {"one"}});
  accept(one);
  REQUIRE(other->count<service_offer>() == 1);
  CHECK(caf::actor_cast<link_actor>(other->entries().front().from)
        == other_far);
  CHECK(requester->count<service_offer>() == 0);
  REQUIRE(requester->count<service_response>() == 1);
  const auto managers =
      requester->seconds<std::vector<provider_manager_actor>>();
  REQUIRE(managers.size() == 1);
  CHECK(managers.front()
        == std::vector<provider_manager_actor>{provider_manager_actor{far}});
  CHECK(other->count<service_response>() == 0);
  say(station_id::rep{999}, service_offer{boot, {}, {"one"}}); // for nobody
  CHECK(!is_gone(outbox));
}

TEST_CASE_FIXTURE(provider_connection_world,
                  "a provider that accepts without end is not "
                  "remembered without end") {
  connect();
  for (std::uint32_t k = 1; k <= 1000; ++k) {
    accept({boot, station, "one", k});
    accept({boot, 999, "one", k}); // for nobody
  }
  CHECK(requester->count<service_response>() == 1000);
  kill(provider.handle);
  CHECK(requester->count<service_end>() == 16); // 8 a station
}

// -- back-pressure -----------------------------------------------------------

TEST_CASE_FIXTURE(provider_connection_world,
                  "while the provider acknowledges nothing, one "
                  "CAM of a station is under way, one waits") {
  connect();
  for (int k = 1; k <= 50; ++k)
    say_cam(k);
  const auto speeds = [&] {
    std::vector<double> all;
    for (const auto& pdu : provider->seconds<its_pdu>())
      all.push_back(motion_in(pdu, now()).speed_mps);
    return all;
  };
  CHECK(speeds() == std::vector<double>{1});
  tell(other_far, cam_of(neighbour, 7), other.handle); // another stream
  CHECK(speeds() == std::vector<double>{1, 7});
  acknowledge({station, stream_id::what::cam, 0});
  CHECK(speeds() == std::vector<double>{1, 7, 50});
  acknowledge({station, stream_id::what::cam, 0});
  CHECK(speeds().size() == 3);
  say_cam(12);
  CHECK(speeds() == std::vector<double>{1, 7, 50, 12});
}

TEST_CASE_FIXTURE(provider_connection_world,
                  "CAMs whose acknowledgement got lost go on "
                  "after a second") {
  connect();
  for (int k = 1; k <= 21; ++k) {
    say_cam(k);
    live(100ms);
  }
  std::vector<double> speeds;
  for (const auto& pdu : provider->seconds<its_pdu>())
    speeds.push_back(motion_in(pdu, now()).speed_mps);
  CHECK(speeds == std::vector<double>{1, 11, 21});
}

TEST_CASE_FIXTURE(provider_connection_world,
                  "CAMs, CPMs and inputs do not wait for one "
                  "another") {
  connect();
  say_cam();
  tell(far, pdu_of(cam{station, now(), {}, 0, 5, 0}, {}), requester.handle);
  tell(far, service_input{one, now(), payload::of(echo{1})});
  CHECK(provider->seconds<its_pdu>().size() == 2);
  CHECK(provider->count<service_input>() == 1);
}

TEST_CASE_FIXTURE(provider_connection_world,
                  "protocol messages do not wait for a provider "
                  "that stalls") {
  connect();
  for (std::uint32_t k = 1; k <= 100; ++k) {
    say_cam();
    tell(far, service_request{boot, station, k, {"one"}, {}, 5},
         requester.handle);
    tell(far, service_end{{boot, station, "one", k}});
  }
  CHECK(provider->seconds<its_pdu>().size() == 1);
  const auto requests = provider->all<service_request>();
  const auto ends = provider->all<service_end>();
  REQUIRE(requests.size() == 100);
  REQUIRE(ends.size() == 100);
  for (std::uint32_t k = 0; k < 100; ++k) {
    CHECK(requests[k].number == k + 1);
    CHECK(ends[k].session.counter == k + 1);
  }
}

TEST_CASE_FIXTURE(provider_connection_world,
                  "results are acknowledged as they come") {
  connect();
  result(one, 1, now());
  result(two, 1, now());
  CHECK(provider->all<stream_id>()
        == std::vector<stream_id>{{station, stream_id::what::result, 7},
                                  {neighbour, stream_id::what::result, 8}});
}

TEST_CASE_FIXTURE(provider_connection_world,
                  "what has ended without its credit does not "
                  "hold up what runs next") {
  connect();
  for (std::uint32_t k = 1; k <= 100; ++k) {
    const session_id next{boot, station, "one", k};
    tell(far, service_input{next, now(), payload::of(echo{1})});
    CHECK(provider->count<service_input>() == k);
    if (k % 2 == 0)
      tell(far, service_end{next});
    else
      say(service_end{next, end_reason::left_area, side::provider});
  }
}

// -- clocks ------------------------------------------------------------------

TEST_CASE_FIXTURE(provider_connection_world,
                  "before the provider's clock is known its "
                  "results are not handed on") {
  start();
  say_cam();
  result(one, 1, now());
  CHECK(requester->count<service_result>() == 0);
  CHECK(provider->count<stream_id>() == 1); // the next may come
  answer();
  result(one, 2, now());
  CHECK(requester->count<service_result>() == 1);
}

TEST_CASE_FIXTURE(provider_connection_world,
                  "results of a provider whose clock is off are "
                  "translated within the doubt that they say") {
  for (const duration shift :
       std::vector<duration>{-3001ms, -500ms, 0ms, 700ms, 1h}) {
    CAPTURE(shift.count());
    ahead = shift;
    provider = listen<provider_endpoint_actor>();
    host->endpoint = provider.handle;
    start();
    say_cam();
    answer(4ms, 2ms);
    requester->clear();
    const auto created = now() - 10ms;
    result(one, 1, created + ahead);
    REQUIRE(requester->count<service_result>() == 1);
    const auto r = requester->all<service_result>().front();
    CHECK(r.doubt >= 3ms);
    CHECK(r.doubt <= 3ms + 10us);
    CHECK(std::chrono::abs(r.created - created) <= r.doubt);
  }
}

TEST_CASE_FIXTURE(provider_connection_world,
                  "a result that comes from the future by less "
                  "than the doubt counts as created now") {
  start();
  say_cam();
  answer(3ms, 3ms);
  result(one, 1, now() + 2ms);
  result(one, 2, now() + 4ms);
  result(one, 3, now() - 1ms);
  const auto results = requester->all<service_result>();
  REQUIRE(results.size() == 3);
  CHECK(results[0].created == now());
  CHECK(results[1].created > now() + 3ms); // nobody believes that
  CHECK(results[2].created < now());
}

TEST_CASE_FIXTURE(provider_connection_world,
                  "with a result's ITS message goes how far the "
                  "provider's time of day is ahead") {
  ahead = -300ms;
  host->welcome.epoch_unix_ms += 1000;
  connect();
  const auto said = cam_of(station);
  say(service_result{one, 1, now() + ahead, payload::of(said)});
  REQUIRE(requester->count<service_result>() == 1);
  const auto in = requester->all<service_result>().front().what.as<its_pdu>();
  REQUIRE(in);
  CHECK(in->octets == said.octets);
  CHECK(std::chrono::abs(in->ahead - 700ms) < 1ms);
}
