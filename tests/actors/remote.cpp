// Tests of vehicles whose provider is on another host, end to end.
#include "base/protocol.hpp"
#include "tests/actors/remote_world.hpp"

#include <set>

using namespace sofof;
using namespace sofof::messages;
using namespace sofof::test;

namespace {

struct fleet_world : remote_world {
  fleet_world() : remote_world{3} {}
};

} // namespace

TEST_CASE_FIXTURE(remote_world, "a vehicle is offered services by a provider "
                                "on another host, asks, and gets results") {
  drive(2s);
  CHECK(all_remote());
  const auto& car = cars.front();
  CHECK(notes(here, "offer").front().provider == first_boot);
  CHECK(notes(here, "accepted").size() == 2);
  const auto before = remote_results(car).size();
  drive(1s);
  const auto results = remote_results(car);
  CHECK(results.size() - before == 40); // two kinds at 20 Hz
  for (const auto& r : results) {
    CHECK(r.session.provider == first_boot);
    CHECK(r.session.station == 101);
    CHECK(r.created <= now());
    CHECK(r.doubt <= 1ms); // both clocks are one
  }
  CHECK(results.back().what.as<echo>()->number >= said - 3);
  CHECK(episodes(here).empty());
}

TEST_CASE_FIXTURE(remote_world, "when a vehicle leaves, its services end on "
                                "both hosts") {
  drive(2s);
  REQUIRE(all_remote());
  kill(cars.front().vehicle.handle);
  CHECK(is_gone(cars.front().requester));
  CHECK(episodes(here).size() == 2);
  run_for(1ms);
  REQUIRE(episodes(there).size() == 2);
  for (const auto& e : episodes(there))
    CHECK(e.reason == end_reason::shutdown);
}

TEST_CASE_FIXTURE(fleet_world, "to the provider each station behind a "
                               "connection is a vehicle of its own") {
  drive(2s);
  CHECK(all_remote());
  std::set<session_id> running;
  for (const auto& c : cars) {
    for (const auto& r : remote_results(c)) {
      CHECK(r.session.station == c.station);
      running.insert(r.session);
    }
  }
  CHECK(running.size() == 6);
  CHECK(notes(there, "peer_connected").size() == 1);
  // One that leaves is missed by nobody.
  kill(cars.front().vehicle.handle);
  cars.erase(cars.begin());
  drive(3s);
  CHECK(all_remote());
  for (const auto& e : episodes(there))
    CHECK(e.session.station == 101);
}

TEST_CASE_FIXTURE(fleet_world, "when the provider dies, all that ran ends at "
                               "once") {
  drive(2s);
  REQUIRE(all_remote());
  const auto died = now();
  crash();
  CHECK(none_remote());
  CHECK(now() == died);
  REQUIRE(episodes(here).size() == 6);
  for (const auto& e : episodes(here)) {
    CHECK(e.reason == end_reason::peer_lost);
    CHECK(e.ended == died);
    CHECK(e.fallback);
  }
}

TEST_CASE_FIXTURE(fleet_world, "when the provider is back, under a new boot "
                               "id, vehicles use it within three seconds") {
  drive(2s);
  crash();
  const auto died = now();
  drive(20s);
  CHECK(none_remote());
  for (std::size_t k = 1; k < attempts.size(); ++k)
    if (attempts[k - 1] > died)
      CHECK(attempts[k] - attempts[k - 1] <= 1050ms);
  CHECK(attempts.back() >= now() - 1050ms);
  boot_up();
  drive(3s);
  CHECK(all_remote());
  for (const auto& c : cars)
    CHECK(remote_results(c).back().session.provider == first_boot + 1);
  CHECK(refusals.empty());
}

TEST_CASE_FIXTURE(fleet_world, "a wire that is cut silently is noticed by both "
                               "sides after a second") {
  drive(2s);
  line->cut = true;
  drive(500ms);
  CHECK(none_remote()); // the watchdog is faster
  CHECK(notes(here, "provider_lost").empty());
  CHECK(notes(there, "peer_lost").empty());
  drive(600ms);
  CHECK(notes(here, "provider_lost").size() == 1);
  REQUIRE(notes(there, "peer_lost").size() == 1);
  // The provider has forgotten all stations.
  CHECK(episodes(there).size() == 6);
  drive(5s);
  line->cut = false;
  drive(3s);
  CHECK(all_remote());
}

TEST_CASE_FIXTURE(fleet_world, "a wire that is cut for less than a second "
                               "holds its connection") {
  drive(2s);
  line->cut = true;
  drive(800ms);
  line->cut = false;
  drive(3s);
  CHECK(notes(here, "provider_lost").empty());
  CHECK(notes(there, "peer_lost").empty());
  CHECK(all_remote());
}

TEST_CASE("however long a wire is cut, and whenever, vehicles are planned for "
          "again soon after it is back, even with a CAM a second") {
  for (const auto cut : {400ms, 900ms, 1000ms, 1050ms, 1100ms, 1200ms, 3000ms})
    for (auto phase = 0ms; phase < 1s; phase += 150ms) {
      CAPTURE(cut.count());
      CAPTURE(phase.count());
      fleet_world w;
      w.cam_period = 1s;
      w.drive(3s + phase);
      REQUIRE(w.all_remote());
      w.line->cut = true;
      w.drive(cut);
      REQUIRE(w.none_remote());
      w.line->cut = false;
      // A connection that lasts: what is left of the time at home, an offer's
      // period and a CAM's. A new one: a pause between attempts.
      w.drive(cut <= 1050ms ? 2900ms : 1300ms);
      CHECK(w.all_remote());
    }
}

TEST_CASE_FIXTURE(fleet_world, "vehicles whose host dies are forgotten by the "
                               "provider at once") {
  drive(2s);
  kill(outbox);
  CHECK(notes(there, "peer_lost").size() == 1);
  CHECK(episodes(there).size() == 6);
}

TEST_CASE_FIXTURE(remote_world, "delays are no trouble, and results say when "
                                "they were made") {
  line->delay = [] { return 10ms; };
  drive(10s); // what was quicker is forgotten
  here->clear();
  drive(3s);
  CHECK(all_remote());
  const auto& car = cars.front();
  const auto results = remote_results(car);
  REQUIRE(!results.empty());
  for (const auto& record : here->all<cycle_record>()) {
    CHECK(record.received - record.created >= 10ms);
    CHECK(record.received - record.created <= 35ms);
    CHECK(record.doubt >= 10ms);
    CHECK(record.doubt <= 12ms);
  }
  CHECK(episodes(here).empty());
}

TEST_CASE_FIXTURE(remote_world, "a connection with delays beyond half of the "
                                "limit is not trusted with a service") {
  line->delay = [] { return 30ms; };
  drive(12s); // what was quicker is forgotten
  CHECK(none_remote());
  CHECK(!notes(here, "clock_in_doubt").empty());
}
