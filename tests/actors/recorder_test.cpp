// Tests of the recorder: every record reaches the sink, in order.
#include "actors/runtime/recorder.hpp"

#include "tests/support/virtual_world.hpp"

#include <doctest/doctest.h>

#include <string>

using namespace sofof;
using namespace sofof::actors;
using namespace sofof::messages;
using namespace sofof::test;

namespace {

struct letters final : record_sink {
  std::string all;
  std::vector<station_id> tracks;

  void on_record(const record& x) override {
    all += "edjyoptscrnmvgqfwa"[x.index()];
    if (const auto* track = std::get_if<track_record>(&x))
      tracks.push_back(track->ego.own.station);
  }
};

} // namespace

TEST_CASE_FIXTURE(virtual_world, "every kind of record reaches the sink") {
  auto sink = std::make_shared<letters>();
  auto recorder = own(spawn_recorder(system(), sink));
  tell(recorder, record{event_record{}});
  tell(recorder, record{decision_record{}});
  tell(recorder, record{verdict_record{}});
  tell(recorder, record{cycle_record{}});
  tell(recorder, record{work_record{}});
  tell(recorder, record{episode_record{}});
  tell(recorder, record{track_record{}});
  tell(recorder, record{safety_record{}});
  tell(recorder, record{collision_record{}});
  tell(recorder, record{drive_record{}});
  tell(recorder, record{trip_record{}});
  tell(recorder, record{claim_record{}});
  tell(recorder, record{scene_record{}});
  tell(recorder, record{stage_record{}});
  tell(recorder, record{response_record{}});
  tell(recorder, record{prediction_record{}});
  tell(recorder, record{plan_switch_record{}});
  tell(recorder, record{air_record{}});
  CHECK(sink->all == "edjyoptscrnmvgqfwa");
}

TEST_CASE_FIXTURE(virtual_world, "records keep their order and content") {
  auto sink = std::make_shared<letters>();
  auto recorder = own(spawn_recorder(system(), sink));
  std::vector<station_id> said;
  for (station_id::rep n = 1; n <= 100; ++n) {
    track_record r;
    r.ego.own.station = n;
    caf::anon_send(recorder, record{r});
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
