// Tests of the connection to vehicles: what a peer may say, and how often.
#include "base/protocol.hpp"
#include "tests/actors/vehicle_connection_world.hpp"

using namespace sofof;
using namespace sofof::messages;
using namespace sofof::test;

TEST_CASE_FIXTURE(vehicle_connection_world,
                  "who speaks for another station is not heard, and noted") {
  live(1s);
  SUBCASE("by a CAM") {
    say_cam(foreign);
  }
  SUBCASE("by a request") {
    say(request_of(foreign));
  }
  SUBCASE("by an input") {
    say(service_input{{boot, foreign, "one", 7}, now(), payload::of(echo{1})});
  }
  SUBCASE("by an end") {
    say(service_end{{boot, foreign, "one", 7}});
  }
  CHECK(provider->entries().empty());
  CHECK(manager->entries().empty());
  CHECK(was_ignored("speaks for another station"));
  CHECK(notes("peer_ignored").front().station == foreign);
}

TEST_CASE_FIXTURE(vehicle_connection_world,
                  "who carries another station's message is not heard") {
  live(1s);
  say(station, cam_of(neighbour));
  say(station, its_pdu{});
  say(station, its_pdu{{std::byte{2}, std::byte{2}}});
  CHECK(provider->entries().empty());
  CHECK(was_ignored("carries another station's message"));
}

TEST_CASE_FIXTURE(vehicle_connection_world,
                  "a stranger is not heard, and noted") {
  live(1s);
  accept(one);
  forget();
  SUBCASE("with a CAM") {
    say_strangely(station, cam_of(station));
  }
  SUBCASE("with a request") {
    say_strangely(request_of(station));
  }
  SUBCASE("with an input") {
    say_strangely(service_input{one, now(), payload::of(echo{1})});
  }
  SUBCASE("with an end") {
    say_strangely(service_end{one});
  }
  SUBCASE("with pings") {
    say_strangely(ping{1, now()});
  }
  SUBCASE("with echoes") {
    say_strangely(pong{{1, now()}, now(), now()});
  }
  SUBCASE("with credit") {
    say_strangely(stream_of(one, stream_id::what::result));
  }
  SUBCASE("without a name") {
    tell(endpoint, station, cam_of(station));
  }
  CHECK(provider->entries().empty());
  CHECK(manager->entries().empty());
  CHECK(stranger->entries().empty());
  CHECK(was_ignored("a stranger speaks"));
}

TEST_CASE_FIXTURE(vehicle_connection_world,
                  "strangers do not keep a connection alive") {
  live(1s);
  for (int k = 0; k < 30; ++k) {
    run_for(50ms);
    say_strangely(ping{1, now()});
    say_strangely(station, cam_of(station));
  }
  CHECK(is_gone(endpoint));
}

TEST_CASE_FIXTURE(vehicle_connection_world,
                  "the peer cannot speak for the provider") {
  live(1s);
  accept(one);
  forget();
  say(service_end{one, end_reason::left_area, side::requester});
  CHECK(peer->count<service_end>() == 0);
  CHECK(provider->count<service_end>() == 1);
}

TEST_CASE_FIXTURE(vehicle_connection_world,
                  "a route without end is not handed on; the longest is") {
  say(request_of(station, 1000));
  CHECK(provider->count<service_request>() == 1);
  say(request_of(station, 1001));
  CHECK(provider->count<service_request>() == 1);
  CHECK(was_ignored("asks for too much"));
  auto many = request_of(station);
  many.services.assign(65, "one");
  say(many);
  CHECK(provider->count<service_request>() == 1);
}

TEST_CASE_FIXTURE(vehicle_connection_world,
                  "who says too much is heard at its rate, and noted") {
  live(1s);
  forget();
  for (int k = 0; k < 1000; ++k)
    say_cam();
  CHECK(provider->count<its_pdu>() == 200); // 2 s of 100 a second
  CHECK(was_ignored("says too much"));
  CHECK(peer->count<stream_id>() == 1000); // its streams do not stop
  live(500ms);
  forget();
  for (int k = 0; k < 1000; ++k)
    say_cam();
  CHECK(provider->count<its_pdu>() == 50);
}

TEST_CASE_FIXTURE(vehicle_connection_world,
                  "other stations of a peer do not notice a loud one") {
  live(1s);
  for (int k = 0; k < 1000; ++k)
    say_cam(station);
  forget();
  say_cam(neighbour);
  say(request_of(neighbour));
  CHECK(provider->count<its_pdu>() == 1);
  CHECK(provider->count<service_request>() == 1);
}

TEST_CASE_FIXTURE(vehicle_connection_world,
                  "who does it again and again is noted once a "
                  "second, with how often") {
  live(1s);
  forget();
  for (int k = 0; k < 100; ++k) {
    say_cam(foreign);
    live(50ms);
  }
  const auto all = notes("peer_ignored");
  REQUIRE(all.size() == 5);
  CHECK(all.front().detail == "speaks for another station; 1 so far");
  CHECK(all.back().detail == "speaks for another station; 81 so far");
  for (std::size_t k = 1; k < all.size(); ++k)
    CHECK(all[k].at - all[k - 1].at >= 1s);
}

TEST_CASE_FIXTURE(vehicle_connection_world,
                  "stations of other peers do not notice a loud one") {
  const auto polite = listen<vehicle_endpoint_actor>();
  const auto other = join(polite, {201});
  live(500ms);
  for (const auto& sign : polite->all<ping>())
    tell_as(polite.handle, other, pong{sign, sign.sent, sign.sent});
  forget();
  for (int k = 0; k < 1000; ++k) {
    say_cam();
    say_cam(foreign);
    say(request_of(station, 2000));
  }
  provider->clear();
  tell_as(polite.handle, other, station_id::rep{201}, cam_of(201));
  tell_as(polite.handle, other, request_of(201));
  CHECK(provider->count<its_pdu>() == 1);
  CHECK(provider->count<service_request>() == 1);
  CHECK(polite->all<stream_id>().size() == 1);
}

TEST_CASE_FIXTURE(vehicle_connection_world,
                  "who sends to an endpoint of others gets nowhere") {
  const auto other_peer = listen<vehicle_endpoint_actor>();
  const auto other = join(other_peer, {201});
  live(1s);
  forget();
  tell_as(peer.handle, other, station_id::rep{201}, cam_of(201));
  tell_as(peer.handle, other, request_of(201));
  CHECK(provider->entries().empty());
  CHECK(was_ignored("a stranger speaks"));
}
