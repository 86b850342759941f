// Tests of the connection to vehicles: what is passed on, when a peer is lost,
// and what waits for whom.
#include "base/protocol.hpp"
#include "tests/actors/vehicle_connection_world.hpp"

using namespace sofof;
using namespace sofof::messages;
using namespace sofof::test;

// -- whose voice -------------------------------------------------------------

TEST_CASE_FIXTURE(vehicle_connection_world,
                  "to the provider each station of a peer is one requester") {
  live(1s);
  say_cam(station);
  say_cam(neighbour);
  say(request_of(station));
  say_cam(neighbour);
  const auto voices = provider->seconds<requester_actor>();
  REQUIRE(voices.size() == 4);
  CHECK(voices[0] != voices[1]);
  CHECK(voices[2] == voices[0]);
  CHECK(voices[3] == voices[1]);
}

TEST_CASE_FIXTURE(vehicle_connection_world,
                  "what the provider tells a requester reaches "
                  "the peer, with the station it is for") {
  live(1s);
  say_cam(neighbour);
  tell_as(provider.handle, voice(), service_offer{boot, {1, 2}, {"one"}});
  REQUIRE(peer->seconds<service_offer>().size() == 1);
  CHECK(peer->all<station_id::rep>() == std::vector{neighbour});
  CHECK(peer->entries().back().from
        == caf::actor_cast<caf::strong_actor_ptr>(endpoint));
  accept(one);
  REQUIRE(peer->count<service_response>() == 1);
  CHECK(peer->all<service_response>().front().verdicts.front().session == one);
  tell_as(provider.handle, voice(),
          service_end{one, end_reason::left_area, side::provider});
  REQUIRE(peer->count<service_end>() == 1);
  CHECK(peer->all<service_end>().front().session == one);
}

TEST_CASE_FIXTURE(vehicle_connection_world,
                  "an input finds the manager of its running "
                  "service, until that ends") {
  live(1s);
  accept(one);
  say(service_input{one, now(), payload::of(echo{3})});
  REQUIRE(manager->count<service_input>() == 1);
  CHECK(manager->all<service_input>().front().what.as<echo>()->number == 3);
  SUBCASE("the vehicle ends it") {
    say(service_end{one, end_reason::qos_gap, side::requester});
    REQUIRE(provider->count<service_end>() == 1);
    CHECK(provider->all<service_end>().front().session == one);
  }
  SUBCASE("the provider ends it") {
    tell_as(provider.handle, voice(),
            service_end{one, end_reason::left_area, side::provider});
  }
  say(service_input{one, now(), payload::of(echo{4})});
  CHECK(manager->count<service_input>() == 1);
}

TEST_CASE_FIXTURE(vehicle_connection_world,
                  "an input for what nobody runs is dropped") {
  live(1s);
  accept(one);
  say(service_input{two, now(), payload::of(echo{3})});
  auto other = one;
  other.counter = 9;
  say(service_input{other, now(), payload::of(echo{3})});
  CHECK(manager->count<service_input>() == 0);
  CHECK(!is_gone(endpoint));
}

// -- the connection ----------------------------------------------------------

TEST_CASE_FIXTURE(vehicle_connection_world,
                  "pings go out at 20 Hz, and are answered "
                  "at once") {
  live(1s);
  CHECK(peer->count<ping>() == 20);
  CHECK(peer->count<pong>() == 20);
  CHECK(peer->all<pong>().back().of.number == 1);
  CHECK(peer->all<pong>().back().received == now());
}

TEST_CASE_FIXTURE(vehicle_connection_world,
                  "a peer that is silent for a second is lost, "
                  "and all its stations with it") {
  live(1s);
  say_cam(station);
  const auto first = voice();
  say_cam(neighbour);
  const auto second = voice();
  run_for(1s);
  CHECK(!is_gone(endpoint));
  run_for(protocol::ping_period);
  CHECK(is_gone(endpoint));
  CHECK(is_gone(first));
  CHECK(is_gone(second));
  REQUIRE(notes("peer_lost").size() == 1);
  CHECK(notes("peer_lost").front().detail == "stations 101-102: silent");
}

TEST_CASE_FIXTURE(vehicle_connection_world,
                  "a peer that speaks, but does not answer what "
                  "was asked within a second, is lost") {
  live(1s);
  const auto last = peer->all<ping>().back();
  const auto speak = [&](duration d, const auto& answer) {
    for (auto left = d; left >= 50ms; left -= 50ms) {
      run_for(50ms);
      say_cam();
      say(ping{1, now()});
      answer();
    }
  };
  SUBCASE("it answers nothing") {
    speak(1s, [] {});
    CHECK(!is_gone(endpoint));
    speak(100ms, [] {});
  }
  SUBCASE("it answers the same again and again") {
    const auto answer = [&] { say(pong{last, now(), now()}); };
    speak(1s, answer);
    CHECK(!is_gone(endpoint));
    speak(100ms, answer);
  }
  SUBCASE("it has answered what was not asked yet") {
    say(pong{{9, now() + 1h}, now(), now()});
    speak(1s, [] {});
    CHECK(!is_gone(endpoint));
    speak(100ms, [] {});
  }
  CHECK(is_gone(endpoint));
}

TEST_CASE_FIXTURE(vehicle_connection_world,
                  "a connection that is replaced says so, and all "
                  "its stations are lost") {
  live(1s);
  say_cam();
  const auto lost = voice();
  caf::anon_send_exit(endpoint, caf::exit_reason::user_shutdown);
  settle();
  CHECK(is_gone(endpoint));
  CHECK(is_gone(lost));
  CHECK(notes("peer_lost").front().detail == "stations 101-102: replaced");
}

TEST_CASE_FIXTURE(vehicle_connection_world,
                  "a connection does not outlive its peer, nor the "
                  "provider") {
  live(1s);
  say_cam();
  SUBCASE("the peer dies") {
    kill(peer.handle);
  }
  SUBCASE("the provider dies") {
    kill(provider.handle);
  }
  CHECK(is_gone(endpoint));
  CHECK(notes("peer_lost").front().detail == "stations 101-102: gone");
}

TEST_CASE_FIXTURE(vehicle_connection_world,
                  "what a provider says last in good order is "
                  "handed on") {
  live(1s);
  say_cam();
  caf::anon_send_exit(provider.handle, caf::exit_reason::user_shutdown);
  settle();
  CHECK(!is_gone(endpoint));
  run_for(2 * protocol::ping_period);
  CHECK(is_gone(endpoint));
  CHECK(notes("peer_lost").front().detail
        == "stations 101-102: the provider has ended");
}

TEST_CASE_FIXTURE(vehicle_connection_world,
                  "the death of somebody else does not concern a connection") {
  live(1s);
  const auto other = listen<vehicle_endpoint_actor>();
  kill(other.handle);
  tell_as(stranger.handle, endpoint,
          caf::down_msg{other.handle.address(), caf::exit_reason::kill});
  CHECK(!is_gone(endpoint));
}

// -- back-pressure -----------------------------------------------------------

TEST_CASE_FIXTURE(vehicle_connection_world,
                  "while the peer acknowledges nothing, one "
                  "result of a stream is under way, one waits") {
  live(1s);
  accept(one);
  const auto first = voice();
  accept(two);
  const auto second = voice();
  const auto result = [&](const requester_actor& to, const session_id& r,
                          std::uint64_t cycle) {
    tell_as(manager.handle, to,
            service_result{r, cycle, now(), payload::of(echo{cycle})});
  };
  for (std::uint64_t k = 1; k <= 100; ++k)
    result(first, one, k);
  REQUIRE(peer->count<service_result>() == 1);
  CHECK(peer->all<service_result>().back().cycle == 1);
  result(second, two, 1); // a stream of its own
  CHECK(peer->count<service_result>() == 2);
  say(stream_of(one, stream_id::what::result));
  REQUIRE(peer->count<service_result>() == 3);
  CHECK(peer->all<service_result>().back().cycle == 100);
  say(stream_of(one, stream_id::what::result));
  CHECK(peer->count<service_result>() == 3);
  result(first, one, 101);
  CHECK(peer->all<service_result>().back().cycle == 101);
  say(stream_of(one, stream_id::what::cam)); // of another stream
  result(first, one, 102);
  CHECK(peer->count<service_result>() == 4);
}

TEST_CASE_FIXTURE(vehicle_connection_world,
                  "results whose acknowledgement got lost go on "
                  "after a second") {
  live(1s);
  accept(one);
  const auto to = voice();
  for (std::uint64_t k = 1; k <= 41; ++k) {
    tell_as(manager.handle, to,
            service_result{one, k, now(), payload::of(echo{k})});
    live(50ms);
  }
  std::vector<std::uint64_t> cycles;
  for (const auto& r : peer->all<service_result>())
    cycles.push_back(r.cycle);
  CHECK(cycles == std::vector<std::uint64_t>{1, 21, 41});
}

TEST_CASE_FIXTURE(vehicle_connection_world,
                  "protocol messages do not wait for a peer that stalls") {
  live(1s);
  accept(one);
  const auto to = voice();
  forget();
  for (std::uint64_t k = 1; k <= 100; ++k) {
    tell_as(manager.handle, to,
            service_result{one, k, now(), payload::of(echo{k})});
    tell_as(provider.handle, to, service_offer{k, {1, 2}, {"one"}});
    tell_as(provider.handle, to,
            service_response{boot, station, static_cast<std::uint32_t>(k), {}},
            std::vector<provider_manager_actor>{});
  }
  CHECK(peer->count<service_result>() == 1);
  const auto offers = peer->seconds<service_offer>();
  const auto responses = peer->all<service_response>();
  REQUIRE(offers.size() == 100);
  REQUIRE(responses.size() == 100);
  for (std::size_t k = 0; k < 100; ++k) {
    CHECK(offers[k].provider == k + 1);
    CHECK(responses[k].number == k + 1);
  }
}

TEST_CASE_FIXTURE(vehicle_connection_world,
                  "what a peer says is acknowledged, stream by stream") {
  live(1s);
  accept(one);
  forget();
  say_cam(station);
  say(neighbour, pdu_of(cam{neighbour, now(), {}, 0, 5, 0}, {}));
  say(service_input{one, now(), payload::of(echo{1})});
  CHECK(peer->all<stream_id>()
        == std::vector<stream_id>{{station, stream_id::what::cam, 0},
                                  {neighbour, stream_id::what::cpm, 0},
                                  {station, stream_id::what::input, 7}});
}

TEST_CASE_FIXTURE(vehicle_connection_world,
                  "what has ended without its credit does not "
                  "hold up what runs next") {
  for (std::uint32_t k = 1; k <= 100; ++k) {
    live(50ms);
    const session_id next{boot, station, "one", k};
    accept(next);
    tell_as(manager.handle, voice(),
            service_result{next, 1, now(), payload::of(echo{1})});
    CHECK(peer->count<service_result>() == k);
    tell_as(provider.handle, voice(),
            service_end{next, end_reason::left_area, side::provider});
  }
}

// -- clocks ------------------------------------------------------------------

TEST_CASE_FIXTURE(vehicle_connection_world,
                  "before the peer's clock is known nothing "
                  "with a time is handed on") {
  accept(one);
  say_cam();
  say(service_input{one, now(), payload::of(echo{1})});
  CHECK(provider->count<its_pdu>() == 0);
  CHECK(manager->count<service_input>() == 0);
  CHECK(peer->count<stream_id>() == 2);           // the next may come
  CHECK(provider->count<service_request>() == 1); // has no time
  run_for(50ms);
  answer();
  say_cam();
  say(service_input{one, now(), payload::of(echo{2})});
  CHECK(provider->count<its_pdu>() == 1);
  CHECK(manager->count<service_input>() == 1);
}

TEST_CASE_FIXTURE(vehicle_connection_world,
                  "times of a peer whose clock is off are "
                  "translated within the doubt") {
  for (const auto off :
       std::vector<duration>{-3001ms, -500ms, 0ms, 700ms, 1h}) {
    CAPTURE(off.count());
    ahead = off;
    endpoint = join(peer, {station, neighbour});
    settle();
    answer(4ms, 2ms);
    accept(one);
    forget();
    const auto said = now();
    say(service_input{one, said + ahead, payload::of(echo{1})});
    REQUIRE(manager->count<service_input>() == 1);
    const auto error = manager->all<service_input>().front().at - said;
    CHECK(std::chrono::abs(error) <= 3ms + 10us);
    kill(endpoint);
  }
}

TEST_CASE_FIXTURE(vehicle_connection_world,
                  "with CAMs and CPMs goes whose certificate "
                  "they came by") {
  live(1s);
  say_cam();
  REQUIRE(provider->count<its_pdu>() == 1);
  CHECK(provider->all<its_pdu>().front().sender == certificate);
}

TEST_CASE_FIXTURE(vehicle_connection_world,
                  "with ITS messages goes how far their "
                  "sender's time of day is ahead") {
  ahead = 300ms; // its clock, which began 200 ms later
  live(1s);
  accept(one);
  say_cam();
  say(service_input{one, now() + ahead, payload::of(cam_of(station))});
  REQUIRE(provider->count<its_pdu>() == 1);
  CHECK(std::chrono::abs(provider->all<its_pdu>().front().ahead - 500ms) < 1ms);
  REQUIRE(manager->count<service_input>() == 1);
  const auto in = manager->all<service_input>().front().what.as<its_pdu>();
  REQUIRE(in);
  CHECK(std::chrono::abs(in->ahead - 500ms) < 1ms);
  CHECK(in->octets == cam_of(station).octets);
}
