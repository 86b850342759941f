// One vehicle on a straight street, among probes.
#pragma once

#include "actors/services/planning/plan_request.hpp"
#include "actors/services/planning/planning_sides.hpp"
#include "actors/simulation/vehicle.hpp"
#include "messages/v2x/mcm/mcm_content.hpp"
#include "planners/trajectory/lane_follow.hpp"
#include "tests/support/on_air.hpp"
#include "tests/support/toy_streets.hpp"
#include "tests/support/virtual_world.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace sofof::test {

/// One vehicle on a straight street (limit 10 m/s), starting 100 m along it.
struct driving_world : virtual_world {
  static constexpr station_id::rep station = 101;
  probe<messages::road_actor> road = listen<messages::road_actor>();
  probe<messages::recorder_actor> recorder = listen<messages::recorder_actor>();
  probe<messages::onboard_requester_actor> requester =
      listen<messages::onboard_requester_actor>();
  probe<messages::link_actor> near = listen<messages::link_actor>();
  probe<messages::link_actor> distant = listen<messages::link_actor>();
  probe<messages::requester_manager_actor> manager =
      listen<messages::requester_manager_actor>();
  std::vector<std::size_t> connected; // antennas, in order
  const double start_speed_mps;
  const std::optional<messages::v2x_options> v2x;
  const double range_m; // of both antennas
  const duration appears_after;
  const duration alone_limit;
  world::route_ptr way = street();
  planners::lane_follow planner{way, {}};
  messages::vehicle_actor car = spawn();
  messages::session_id source{0, station, "trajectory_planning", 0};
  std::uint64_t cycle = 0;

  explicit driving_world(
      double starts_at_mps = 0,
      std::optional<messages::v2x_options> says = messages::v2x_options{},
      double heard_within_m = 100, duration appears = {}, duration alone = {})
      : start_speed_mps{starts_at_mps}, v2x{std::move(says)},
        range_m{heard_within_m}, appears_after{appears}, alone_limit{alone} {
    settle();
  }

  static world::route_ptr street() {
    const world::road_map map{
        "street", {}, {toy::straight("street", {0, 0}, {1000, 0})}};
    return map.make_route("street", std::vector<std::string>{"street"}, false);
  }

  messages::vehicle_actor spawn() {
    actors::vehicle_setup setup;
    setup.car = {station,
                 way,
                 100,
                 start_speed_mps,
                 {},
                 200ms,
                 alone_limit,
                 100ms,
                 std::make_shared<const planners::route_profile>(
                     way, planners::comfort_limits{})};
    setup.plans = actors::make_plan_client();
    setup.appears_after = appears_after;
    setup.v2x = v2x;
    setup.where = in_ulm();
    setup.antennas = std::make_shared<const std::vector<actors::antenna>>(
        std::vector<actors::antenna>{{{150, 0}, range_m}, {{500, 0}, range_m}});
    setup.connect = [this](std::size_t antenna) {
      connected.push_back(antenna);
      return antenna == 0 ? near.handle : distant.handle;
    };
    setup.road = road.handle;
    setup.recorder = recorder.handle;
    setup.spawn_requester = [this](const messages::vehicle_actor&) {
      return requester.handle;
    };
    return own(actors::spawn_vehicle(system(), std::move(setup)));
  }

  /// Plans from where the car is, as a service would do.
  world::trajectory plan() {
    const auto report = last_report();
    planners::planning_input from;
    from.at = report_time();
    from.s_m = report.s_m;
    from.d_m = report.state.at.y_m;
    from.speed_mps = report.state.speed_mps;
    from.accel_mps2 = report.state.accel_mps2;
    world::trajectory out;
    planner.plan(report_time(), from, nullptr, out);
    return out;
  }
  void give(world::trajectory t, time_point created) {
    tell(car, messages::service_result{source, ++cycle, created,
                                       messages::payload::of(std::move(t))});
  }
  /// The same as a provider would do.
  messages::its_pdu encoded_suggestion(const world::trajectory& t,
                                       station_id whom) {
    std::vector<messages::maneuver_waypoint> room;
    messages::etsi::mcm message;
    REQUIRE(messages::make_suggestion({9001, {150, 0}, whom, {7, 1}}, t,
                                      *in_ulm(), room, message));
    return messages::encoded(message);
  }
  void suggest(const world::trajectory& t, station_id whom) {
    tell(car, messages::service_result{
                  source, ++cycle, now(),
                  messages::payload::of(encoded_suggestion(t, whom))});
  }
  /// Drives with a new plan every 50 ms.
  void drive(duration d) {
    world::trajectory last = plan();
    for (const auto end = now() + d; now() < end; run_for(50ms)) {
      planners::planning_input from;
      const auto p = last.at(now());
      from.at = now();
      from.s_m = p.s_m;
      from.speed_mps = p.speed_mps;
      from.accel_mps2 = p.accel_mps2;
      world::trajectory next;
      planner.plan(now(), from, &last, next);
      last = next;
      give(next, now());
    }
  }

  // -- what it sent ---------------------------------------------------------

  using cpm = messages::etsi::tr103562::cpm;
  std::vector<messages::air_record> air() const {
    return recorder->all<messages::air_record>();
  }
  std::vector<messages::its_pdu> air_pdus() const {
    std::vector<messages::its_pdu> all;
    for (const auto& record : air())
      all.push_back(record.message);
    return all;
  }
  template <class Message>
  std::vector<time_point> air_times() const {
    std::vector<time_point> all;
    for (const auto& record : air())
      if (message_in<Message>(record.message))
        all.push_back(record.at);
    return all;
  }

  messages::motion_report last_report() const {
    return road->all<messages::motion_report>().back();
  }
  time_point report_time() const {
    return road->times<messages::motion_report>().back();
  }
  double fastest_mps() const {
    double v = 0;
    for (const auto& r : road->all<messages::motion_report>())
      v = std::max(v, r.state.speed_mps);
    return v;
  }
  messages::drive_record whole_drive() const {
    messages::drive_record sum;
    for (const auto& r : recorder->all<messages::drive_record>()) {
      CHECK(r.station == station);
      sum.plans.add(r.plans);
      sum.ride.add(r.ride);
    }
    return sum;
  }
  messages::safety_record total() const {
    messages::safety_record sum;
    for (const auto& r : recorder->all<messages::safety_record>()) {
      sum.driven += r.driven;
      sum.without_fresh_plan += r.without_fresh_plan;
      sum.off_road += r.off_road;
      sum.max_plan_age = std::max(sum.max_plan_age, r.max_plan_age);
    }
    return sum;
  }
};

/// The same, starting at the speed limit.
struct flying_start_world : driving_world {
  flying_start_world() : driving_world{10} {}

  /// What a vehicle does before its first plan and after.
  double slowest_mps() const {
    auto v = start_speed_mps;
    for (const auto& r : road->all<messages::motion_report>())
      v = std::min(v, r.state.speed_mps);
    return v;
  }
};

/// The same, standing, when its time has come.
struct late_world : driving_world {
  late_world() : driving_world{0, messages::v2x_options{}, 100, 10s} {}
};

inline void tell_of_a_car(driving_world& world) {
  world.tell(world.car, world::perception{
                            world.now(), {}, {{{150, 1}, 0, 3, 0, 4.5, 1.8}}});
}

} // namespace sofof::test
