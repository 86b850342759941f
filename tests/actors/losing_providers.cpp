// Tests of the connection to a provider: what its loss does, and how it comes
// back.
#include "base/protocol.hpp"
#include "tests/actors/provider_connection_world.hpp"

#include <map>

using namespace sofof;
using namespace sofof::actors;
using namespace sofof::messages;
using namespace sofof::test;

TEST_CASE_FIXTURE(provider_connection_world,
                  "when the connection is lost, what ran ends at "
                  "once, each for its vehicle") {
  connect();
  accept(one);
  accept(two);
  auto ended = one;
  ended.counter = 9;
  accept(ended);
  say(service_end{ended, end_reason::left_area, side::provider});
  forget();
  const auto before = now();
  SUBCASE("it breaks") {
    kill(provider.handle);
    CHECK(now() == before);
  }
  SUBCASE("it is silent for a second") {
    run_for(1s);
    CHECK(requester->entries().empty());
    run_for(50ms);
  }
  REQUIRE(requester->count<service_end>() == 1);
  const auto e = requester->all<service_end>().front();
  CHECK(e.session == one);
  CHECK(e.reason == end_reason::peer_lost);
  CHECK(e.from == side::provider);
  REQUIRE(other->count<service_end>() == 1);
  CHECK(other->all<service_end>().front().session == two);
  REQUIRE(notes("provider_lost") == 1);
  CHECK(recorder->all<event_record>().back().provider == boot);
}

TEST_CASE_FIXTURE(provider_connection_world,
                  "a provider that speaks, but does not answer "
                  "what was asked within a second, is lost") {
  connect();
  const auto speak = [&](duration d) {
    for (auto left = d; left >= 50ms; left -= 50ms) {
      run_for(50ms);
      say(ping{1, now()});
      result(one, 1, now());
    }
  };
  speak(1s);
  CHECK(notes("provider_lost") == 0);
  speak(50ms);
  CHECK(notes("provider_lost") == 1);
  CHECK(news[1]
        == "lost provider server at 10.0.0.5:4711: it has answered nothing for "
           "1 s; vehicles plan for themselves");
}

TEST_CASE_FIXTURE(provider_connection_world,
                  "what has ended with one connection does not "
                  "end again with the next") {
  connect();
  accept(one);
  kill(provider.handle);
  provider = listen<provider_endpoint_actor>();
  host->endpoint = provider.handle;
  live(1050ms);
  REQUIRE(notes("provider_connected") == 1);
  kill(provider.handle);
  CHECK(notes("provider_lost") == 2);
  CHECK(requester->count<service_end>() == 1);
}

TEST_CASE_FIXTURE(provider_connection_world,
                  "after the connection is lost the next attempt "
                  "is made at once") {
  connect();
  attempts.clear();
  const auto lost = now();
  kill(provider.handle);
  run_for(50ms);
  REQUIRE(!attempts.empty());
  CHECK(attempts.front() - lost <= 50ms);
}

TEST_CASE_FIXTURE(provider_connection_world,
                  "what is left of a lost connection is closed "
                  "before the next attempt") {
  connect();
  attempts.clear();
  CHECK(hung_up.empty());
  run_for(1100ms); // silent
  REQUIRE(hung_up.size() == 1);
  REQUIRE(attempts.size() == 1);
  CHECK(attempts.front() - hung_up.front() == protocol::ping_period);
}

TEST_CASE_FIXTURE(provider_connection_world,
                  "the death of somebody else does not end a connection") {
  connect();
  const auto before = provider;
  SUBCASE("of anybody") {
    tell_as(requester.handle, host->peer,
            caf::down_msg{recorder.handle.address(), caf::exit_reason::kill});
    CHECK(notes("provider_lost") == 0);
  }
  SUBCASE("of the endpoint before") {
    provider = listen<provider_endpoint_actor>();
    host->endpoint = provider.handle;
    run_for(1100ms); // silent; then connected again
    REQUIRE(notes("provider_connected") == 1);
    forget();
    tell_as(before.handle, host->peer,
            caf::down_msg{before.handle.address(), caf::exit_reason::kill});
    CHECK(notes("provider_lost") == 0);
  }
  SUBCASE("of the endpoint, while there is none") {
    reachable = false;
    run_for(1100ms);
    REQUIRE(notes("provider_lost") == 1);
    tell_as(before.handle, host->peer,
            caf::down_msg{before.handle.address(), caf::exit_reason::kill});
    CHECK(notes("provider_lost") == 1);
  }
  CHECK(!is_gone(outbox));
}

TEST_CASE_FIXTURE(provider_connection_world,
                  "what vehicles say while there is no "
                  "connection is lost") {
  connect();
  reachable = false;
  kill(provider.handle);
  forget();
  tell(far, service_request{boot, station, 1, {"one"}, {}, 5},
       requester.handle);
  tell(far, service_end{one});
  provider = listen<provider_endpoint_actor>();
  host->endpoint = provider.handle;
  reachable = true;
  run_for(1050ms);
  CHECK(provider->count<ping>() > 0);
  CHECK(provider->entries().size() == provider->count<ping>());
}

TEST_CASE_FIXTURE(provider_connection_world,
                  "a provider hears of each vehicle's latest CAM "
                  "once it has asked for our clock") {
  connect();
  say_cam(1); // its credit goes with the connection
  lose();
  say_cam(2);
  say_cam(3);
  tell(other_far, cam_of(neighbour, 7), other.handle);
  run_for(150ms);
  REQUIRE(notes("provider_connected") == 1);
  CHECK(provider->seconds<its_pdu>().empty());
  say_cam(4); // would be lost, too: nobody knows how old it is
  CHECK(provider->seconds<its_pdu>().empty());
  provider->clear();
  say(ping{1, now()});
  run_for(turns);
  REQUIRE(provider->entries().size() == 3);
  CHECK(provider->count<pong>() == 1);
  CHECK(provider->entries().front().what.match_elements<pong>());
  std::map<station_id, double> speeds;
  for (const auto& pdu : provider->seconds<its_pdu>())
    speeds[pdu.station().value()] = motion_in(pdu, now()).speed_mps;
  CHECK(speeds == std::map<station_id, double>{{station, 4}, {neighbour, 7}});
  say(ping{2, now()});
  CHECK(provider->seconds<its_pdu>().size() == 2); // once
  acknowledge({station, stream_id::what::cam, 0});
  say_cam(5);
  CHECK(provider->seconds<its_pdu>().size() == 3);
}

TEST_CASE_FIXTURE(provider_connection_world,
                  "of a vehicle whose CAM is older than two "
                  "seconds a new connection hears nothing") {
  connect();
  reachable = false;
  lose();
  say_cam(2);
  run_for(2s);
  tell(other_far, cam_of(neighbour, 7), other.handle);
  reachable = true;
  const auto end = now() + 1100ms;
  while (notes("provider_connected") == 0 && now() < end)
    run_for(protocol::ping_period);
  forget();
  say(ping{1, now()});
  run_for(turns);
  const auto told = provider->seconds<its_pdu>();
  REQUIRE(told.size() == 1);
  CHECK(told.front().station() == neighbour);
}

TEST_CASE("a hundred vehicles begin to speak one after the other, each in "
          "half a second at most") {
  provider_connection_world world;
  auto setup = world.setup();
  std::vector<link_actor> far;
  for (station_id::rep k = 200; k < 300; ++k)
    setup.stations.push_back(k);
  world.start(setup);
  for (station_id::rep k = 200; k < 300; ++k)
    far.push_back(
        world.own(spawn_provider_proxy(world.system(), k, world.outbox)));
  const auto all_speak = [&] {
    for (std::size_t k = 0; k < far.size(); ++k)
      world.tell(far[k], world.cam_of(static_cast<station_id>(200 + k)),
                 world.requester.handle);
  };
  const auto heard = [&] { return world.provider->seconds<its_pdu>().size(); };
  world.say(ping{1, world.now()});
  std::size_t before = 0;
  for (int k = 0; k < 10; ++k) {
    all_speak();
    world.run_for(50ms);
    CHECK(heard() <= before + 11); // nobody twice: nothing is acknowledged
    before = heard();
  }
  world.run_for(50ms);
  CHECK(heard() == 100);
}

TEST_CASE_FIXTURE(provider_connection_world,
                  "whose turn has not come asks nobody") {
  auto later = setup();
  later.rest = 1s;
  start(later);
  say(ping{1, now()});
  const auto ask = [&] {
    tell(far, service_request{boot, station, 1, {"one"}, {}, 5},
         requester.handle);
    return provider->count<service_request>();
  };
  CHECK(ask() == 0);
  live(1050ms);
  CHECK(ask() == 1);
}

TEST_CASE_FIXTURE(provider_connection_world,
                  "a turn that a lost connection left is none in "
                  "the next one") {
  auto many = setup();
  for (station_id::rep k = 200; k < 400; ++k)
    many.stations.push_back(k);
  std::ranges::sort(many.stations);
  many.stations.erase(std::ranges::find(many.stations, neighbour));
  many.stations.push_back(neighbour); // the last one, after a second
  start(many);
  const auto neighbour_speaks = [&] {
    tell(other_far, cam_of(neighbour), other.handle);
    return !provider->seconds<its_pdu>().empty();
  };
  say(ping{1, now()});
  live(700ms);
  lose();
  run_for(150ms);
  REQUIRE(notes("provider_connected") == 2);
  say(ping{2, now()});
  for (int k = 0; k < 18; ++k) { // the old turn would come meanwhile
    run_for(50ms);
    answer();
    CHECK(!neighbour_speaks());
  }
  run_for(150ms);
  CHECK(neighbour_speaks());
}

TEST_CASE_FIXTURE(provider_connection_world,
                  "before the first vehicle may send there is a "
                  "connection, and nothing is sent") {
  auto later = setup();
  later.rest = 1s;
  start(later);
  CHECK(notes("provider_connected") == 1);
  say(ping{1, now()});
  say_cam();
  run_for(990ms);
  CHECK(provider->seconds<its_pdu>().empty());
  run_for(60ms);
  CHECK(provider->seconds<its_pdu>().size() == 1);
}
