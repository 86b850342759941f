// The air between vehicles: who is near hears, later or never, and in order.
#include "actors/simulation/air.hpp"

#include "tests/support/on_air.hpp"
#include "tests/support/virtual_world.hpp"

#include <doctest/doctest.h>

#include <vector>

using namespace sofof;
using namespace sofof::actors;
using namespace sofof::messages;
using namespace sofof::test;

namespace {

/// Three vehicles in a row; every message takes 5 to 40 ms.
struct heard_world : virtual_world {
  probe<air_listener_actor> first = listen<air_listener_actor>();
  probe<air_listener_actor> second = listen<air_listener_actor>();
  probe<air_listener_actor> third = listen<air_listener_actor>();
  air_actor air = make(0);

  static channel::channel_profile varied() {
    channel::channel_profile p;
    p.network = channel::delay_distribution::uniform(5ms, 40ms);
    return p;
  }

  air_actor make(double loss) {
    auto profile = varied();
    profile.loss = loss;
    return own(spawn_air(
        system(), {std::make_shared<const channel::channel_profile>(profile),
                   random_stream{1, "air"}, 300}));
  }

  void place(double first_m = 0, double second_m = 100, double third_m = 310) {
    tell(air, station_id::rep{101}, point{first_m, 0}, first.handle);
    tell(air, station_id::rep{102}, point{second_m, 0}, second.handle);
    tell(air, station_id::rep{103}, point{third_m, 0}, third.handle);
  }

  void say(double speed_mps = 1) {
    tell(air, station_id::rep{101}, point{0, 0},
         pdu_of(cam{101, now(), {1, 2}, 3, speed_mps, 0}));
  }
};

} // namespace

TEST_CASE_FIXTURE(heard_world, "who is near hears, unchanged and with the "
                               "delay of the channel; the others do not") {
  place();
  const auto sent = now();
  say();
  run_for(1s);
  CHECK(first->entries().empty()); // not its own words
  CHECK(third->entries().empty()); // 310 m
  REQUIRE(second->count<point>() == 1);
  CHECK(second->all<point>().front() == point{0, 0});
  CHECK(second->seconds<its_pdu>().front().octets
        == pdu_of(cam{101, sent, {1, 2}, 3, 1, 0}).octets);
  const auto took = second->times<point>().front() - sent;
  CHECK(took >= 5ms);
  CHECK(took <= 41ms);
}

TEST_CASE_FIXTURE(heard_world, "who comes nearer hears from then on") {
  place();
  say();
  run_for(1s);
  place(0, 100, 290);
  say();
  run_for(1s);
  CHECK(second->count<point>() == 2);
  CHECK(third->count<point>() == 1);
}

TEST_CASE_FIXTURE(heard_world, "what one says arrives in order, at each of the "
                               "others by itself") {
  place(0, 100, 200);
  std::vector<its_pdu> said;
  for (auto k = 0; k < 200; ++k) {
    say(k);
    said.push_back(pdu_of(cam{101, now(), {1, 2}, 3, k * 1.0, 0}));
    run_for(2ms);
  }
  run_for(1s);
  const auto heard = second->seconds<its_pdu>();
  REQUIRE(heard.size() == said.size());
  for (std::size_t k = 0; k < said.size(); ++k)
    CHECK(heard[k].octets == said[k].octets);
  CHECK(second->times<point>() != third->times<point>());
}

TEST_CASE_FIXTURE(heard_world, "some words are lost, other ones to each") {
  air = make(0.3);
  place(0, 100, 200);
  for (auto k = 0; k < 200; ++k) {
    say(k);
    run_for(100ms);
  }
  for (const auto& x : {second, third}) {
    CHECK(x->count<point>() > 110);
    CHECK(x->count<point>() < 170);
  }
  CHECK(second->times<point>() != third->times<point>());
}

TEST_CASE_FIXTURE(heard_world, "who has gone hears and disturbs nobody") {
  place();
  kill(second.handle);
  say();
  run_for(1s);
  place(0, 100, 200);
  say();
  run_for(1s);
  CHECK(third->count<point>() == 1);
}
