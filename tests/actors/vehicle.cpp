// Tests of the vehicle: it drives, is seen, and never is without a plan.
#include "actors/vehicle.hpp"

#include "actors/services/trajectory_planning.hpp"
#include "planners/lane_follow.hpp"
#include "tests/support/toy_streets.hpp"
#include "tests/support/virtual_world.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace sofof;
using namespace sofof::test;

namespace {

/// One vehicle on a straight street (limit 10 m/s), starting 100 m along it.
struct driving_world : virtual_world {
  static constexpr station_id station = 101;
  probe<road_actor> road = listen<road_actor>();
  probe<recorder_actor> recorder = listen<recorder_actor>();
  probe<onboard_requester_actor> requester = listen<onboard_requester_actor>();
  probe<link_actor> near = listen<link_actor>();
  probe<link_actor> distant = listen<link_actor>();
  probe<requester_manager_actor> manager = listen<requester_manager_actor>();
  route_ptr way = street();
  lane_follow planner{way, {}};
  vehicle_actor car = spawn();
  std::uint64_t cycle = 0;

  driving_world() { settle(); }

  static route_ptr street() {
    const road_map map{
        "street", {}, {toy::straight("street", {0, 0}, {1000, 0})}};
    return map.make_route("street", std::vector<std::string>{"street"}, false);
  }

  vehicle_actor spawn() {
    vehicle_setup setup;
    setup.station = station;
    setup.way = way;
    setup.start_s_m = 100;
    setup.fresh_limit = 200ms;
    setup.track_period = 100ms;
    setup.antennas = {{near.handle, {150, 0}, 100},
                      {distant.handle, {500, 0}, 100}};
    setup.road = road.handle;
    setup.recorder = recorder.handle;
    setup.spawn_requester = [this](const vehicle_actor&) {
      return requester.handle;
    };
    return own(spawn_vehicle(system(), std::move(setup)));
  }

  /// Plans from where the car is, as a service would do.
  trajectory plan() const {
    const auto report = last_report();
    planning_input from;
    from.at = report_time();
    from.s_m = report.s_m;
    from.d_m = report.state.at.y_m;
    from.speed_mps = report.state.speed_mps;
    from.accel_mps2 = report.state.accel_mps2;
    trajectory out;
    planner.plan(report_time(), from, nullptr, out);
    return out;
  }
  void give(trajectory t, time_point created) {
    tell(car, service_result{{0, station, "trajectory_planning", 0},
                             ++cycle,
                             created,
                             payload::of(std::move(t))});
  }
  /// Drives with a new plan every 50 ms.
  void drive(duration d) {
    trajectory last = plan();
    for (const auto end = now() + d; now() < end; run_for(50ms)) {
      planning_input from;
      const auto p = last.at(now());
      from.at = now();
      from.s_m = p.s_m;
      from.speed_mps = p.speed_mps;
      from.accel_mps2 = p.accel_mps2;
      trajectory next;
      planner.plan(now(), from, &last, next);
      last = next;
      give(next, now());
    }
  }

  motion_report last_report() const {
    return road->all<motion_report>().back();
  }
  time_point report_time() const { return road->times<motion_report>().back(); }
  double fastest_mps() const {
    double v = 0;
    for (const auto& r : road->all<motion_report>())
      v = std::max(v, r.state.speed_mps);
    return v;
  }
  safety_record total() const {
    safety_record sum;
    for (const auto& r : recorder->all<safety_record>()) {
      sum.driven += r.driven;
      sum.without_fresh_plan += r.without_fresh_plan;
      sum.off_road += r.off_road;
      sum.max_plan_age = std::max(sum.max_plan_age, r.max_plan_age);
    }
    return sum;
  }
};

} // namespace

TEST_CASE_FIXTURE(driving_world, "a vehicle begins standing, with a plan") {
  CHECK(last_report().station == station);
  CHECK(last_report().s_m == 100);
  CHECK(last_report().state.speed_mps == 0);
  run_for(60s);
  CHECK(fastest_mps() == 0);
  CHECK(distance_m(last_report().state.at, {100, 0}) < 1e-6);
}

TEST_CASE_FIXTURE(driving_world, "the road hears of the vehicle at once, then "
                                 "every 50 ms, and whom to answer") {
  CHECK(road->times<motion_report>().front() == time_point{});
  run_for(10s);
  const auto times = road->times<motion_report>();
  REQUIRE(times.size() > 199);
  for (std::size_t k = 2; k < times.size(); ++k)
    CHECK(times[k] - times[k - 1] == 50ms);
  CHECK(road->seconds<vehicle_actor>().front() == car);
}

TEST_CASE_FIXTURE(driving_world, "a vehicle follows its plan") {
  const auto wanted = plan();
  give(wanted, now());
  run_for(4s);
  const auto there = wanted.at(report_time());
  CHECK(there.speed_mps > 3);
  CHECK(last_report().state.speed_mps
        == doctest::Approx(there.speed_mps).epsilon(0.05));
  CHECK(distance_m(last_report().state.at, there.at) < 0.5);
  CHECK(last_report().s_m == doctest::Approx(there.s_m).epsilon(0.005));
}

TEST_CASE_FIXTURE(driving_world,
                  "when plans cease the vehicle stops on its own, on the "
                  "road") {
  drive(10s);
  CHECK(last_report().state.speed_mps > 8);
  run_for(20s);
  CHECK(last_report().state.speed_mps == 0);
  const auto s_m = last_report().s_m;
  CHECK(std::abs(last_report().state.at.y_m) < 0.2);
  CHECK(total().off_road == 0ms);
  run_for(60s);
  CHECK(last_report().s_m == s_m);
}

TEST_CASE_FIXTURE(driving_world, "a vehicle that has stopped goes on when "
                                 "plans come again") {
  drive(5s);
  run_for(20s);
  REQUIRE(last_report().state.speed_mps == 0);
  drive(5s);
  CHECK(last_report().state.speed_mps > 3);
}

TEST_CASE_FIXTURE(driving_world, "an older plan does not replace a newer one") {
  run_for(1s);
  give(plan(), now());
  auto standing = trajectory{now() - 1ns, {{}, {}}};
  standing.points[0].at = standing.points[1].at = {100, 0};
  standing.points[0].s_m = standing.points[1].s_m = 100;
  standing.points[1].t_s = 10;
  give(standing, now() - 1ns);
  run_for(3s);
  CHECK(last_report().state.speed_mps > 2);
}

TEST_CASE_FIXTURE(driving_world, "what is no plan is no plan") {
  run_for(1s);
  give(plan(), now());
  run_for(100ms);
  give({}, now()); // without a point
  tell(car, service_result{{}, 9, now(), {}});
  tell(car, service_result{{}, 9, now(), payload::of(plan_request{})});
  auto of_another_time = plan();
  of_another_time.start += 1s;
  give(of_another_time, now());
  auto no_number = plan();
  no_number.points[3].at.x_m = std::nan("");
  give(no_number, now());
  run_for(3s);
  CHECK(last_report().state.speed_mps > 2);
}

TEST_CASE_FIXTURE(driving_world, "a vehicle asks for plans where they are "
                                 "made, whenever it has perceived") {
  tell(car, perception{});
  CHECK(manager->entries().empty());
  tell(car, manager.handle);
  run_for(1s);
  perception seen{now(), lead_vehicle{7, 150, 3, 0}, 170.0, {}};
  tell(car, seen);
  REQUIRE(manager->count<service_input>() == 1);
  const auto input = manager->all<service_input>().front();
  CHECK(input.at == now());
  const auto request = input.what.as<plan_request>();
  REQUIRE(request);
  CHECK(request->way == "street");
  CHECK(request->from.s_m == doctest::Approx(100));
  CHECK(request->from.speed_mps == 0);
  CHECK(request->seen.lead == seen.lead);
  CHECK(request->seen.stop_at_m == seen.stop_at_m);
}

// -- being seen --------------------------------------------------------------

TEST_CASE_FIXTURE(driving_world, "CAMs go out at 10 Hz, with the own motion") {
  run_for(10s);
  const auto times = requester->times<ego_state>();
  REQUIRE(times.size() == 100);
  for (std::size_t k = 1; k < times.size(); ++k)
    CHECK(times[k] - times[k - 1] == 100ms);
  drive(5s);
  run_for(10ms);
  const auto own = requester->all<ego_state>().back();
  CHECK(own.own.station == station);
  CHECK(own.own.at == requester->times<ego_state>().back());
  CHECK(own.own.speed_mps > 3);
  CHECK(own.own.position.x_m == doctest::Approx(own.s_m).epsilon(0.001));
}

TEST_CASE_FIXTURE(driving_world,
                  "only providers in range hear a CAM, and whom to answer") {
  run_for(10s);
  CHECK(near->count<cam>() == 100);
  CHECK(distant->entries().empty());
  CHECK(near->seconds<requester_actor>().front()
        == requester_actor{requester.handle});
}

TEST_CASE_FIXTURE(driving_world,
                  "driving from one provider to the next changes who hears") {
  drive(45s);
  CHECK(last_report().s_m > 450);
  near->clear();
  distant->clear();
  drive(3s);
  CHECK(near->entries().empty());
  CHECK(distant->count<cam>() > 25);
}

// -- records -----------------------------------------------------------------

TEST_CASE_FIXTURE(driving_world,
                  "with a new plan every 50 ms no plan is ever old") {
  drive(30s);
  CHECK(total().max_plan_age <= 60ms);
  CHECK(total().without_fresh_plan == 0ms);
  CHECK(total().off_road == 0ms);
  CHECK(total().driven >= 29s);
  CHECK(total().driven <= 30s);
}

TEST_CASE_FIXTURE(driving_world,
                  "time with a plan older than the limit is counted") {
  drive(5s); // the last plan comes at 4.95 s
  run_for(5s);
  caf::anon_send_exit(car, caf::exit_reason::user_shutdown);
  settle();
  CHECK(total().driven == 10s);
  CHECK(total().max_plan_age == 5050ms);
  CHECK(total().without_fresh_plan == 10s - 4950ms - 200ms);
}

TEST_CASE_FIXTURE(driving_world, "a plan is as old as the cycle that made it") {
  run_for(1s);
  give(plan(), now() - 70ms);
  recorder->clear();
  run_for(100ms);
  REQUIRE(recorder->count<track_record>() == 1);
  const auto track = recorder->all<track_record>().front();
  CHECK(track.plan_age == track.at - (time_point{1s} - 70ms));
}

TEST_CASE_FIXTURE(driving_world, "tracks say which source is in use") {
  const service_name kind{"trajectory_planning"};
  run_for(1s);
  CHECK(!recorder->all<track_record>().back().remote);
  tell(car, source_change{kind, true});
  run_for(1s);
  CHECK(recorder->all<track_record>().back().remote);
  tell(car, source_change{kind, false});
  run_for(1s);
  CHECK(!recorder->all<track_record>().back().remote);
  CHECK(recorder->count<track_record>() == 30);
  CHECK(recorder->all<track_record>().back().ego.own.station == station);
}

// -- peers that vanish -------------------------------------------------------

TEST_CASE_FIXTURE(driving_world, "a vehicle outlives its requester: it stops "
                                 "safely") {
  drive(5s);
  kill(requester.handle);
  CHECK(!is_gone(car));
  run_for(20s);
  CHECK(last_report().state.speed_mps == 0);
  CHECK(now() - report_time() < 50ms);
}

TEST_CASE_FIXTURE(driving_world, "a vehicle survives losing everybody else") {
  drive(5s);
  kill(near.handle);
  kill(road.handle);
  kill(recorder.handle);
  run_for(5s);
  CHECK(!is_gone(car));
}

TEST_CASE_FIXTURE(driving_world,
                  "a vehicle that goes takes its requester with it") {
  run_for(500ms);
  caf::anon_send_exit(car, caf::exit_reason::user_shutdown);
  settle();
  CHECK(is_gone(car));
  CHECK(is_gone(requester.handle));
  CHECK(total().driven == 500ms);
}

TEST_CASE_FIXTURE(driving_world, "at the end of its route a vehicle leaves the "
                                 "streets, and its requester goes with it") {
  drive(120s); // 900 m at 10 m/s
  REQUIRE(road->count<station_id>() == 1);
  CHECK(road->all<station_id>().front() == station);
  CHECK(last_report().s_m > 990);
  CHECK(is_gone(requester.handle));
  std::vector<std::string> events;
  for (const auto& e : recorder->all<event_record>())
    events.push_back(e.what);
  CHECK(events == std::vector<std::string>{"arrived"});
  CHECK(!is_gone(car)); // it waits for the end of the run
}
