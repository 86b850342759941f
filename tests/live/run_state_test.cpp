// What those who look on are told of a run.
#include "live/run_state.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "live/frame.hpp"
#include <cmath>
#include <limits>
#include <string>

namespace sofof::live {

using namespace std::chrono_literals;
using messages::event_type;
using nlohmann::json;

namespace {

const messages::service_name planning{"trajectory_planning"};
const messages::service_name heating{"cabin_climate"};

constexpr time_point at(duration d) {
  return time_point{} + d;
}

messages::cam pose(station_id station, time_point t) {
  return {.station = station,
          .at = t,
          .position = {10, 20},
          .heading_rad = 1,
          .speed_mps = 5};
}

messages::track_record track(station_id station, duration t, bool remote) {
  return {at(t), {pose(station, at(t))}, 0, {}, remote};
}

messages::event_record switched(station_id station, provider_id to,
                                messages::service_name of = planning) {
  return {.what = event_type::switched,
          .station = station,
          .provider = to,
          .service = of,
          .remote = to != provider_id{0}};
}

messages::event_record event(event_type what, std::string detail = {}) {
  return {.what = what, .station = 101, .detail = std::move(detail)};
}

/// @returns the frame of a moment, as JSON.
json frame_at(run_state& of, duration t, std::uint64_t seen = 0) {
  const std::vector<std::string> names{"a", "b"};
  const scenario::operations::load load{"b", 4, 0.25};
  const auto text =
      event_text(frame_text({"r", 7, at(0s), at(t), false}, of.cars(at(t)),
                            {&load, 1}, names, of.counts()),
                 at(0s), of.events_after(seen, 100), seen);
  const auto data = text.find("data: ");
  REQUIRE(data != text.npos);
  CHECK(text.find('\n', data) == text.size() - 2);
  auto all = json::parse(text.substr(data + 6));
  all["id"] = text.substr(4, text.find('\n') - 4);
  return all;
}

} // namespace

TEST_CASE("a frame has each car where it was last, and who plans for it") {
  run_state of{"trajectory_planning", {}};
  of.on_record(track(101, 1s, false));
  of.on_record(track(102, 1s, false));
  of.on_record(switched(102, provider_at(2, 77)));
  of.on_record(switched(101, provider_at(1, 77), heating));
  of.on_record(track(101, 1100ms, false));
  of.on_record(track(102, 1100ms, true));
  messages::cycle_record result;
  result.session = {provider_at(2, 77), station_id{102}, planning, 1};
  result.created = at(1080ms);
  result.received = at(1100ms);
  of.on_record(result);
  const auto frame = frame_at(of, 1200ms);
  CHECK(frame["t"] == 1.2);
  CHECK(frame["n"] == 7);
  CHECK(frame["cars"]
        == json::parse("[[101,1.1,10,20,1,5,-1,null],"
                       "[102,1.1,10,20,1,5,1,20]]"));
  CHECK(frame["loads"] == json::parse("[[1,4,0.25]]"));
  // A result of long ago tells nothing of now.
  of.on_record(track(102, 2900ms, true));
  CHECK(frame_at(of, 3s)["cars"][1][7].is_null());
  of.on_record(switched(102, 0));
  of.on_record(track(102, 3s, false));
  CHECK(frame_at(of, 3s)["cars"][1][6] == -1);
}

TEST_CASE("cars that have arrived, or of which nothing is heard, have gone") {
  run_state of{"trajectory_planning", {}};
  of.on_record(track(101, 1s, false));
  of.on_record(track(102, 1s, false));
  of.on_record(event(event_type::arrived));
  CHECK(frame_at(of, 2s)["cars"].size() == 1);
  CHECK(frame_at(of, 4001ms)["cars"].empty());
}

TEST_CASE("a provider shows whom it hears, and whom it plans for") {
  run_state of{"trajectory_planning", 0};
  of.on_heard(pose(101, at(900ms)), at(1s));
  of.on_heard(pose(102, at(900ms)), at(1s));
  messages::verdict_record yes{
      at(1s), {provider_at(1, 9), station_id{102}, planning, 3}, true, ""};
  of.on_record(yes);
  of.on_heard(pose(101, at(1s)), at(1100ms));
  of.on_heard(pose(102, at(1s)), at(1100ms));
  auto cars = frame_at(of, 1200ms)["cars"];
  CHECK(cars[0][6] == -2);
  CHECK(cars[1][6] == 0);
  messages::episode_record end;
  end.session = yes.session;
  end.of = messages::side::provider;
  end.ended = at(2s);
  end.reason = messages::end_reason::left_area;
  of.on_record(end);
  of.on_heard(pose(102, at(2s)), at(2s));
  const auto frame = frame_at(of, 2s);
  CHECK(frame["cars"][1][6] == -2);
  CHECK(frame["events"].back()[2] == "ended");
  CHECK(frame["events"].back()[6] == "left_area");
}

TEST_CASE("made-up stations do not fill the memory") {
  run_state of{"trajectory_planning", 0};
  for (std::uint32_t i = 1; i <= run_state::most_cars + 1000; ++i)
    of.on_heard(pose(i, at(1s)), at(1s));
  CHECK(of.cars(at(1s)).size() == run_state::most_cars);
}

TEST_CASE("events come once, in their order; who was away gets the newest") {
  run_state of{"trajectory_planning", {}};
  of.on_record(event(event_type::offer)); // is not shown
  of.on_record(event(event_type::violation, "qos_latency value_ms=61"));
  of.on_record(event(event_type::near_miss));
  auto frame = frame_at(of, 1s);
  CHECK(frame["id"] == "2");
  CHECK(frame["counts"]["violations"] == 1);
  REQUIRE(frame["events"].size() == 2);
  CHECK(frame["events"][0]
        == json::parse("[1,0,\"violation\",101,-1,\"\","
                       "\"qos_latency value_ms=61\",\"qos\"]"));
  CHECK(frame_at(of, 1s, 1)["events"].size() == 1);
  CHECK(frame_at(of, 1s, 2)["events"].empty());
  CHECK(frame_at(of, 1s, 2)["id"] == "2");
  CHECK(frame_at(of, 1s, 999)["events"].size() == 2); // of another run
  for (int i = 0; i < 1000; ++i)
    of.on_record(event(event_type::near_miss));
  CHECK(of.events_after(0, 100).size() == 100);
  CHECK(of.events_after(0, 100).back().number == 1002);
  CHECK(of.events_after(0, 10000).size() == run_state::most_events);
}

TEST_CASE("refusals that come each second are told now and then") {
  run_state of{"trajectory_planning", {}};
  for (int i = 0; i < 25; ++i) {
    auto no = event(event_type::refused, "outside the area");
    no.at = at(i * 1s);
    of.on_record(no);
    no.station = 102;
    of.on_record(no);
  }
  CHECK(of.events_after(0, 100).size() == 6);
  for (int i = 0; i < 5; ++i)
    of.on_record(event(event_type::violation));
  CHECK(of.events_after(0, 100).size() == 11); // each counts
}

TEST_CASE("whatever a peer says, a frame is JSON in one line") {
  run_state of{"trajectory_planning", 0};
  of.on_record(event(event_type::peer_refused,
                     "a\nb\"c\\ \x01 \xff " + std::string(5000, 'x')));
  auto wrong = pose(101, at(1s));
  wrong.position.x_m = std::numeric_limits<double>::infinity();
  of.on_heard(wrong, at(1s));
  wrong = pose(102, at(1s));
  wrong.speed_mps = std::nan("");
  of.on_heard(wrong, at(1s));
  const auto frame = frame_at(of, 1s);
  CHECK(frame["cars"].empty());
  CHECK(frame["events"][0][6].get<std::string>().size() < 300);
}

TEST_CASE("what should not have been is counted") {
  run_state of{"trajectory_planning", {}};
  messages::episode_record end;
  end.fallback = true;
  of.on_record(end);
  end.of = messages::side::provider; // of the same
  of.on_record(end);
  of.on_record(messages::safety_record{101, 10s, 250ms, 0s, 0s});
  const auto counts = frame_at(of, 1s)["counts"];
  CHECK(counts["fallbacks"] == 1);
  CHECK(counts["episodes"] == 1);
  CHECK(counts["without_plan_s"] == 0.25);
}

} // namespace sofof::live
