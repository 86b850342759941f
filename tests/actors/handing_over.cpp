// Tests of services that go on from one provider to the next, come home
// because it was decided so, or run at two providers at once.
#include "tests/actors/requester_world.hpp"

#include <cmath>

using namespace sofof;
using namespace sofof::actors;
using namespace sofof::messages;
using namespace sofof::test;

namespace {

/// Service "one" runs at the first provider.
struct remote_service_world : requester_world {
  remote_service_world() { start_remote({one}); }

  /// The second provider offers, and is preferred.
  void prefer_other() {
    lodm->preferred = elsewhere;
    offer_from(other, elsewhere, {one});
  }
  session_id at_other() const { return {elsewhere, station, one, 70}; }
  void accept_at_other() {
    answer(other->all<service_request>().back(), {{one, 70}});
  }
  void go_over() {
    prefer_other();
    accept_at_other();
    result(at_other(), 1);
  }
  std::vector<std::string> switches() const {
    std::vector<std::string> all;
    for (const auto& e : recorder->all<event_record>())
      if (e.what == event_type::switched || e.what == event_type::left)
        all.push_back(std::string{name_of(e.what)} + " " + e.detail);
    return all;
  }
};

} // namespace

TEST_CASE_FIXTURE(remote_service_world,
                  "a policy is asked again when another provider offers what "
                  "runs elsewhere") {
  lodm->asked.clear();
  offer_from(other, elsewhere, {one});
  REQUIRE(lodm->asked.size() == 1);
  const auto& asked = lodm->asked.front();
  CHECK(asked.current == here);
  REQUIRE(asked.providers.size() == 2);
  CHECK(asked.providers[0].id == here);
  CHECK(asked.providers[1].id == elsewhere);
  CHECK(other->count<service_request>() == 0); // the first one: it stays
}

TEST_CASE_FIXTURE(remote_service_world,
                  "until the next provider gives data the former one goes on") {
  prefer_other();
  REQUIRE(other->count<service_request>() == 1);
  CHECK(ends().empty());
  accept_at_other();
  run_for(60ms);
  result(at_here(one, 7), 2);
  CHECK(is_remote(one));
  CHECK(ends().empty());
}

TEST_CASE_FIXTURE(remote_service_world,
                  "with its first data the next provider takes over and the "
                  "former is told, without going local") {
  vehicle->clear();
  go_over();
  REQUIRE(ends().size() == 1);
  CHECK(ends().front().session == at_here(one, 7));
  CHECK(ends().front().reason == end_reason::handed_over);
  CHECK(vehicle->count<source_change>() == 0);
  REQUIRE(episodes().size() == 1);
  CHECK(!episodes().front().fallback);
  CHECK(switches()
        == std::vector<std::string>{"switch remote", "switch remote",
                                    "left handed_over"});
  run_for(50ms);
  result(at_other(), 2);
  run_for(60ms);
  CHECK(vehicle->count<source_change>() == 0);
  CHECK(other->count<service_end>() == 0);
}

TEST_CASE_FIXTURE(remote_service_world,
                  "after a hand-over the watchdog watches the new provider") {
  go_over();
  run_for(100ms);
  CHECK(is_remote(one));
  CHECK(!std::ranges::any_of(recorder->all<event_record>(), [](const auto& e) {
    return e.what == event_type::violation;
  }));
  run_for(1ms);
  const auto told = other->all<service_end>();
  REQUIRE(told.size() == 1);
  CHECK(told.front().reason == end_reason::qos_gap);
  CHECK(episodes().back().fallback);
}

TEST_CASE_FIXTURE(remote_service_world,
                  "whoever refuses a hand-over changes nothing") {
  prefer_other();
  answer(other->all<service_request>().back(), {{one, 0}});
  CHECK(is_remote(one));
  CHECK(ends().empty());
  REQUIRE(lodm->refusals.size() == 1);
  CHECK(lodm->refusals.front().provider == elsewhere);
}

TEST_CASE_FIXTURE(remote_service_world,
                  "a provider that fails during a hand-over is no loss for the "
                  "other one") {
  prefer_other();
  accept_at_other();
  run_for(101ms); // nothing came from either
  CHECK(!is_remote(one));
  result(at_other(), 1);
  CHECK(is_remote(one));
  run_for(10ms);
  CHECK(other->count<service_end>() == 0);
}

TEST_CASE_FIXTURE(remote_service_world,
                  "a provider that accepts and gives no data is left, and the "
                  "former one goes on") {
  prefer_other();
  accept_at_other();
  for (std::uint64_t k = 2; k < 32; ++k) {
    run_for(50ms);
    result(at_here(one, 7), k);
  }
  CHECK(is_remote(one));
  REQUIRE(other->count<service_end>() == 1);
  CHECK(other->all<service_end>().front().reason == end_reason::no_data);
  CHECK(ends().empty());
}

TEST_CASE_FIXTURE(requester_world,
                  "a policy with an epoch is asked at its pace, wherever the "
                  "service runs") {
  lodm->epoch_s = 0.25;
  own(spawn_service_requester(system(), setup()));
  lodm->asked.clear();
  lodm->cycles.clear();
  run_for(1s);
  CHECK(lodm->asked.empty()); // nobody to choose from
  // Two services, each of five cycles an epoch on board.
  REQUIRE(lodm->cycles.size() == 8);
  CHECK(lodm->cycles.front().computed_at == std::nullopt);
  CHECK(lodm->cycles.front().cycles == doctest::Approx(5));
}

TEST_CASE("a service comes home when its policy says so, and that is no "
          "fallback") {
  requester_world w;
  w.lodm->epoch_s = 0.05;
  w.requester = w.own(spawn_service_requester(w.system(), w.setup()));
  w.drive_to(100);
  for (const auto& m : w.vehicle->all<requester_manager_actor>())
    w.tell(m, service_input{{}, w.now(), payload::of(echo{1})});
  w.start_remote({w.one});
  REQUIRE(w.is_remote(w.one));
  w.lodm->wanted = {"one"};
  w.lodm->release = true;
  w.run_for(50ms);
  CHECK(!w.is_remote(w.one));
  REQUIRE(w.ends().size() == 1);
  CHECK(w.ends().front().reason == end_reason::released);
  CHECK(!w.episodes().back().fallback);
  CHECK(w.lodm->episodes.size() == 1);
}

TEST_CASE_FIXTURE(remote_service_world,
                  "two providers that run a service at once feed one vehicle: "
                  "if one falls late, the other is enough") {
  lodm->preferred = here;
  lodm->second = elsewhere;
  offer_from(other, elsewhere, {one});
  accept_at_other();
  result(at_other(), 1);
  CHECK(ends().empty());
  for (std::uint64_t k = 2; k < 40; ++k) {
    run_for(50ms);
    result(at_other(), k);
    result(at_here(one, 7), k, 70ms); // always too late
  }
  CHECK(is_remote(one));
  // Of no use for a second: given up, and what it sends is complained of.
  REQUIRE(!ends().empty());
  CHECK(ends().front().reason == end_reason::qos_gap);
  REQUIRE(episodes().size() == 1);
  CHECK(other->count<service_end>() == 0);
  CHECK(!episodes().back().fallback);
}

TEST_CASE_FIXTURE(remote_service_world,
                  "when both of two providers fall silent the service comes "
                  "home at once") {
  lodm->preferred = here;
  lodm->second = elsewhere;
  offer_from(other, elsewhere, {one});
  accept_at_other();
  result(at_other(), 1);
  run_for(101ms);
  CHECK(!is_remote(one));
  REQUIRE(ends().size() == 1);
  REQUIRE(other->count<service_end>() == 1);
  // One violation and one fallback, not two; but neither is asked at once.
  CHECK(ends().front().reason == end_reason::qos_gap);
  CHECK(other->all<service_end>().front().reason == end_reason::released);
  lodm->asked.clear();
  offer({one});
  offer_from(other, elsewhere, {one});
  CHECK(lodm->asked.empty());
  std::size_t fallbacks = 0;
  for (const auto& e : episodes())
    fallbacks += e.fallback;
  CHECK(fallbacks == 1);
}

TEST_CASE_FIXTURE(remote_service_world,
                  "a result that never comes is told to the policy as missed") {
  lodm->cycles.clear();
  run_for(101ms);
  REQUIRE(lodm->cycles.size() == 1);
  CHECK(lodm->cycles.front().missed);
  CHECK(std::isinf(lodm->cycles.front().latency_s));
}
