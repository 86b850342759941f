// Tests of the recorder: every record reaches the sink, in order.
#include "actors/runtime/recorder.hpp"

#include "tests/support/virtual_world.hpp"

#include <doctest/doctest.h>

#include <string>

using namespace sofof;
using namespace sofof::test;

namespace {

struct letters final : record_sink {
  std::string all;
  std::vector<station_id> tracks;

  void take(const event_record&) override { all += 'e'; }
  void take(const decision_record&) override { all += 'd'; }
  void take(const cycle_record&) override { all += 'y'; }
  void take(const episode_record&) override { all += 'p'; }
  void take(const track_record& r) override {
    all += 't';
    tracks.push_back(r.ego.own.station);
  }
  void take(const safety_record&) override { all += 's'; }
  void take(const collision_record&) override { all += 'c'; }
  void take(const drive_record&) override { all += 'r'; }
  void take(const plan_switch_record&) override { all += 'w'; }
  void take(const air_record&) override { all += 'a'; }
};

} // namespace

TEST_CASE_FIXTURE(virtual_world, "every kind of record reaches the sink") {
  auto sink = std::make_shared<letters>();
  auto recorder = own(spawn_recorder(system(), sink));
  tell(recorder, event_record{});
  tell(recorder, decision_record{});
  tell(recorder, cycle_record{});
  tell(recorder, episode_record{});
  tell(recorder, track_record{});
  tell(recorder, safety_record{});
  tell(recorder, collision_record{});
  tell(recorder, drive_record{});
  tell(recorder, plan_switch_record{});
  tell(recorder, air_record{});
  CHECK(sink->all == "edyptscrwa");
}

TEST_CASE_FIXTURE(virtual_world, "records keep their order and content") {
  auto sink = std::make_shared<letters>();
  auto recorder = own(spawn_recorder(system(), sink));
  std::vector<station_id> said;
  for (station_id n = 1; n <= 100; ++n) {
    track_record r;
    r.ego.own.station = n;
    caf::anon_send(recorder, r);
    said.push_back(n);
  }
  settle();
  CHECK(sink->tracks == said);
}

TEST_CASE_FIXTURE(virtual_world,
                  "a recorder that has quit lets go of its sink") {
  auto sink = std::make_shared<letters>();
  auto recorder = own(spawn_recorder(system(), sink));
  caf::anon_send_exit(recorder, caf::exit_reason::user_shutdown);
  settle();
  CHECK(sink.use_count() == 1);
}
